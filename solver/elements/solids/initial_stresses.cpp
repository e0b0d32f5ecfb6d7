// The part of Assembler that goes on from stresses which are not those of the displacements.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "solver/elements/assembler_blocks.hpp"
#include "solver/elements/block_fields.hpp"
#include "solver/error.hpp"
#include "solver/fields/stresses/plate_stresses.hpp"

namespace comma::solver {

namespace {

/// Initial stresses agree with those of the displacements up to this share: both have been through fields and files.
constexpr double initial_stress_tolerance = 1e-6;
/// Of the largest of all: below, nothing is left of what cancels.
constexpr double stress_rounding = 1e-12;

/// `largest`: of the known ones of its kind; `least`: what all rounding is below.
bool is_rounding(double found, double known, double largest, double least) {
  return std::abs(found - known) <= std::max(least, initial_stress_tolerance * std::max(largest, std::abs(found)));
}

bool is_of_plates(const ElementBlock& block) { return block.force_point_count(PlatePlaces::corners) > 0; }

/// Values of some cells, one after the other, to those of a field that has as many there.
void add_on_cells(std::span<const int> cells, const std::vector<double>& values, ElementField& field) {
  const double* value = values.data();
  const std::size_t width = field.components.size();
  for (const int cell : cells)
    for (std::size_t k = static_cast<std::size_t>(field.starts[cell]) * width;
         k < static_cast<std::size_t>(field.starts[cell + 1]) * width; ++k)
      field.values[k] += *value++;
}

}  // namespace

std::vector<double> Assembler::InitialStresses::now(const VariableState& state) const {
  if (moduli.empty()) return values;
  std::vector<double> scaled = values, young(moduli.size());
  block->write_moduli(state, young);
  const std::size_t each = values.size() / moduli.size();
  for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] *= young[k / each] / moduli[k / each];
  return scaled;
}

Eigen::VectorXd Assembler::with_initial(Eigen::VectorXd forces) const {
  if (initial_forces_.size() > 0) forces += initial_forces_;
  return forces;
}

std::vector<double> Assembler::stresses_in(const ElementBlock& block, const Eigen::VectorXd& u,
                                           const ImposedStrains* imposed) const {
  std::vector<double> values = stresses_of(block, u, state_, imposed);
  for (const InitialStresses& initial : initial_stresses_)
    if (initial.block == &block) std::ranges::transform(values, initial.now(state_), values.begin(), std::plus<>());
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
      block->resume(u, state_, {}, {});
      continue;
    }
    block->resume(u, state_, read_stresses(*block, stresses, *model_.mesh),
                  read_block(*block, variable_names(block->variable_count()), variables, *model_.mesh));
  }
  sum_initial_forces();
}

void Assembler::begin_without_forces(const Eigen::VectorXd& u) {
  for (const auto& block : blocks_->list) {
    const Formulation formulation = model_.formulations[static_cast<std::size_t>(block->cells().front())];
    if (block->has_memory() || continuum_dimension(formulation) > 0 || is_of_plates(*block) ||
        !block->takes_initial_stresses())
      continue;
    std::vector<double> values = stresses_of(*block, u, state_, imposed_.get());
    if (std::ranges::all_of(values, [](double value) { return value == 0.0; })) continue;
    for (double& value : values) value = -value;
    add_initial_stresses(*block, std::move(values));
  }
  sum_initial_forces();
}

void Assembler::add_initial_stresses(const ElementBlock& block, std::vector<double> values) {
  InitialStresses& added = initial_stresses_.emplace_back(&block, std::move(values));
  if (!block.scales_initial_stresses()) return;
  added.moduli.resize(block.cells().size());
  block.write_moduli(state_, added.moduli);
}

// In elements without a memory forces of given stresses do not depend on the displacements.
void Assembler::sum_initial_forces() {
  if (initial_stresses_.empty()) return;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(dofs_.size());
  std::vector<long double> sums(static_cast<std::size_t>(dofs_.size()), 0.0L);
  for (const InitialStresses& initial : initial_stresses_)
    initial.block->add_forces_of_stresses(none, state_, initial.now(state_), sums);
  initial_forces_ = rounded(sums);
}

// What the field has beyond the stresses of the displacements, of plates beyond their forces; empty where that is
// nothing.
std::vector<double> Assembler::excess_of(const ElementBlock& block, const Eigen::VectorXd& u,
                                         const ElementField& given) const {
  if (is_of_plates(block)) return excess_of_plates(block, u, given);
  std::vector<double> excess = read_stresses(block, &given, *model_.mesh);
  const std::vector<double> known = stresses_of(block, u, state_, imposed_.get());
  // Forces and moments have units of their own.
  const auto names = block.stress_names();
  const auto is_moment = [&](std::size_t k) { return names[k % names.size()].starts_with('M') ? 1 : 0; };
  std::array<double, 2> largest = {0.0, 0.0};
  for (std::size_t k = 0; k < known.size(); ++k)
    largest[is_moment(k)] = std::max(largest[is_moment(k)], std::abs(known[k]));
  const double rounding = stress_rounding * std::max(largest[0], largest[1]);
  bool is_all = true;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const bool is_same = is_rounding(excess[k], known[k], largest[is_moment(k)], rounding);
    excess[k] = is_same ? 0.0 : excess[k] - known[k];
    is_all = is_all && is_same;
  }
  return is_all ? std::vector<double>() : excess;
}

// By stresses, as fields have them: what a small force is beside a large moment follows from the thickness.
std::vector<double> Assembler::excess_of_plates(const ElementBlock& block, const Eigen::VectorXd& u,
                                                const ElementField& given) const {
  const ElementField of_displacements = plate_forces(u, PlatePlaces::integration_points, imposed_.get());
  const ElementField field = plate_stresses(model_, properties_, of_displacements);
  const std::vector<double> found = values_on(block.cells(), field, given, *model_.mesh);
  const std::vector<double> known = values_on(block.cells(), field, field, *model_.mesh);
  double largest = 0.0;
  for (const double value : known) largest = std::max(largest, std::abs(value));
  bool is_all = true;
  for (std::size_t k = 0; k < known.size(); ++k)
    is_all = is_all && is_rounding(found[k], known[k], largest, stress_rounding * largest);
  if (is_all) return {};
  std::vector<double> excess;
  std::size_t begin = 0;
  for (const int cell : block.cells()) {
    const PlateSection& section = properties_.plates.at(cell);
    const auto each = static_cast<std::size_t>(field.values_a_point(cell)) * field.components.size();
    for (int point = 0; point < block.force_point_count(PlatePlaces::integration_points); ++point, begin += each) {
      const auto forces = forces_of_plate_stresses(section, std::span(found).subspan(begin, each));
      if (!forces)
        throw Error("unsupported",
                    fmt::format("the initial stresses of plate {} are not those of an elastic plate",
                                model_.mesh->cell_name(cell)),
                    "give SIXX, SIYY and SIXY that are linear through the thickness, SIXZ and SIYZ as a parabola that "
                    "vanishes on both faces, and SIZZ = 0, as SIEF_ELGA has them");
      PlateForces beside = *forces;
      for (int k = 0; k < static_cast<int>(beside.size()); ++k) beside[k] -= of_displacements.at(cell, point, k);
      excess.insert(excess.end(), beside.begin(), beside.end());
    }
  }
  return excess;
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
                "only isotropic continua in small or logarithmic strains, and springs, bars, beams and plates in small "
                "displacements, take up stresses of another origin");
  }
  add_initial_stresses(block, std::move(excess));
}

ElementField Assembler::with_initial(ElementField plate_forces) const {
  for (const InitialStresses& initial : initial_stresses_)
    if (is_of_plates(*initial.block)) add_on_cells(initial.block->cells(), initial.values, plate_forces);
  return plate_forces;
}

std::optional<ElementField> Assembler::plate_forces_beside(const Eigen::VectorXd& u,
                                                           const ElementField& stresses) const {
  std::optional<ElementField> beside;
  for (const auto& block : blocks_->list) {
    if (!is_of_plates(*block)) continue;
    const std::vector<double> excess = excess_of(*block, u, stresses);
    if (excess.empty()) continue;
    if (!beside) {
      beside = plate_forces(u, PlatePlaces::integration_points, nullptr);
      std::ranges::replace_if(
          beside->values, [](double value) { return !std::isnan(value); }, 0.0);
    }
    add_on_cells(block->cells(), excess, *beside);
  }
  return beside;
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
