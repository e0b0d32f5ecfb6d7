// The part of Assembler that goes on from stresses which are not those of the displacements.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "solver/elements/assembler_blocks.hpp"
#include "solver/elements/block_fields.hpp"
#include "solver/error.hpp"
#include "solver/fields/plate_stresses.hpp"

namespace comma::solver {

namespace {

/// Initial stresses agree with those of the displacements up to this share: both have been through fields and files.
constexpr double initial_stress_tolerance = 1e-6;
/// Of the largest of all: below, nothing is left of what cancels.
constexpr double stress_rounding = 1e-12;

}  // namespace

Eigen::VectorXd Assembler::with_initial(Eigen::VectorXd forces) const {
  if (initial_forces_.size() > 0) forces += initial_forces_;
  return forces;
}

std::vector<double> Assembler::stresses_in(const ElementBlock& block, const Eigen::VectorXd& u,
                                           const ImposedStrains* imposed) const {
  std::vector<double> values = stresses_of(block, u, state_, imposed);
  for (const auto& [other, initial] : initial_stresses_)
    if (other == &block) std::ranges::transform(values, initial, values.begin(), std::plus<>());
  return values;
}

Eigen::VectorXd Assembler::forces_of_stresses(const Eigen::VectorXd& u, const ElementField& stresses) const {
  std::vector<long double> sums(static_cast<std::size_t>(dofs_.size()), 0.0L);
  for (const auto& block : blocks_->list) {
    if (block->has_memory()) {
      block->add_forces_of_stresses(u, state_, read_stresses(*block, &stresses, *model_.mesh), sums);
      continue;
    }
    block->add_internal_forces(u, state_, sums);
    if (!block->takes_initial_stresses()) continue;
    if (const std::vector<double> excess = excess_of(*block, u, stresses); !excess.empty())
      block->add_forces_of_stresses(u, state_, excess, sums);
  }
  return rounded(sums);
}

void Assembler::resume(const Eigen::VectorXd& u, const ElementField* stresses, const ElementField* variables) {
  initial_stresses_.clear();
  initial_forces_.resize(0);
  for (const auto& block : blocks_->list) {
    if (!block->has_memory()) {
      if (stresses != nullptr) take_initial_stresses(*block, u, *stresses);
      continue;
    }
    block->resume(u, state_, read_stresses(*block, stresses, *model_.mesh),
                  read_block(*block, variable_names(block->variable_count()), variables, *model_.mesh));
  }
  if (initial_stresses_.empty()) return;
  std::vector<long double> sums(static_cast<std::size_t>(dofs_.size()), 0.0L);
  for (const auto& [block, values] : initial_stresses_) block->add_forces_of_stresses(u, state_, values, sums);
  initial_forces_ = rounded(sums);
}

// What the field has beyond the stresses of the displacements; empty where that is nothing.
std::vector<double> Assembler::excess_of(const ElementBlock& block, const Eigen::VectorXd& u,
                                         const ElementField& given) const {
  const bool has_forces = block.force_point_count(PlatePlaces::corners) > 0;
  const ElementField of_plates =
      has_forces ? plate_stresses(model_, properties_, plate_forces(u, PlatePlaces::integration_points, imposed_.get()))
                 : ElementField();
  std::vector<double> excess = has_forces ? values_on(block.cells(), of_plates, given, *model_.mesh)
                                          : read_stresses(block, &given, *model_.mesh);
  const std::vector<double> known = has_forces ? values_on(block.cells(), of_plates, of_plates, *model_.mesh)
                                               : stresses_of(block, u, state_, imposed_.get());
  // Forces and moments have units of their own.
  const std::vector<std::string> names = has_forces ? of_plates.components : stress_names(block);
  const auto is_moment = [&](std::size_t k) { return names[k % names.size()].starts_with('M') ? 1 : 0; };
  std::array<double, 2> largest = {0.0, 0.0};
  for (std::size_t k = 0; k < known.size(); ++k)
    largest[is_moment(k)] = std::max(largest[is_moment(k)], std::abs(known[k]));
  const double rounding = stress_rounding * std::max(largest[0], largest[1]);
  bool is_all = true;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const double difference = excess[k] - known[k];
    const bool is_rounding =
        std::abs(difference) <=
        std::max(rounding, initial_stress_tolerance * std::max(largest[is_moment(k)], std::abs(excess[k])));
    excess[k] = is_rounding ? 0.0 : difference;
    is_all = is_all && is_rounding;
  }
  return is_all ? std::vector<double>() : excess;
}

void Assembler::take_initial_stresses(const ElementBlock& block, const Eigen::VectorXd& u, const ElementField& given) {
  std::vector<double> excess = excess_of(block, u, given);
  if (excess.empty()) return;
  if (!block.takes_initial_stresses()) {
    const std::size_t each = excess.size() / block.cells().size();
    const auto first = static_cast<std::size_t>(
        std::ranges::find_if(excess, [](double value) { return value != 0.0; }) - excess.begin());
    throw Error("unsupported",
                fmt::format("the initial stress of cell {} is not that of its initial displacements",
                            model_.mesh->cell_name(block.cells()[first / each])),
                "only isotropic continua in small or logarithmic strains, and bars and beams in small displacements, "
                "take up stresses of another origin");
  }
  initial_stresses_.emplace_back(&block, std::move(excess));
}

bool Assembler::takes_initial_stresses() const {
  return std::ranges::any_of(blocks_->list,
                             [](const auto& block) { return block->takes_initial_stresses() && !block->has_memory(); });
}

bool Assembler::has_initial_stresses(const Eigen::VectorXd& u, const ElementField& stresses) const {
  return std::ranges::any_of(blocks_->list, [&](const auto& block) {
    return block->takes_initial_stresses() && !block->has_memory() && !excess_of(*block, u, stresses).empty();
  });
}

}  // namespace comma::solver
