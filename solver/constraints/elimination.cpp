#include "solver/constraints/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solver/constraints/selection.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

using Triplet = Eigen::Triplet<double>;

/// Longer relations are cut in messages.
constexpr std::size_t most_terms_shown = 4;

std::string origin_of(const LinearRelation& relation) { return relation.origin ? *relation.origin : "origin unknown"; }

std::string describe(const LinearRelation& relation, const Mesh& mesh) {
  std::string text;
  for (std::size_t k = 0; k < relation.terms.size(); ++k) {
    const auto& term = relation.terms[k];
    if (k == most_terms_shown) return text + " + ...";
    const double size = std::abs(term.coefficient);
    const bool first = text.empty();
    text += term.coefficient < 0.0 ? (first ? "-" : " - ") : (first ? "" : " + ");
    if (size != 1.0) text += fmt::format("{} ", size);
    text += fmt::format("{} at {}", name_of(term.component), mesh.node_name(term.node));
  }
  return text.empty() ? "0" : text;
}

/// Metres, radians, the pressure's and the change of volume: of its first term.
int unit_of(const LinearRelation& relation) {
  if (relation.terms.empty()) return 0;
  const auto component = static_cast<int>(relation.terms.front().component);
  return component < motion_count ? component / 3 : component - motion_count + 2;
}

[[noreturn]] void unknown_dof(const Mesh& mesh, const DofMap& dofs, const LinearRelation::Term& term,
                              const std::string& origin) {
  std::vector<std::string_view> carried;
  for (int k = 0; k < component_count; ++k) {
    const auto component = static_cast<Component>(k);
    if (contains(dofs.components(term.node), component)) carried.push_back(name_of(component));
  }
  throw Error(
      "unknown-dof",
      fmt::format("node {} has no component {} ({})", mesh.node_name(term.node), name_of(term.component), origin),
      carried.empty() ? "the node belongs to no finite element of the model"
                      : fmt::format("the components of this node are {}", fmt::join(carried, ", ")));
}

}  // namespace

double Elimination::Addend::value(const Point& at, double time) const {
  const double prescribed = relation->function ? relation->function(at, time) : relation->value;
  return multiplier ? multiplier(time) * prescribed : prescribed;
}

double Elimination::Condition::value(double time) const {
  double sum = reference;
  for (const Addend& addend : addends) sum += addend.value(at, time);
  return sum;
}

std::string Elimination::Condition::origin() const {
  std::vector<std::string> origins;
  for (const Addend& addend : addends) origins.push_back(origin_of(*addend.relation));
  return fmt::format("{}", fmt::join(origins, " and "));
}

Elimination::Elimination(const Mesh& mesh, const DofMap& dofs, std::span<const AppliedLoad> loads) {
  std::vector<SparseRow> rows;
  KinematicRows kinematic;
  for (const AppliedLoad& applied : loads) {
    for (const LinearRelation& relation : applied.load->relations)
      add_condition(mesh, dofs, applied, relation, rows, kinematic);
  }
  GaussJordan reduction = gauss_jordan(rows, dofs.size());
  dependencies_ = std::move(reduction.dependencies);
  set_transformation(reduction, dofs.size());
  check_constant_dependencies();
}

void Elimination::add_condition(const Mesh& mesh, const DofMap& dofs, const AppliedLoad& applied,
                                const LinearRelation& relation, std::vector<SparseRow>& rows,
                                KinematicRows& kinematic) {
  const Addend addend{applied.load, &relation, applied.multiplier};
  std::map<int, double> coefficients;
  for (const auto& term : relation.terms) {
    const int dof = dofs.dof(term.node, term.component);
    if (dof < 0) unknown_dof(mesh, dofs, term, origin_of(relation));
    coefficients[dof] += term.coefficient;
  }
  std::erase_if(coefficients, [](const auto& term) { return term.second == 0.0; });
  SparseRow row{coefficients.begin(), coefficients.end()};
  const bool constant = !relation.function && !applied.multiplier && !applied.differential;
  if (applied.load->multipliers_per_relation == 0 && row.size() == 1) {
    const auto [known, is_first] = kinematic.try_emplace(row.front().first, rows.size());
    if (!is_first && rows[known->second] == row) {
      Condition& condition = conditions_[known->second];
      condition.addends.push_back(addend);
      condition.constant = condition.constant && constant;
      if (applied.differential) condition.differential = row;
      return;
    }
  }
  const auto last = std::ranges::max_element(relation.terms, {}, &LinearRelation::Term::node);
  const Point at = last == relation.terms.end() ? Point{} : mesh.nodes[static_cast<std::size_t>(last->node)];
  conditions_.push_back({.addends = {addend},
                         .at = at,
                         .unit = unit_of(relation),
                         .text = describe(relation, mesh),
                         .constant = constant,
                         .differential = applied.differential ? row : SparseRow{}});
  rows.push_back(std::move(row));
}

void Elimination::measure_from(const Eigen::VectorXd& reference) {
  for (Condition& condition : conditions_) {
    condition.reference = 0.0;
    for (const auto& [dof, coefficient] : condition.differential) condition.reference += coefficient * reference[dof];
  }
}

void Elimination::set_transformation(const GaussJordan& reduction, int full_size) {
  std::vector<int> reduced(full_size, 0);
  for (const auto& row : reduction.rows) reduced[row.pivot] = -1;
  std::vector<Triplet> entries;
  for (int dof = 0; dof < full_size; ++dof) {
    if (reduced[dof] < 0) continue;
    reduced[dof] = static_cast<int>(kept_.size());
    entries.emplace_back(dof, reduced[dof], 1.0);
    kept_.push_back(dof);
  }
  std::vector<Triplet> offsets;
  for (const auto& row : reduction.rows) {
    for (const auto& [dof, coefficient] : row.others) entries.emplace_back(row.pivot, reduced[dof], -coefficient);
    for (const auto& [condition, factor] : row.combination) offsets.emplace_back(row.pivot, condition, factor);
  }
  transformation_.resize(full_size, static_cast<int>(kept_.size()));
  transformation_.setFromTriplets(entries.begin(), entries.end());
  selected_ = selected_unknowns(transformation_);
  offsets_.resize(full_size, static_cast<int>(conditions_.size()));
  offsets_.setFromTriplets(offsets.begin(), offsets.end());
}

Eigen::VectorXd Elimination::values(double time) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(conditions_.size()));
  for (std::size_t k = 0; k < conditions_.size(); ++k)
    result[static_cast<Eigen::Index>(k)] = conditions_[k].value(time);
  return result;
}

Eigen::VectorXd Elimination::offset(double time) const {
  const Eigen::VectorXd c = values(time);
  const Scales scales = scales_of(c);
  for (const SparseRow& dependency : dependencies_) check(dependency, c, scales, time);
  return offsets_ * c;
}

Elimination::Scales Elimination::scales_of(const Eigen::VectorXd& values) const {
  Scales scales{};
  for (std::size_t k = 0; k < conditions_.size(); ++k) {
    double& scale = scales[static_cast<std::size_t>(conditions_[k].unit)];
    scale = std::max(scale, std::abs(values[static_cast<Eigen::Index>(k)]));
  }
  return scales;
}

void Elimination::check(const SparseRow& dependency, const Eigen::VectorXd& values, const Scales& scales,
                        double time) const {
  double sum = 0.0;
  double largest = 0.0;
  double scale = 0.0;
  for (const auto& [condition, factor] : dependency) {
    sum += factor * values[condition];
    largest = std::max(largest, std::abs(factor * values[condition]));
    scale = std::max(scale, scales[static_cast<std::size_t>(conditions_[static_cast<std::size_t>(condition)].unit)]);
  }
  // Beside values of 1, a value of 1e-17 is a zero that carries rounding, as a cosine leaves it; beside a pressure of
  // 1e9 it is not.
  const double rounding = std::numeric_limits<double>::epsilon() * scale;
  if (!(std::abs(sum) <= contradiction_tolerance * largest + rounding)) contradict(dependency, values, time);
}

void Elimination::check_constant_dependencies() const {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(conditions_.size()));
  for (std::size_t k = 0; k < conditions_.size(); ++k) {
    if (conditions_[k].constant) c[static_cast<Eigen::Index>(k)] = conditions_[k].value(0.0);
  }
  const Scales scales = scales_of(c);
  for (const SparseRow& dependency : dependencies_) {
    const bool constant = std::all_of(dependency.begin(), dependency.end(),
                                      [this](const auto& term) { return conditions_[term.first].constant; });
    if (constant) check(dependency, c, scales, 0.0);
  }
}

void Elimination::contradict(const SparseRow& dependency, const Eigen::VectorXd& values, double time) const {
  std::vector<std::string> parts;
  bool constant = true;
  for (const auto& term : dependency) {
    const Condition& condition = conditions_[term.first];
    constant = constant && condition.constant;
    parts.push_back(fmt::format("{} = {} ({})", condition.text, values[term.first], condition.origin()));
  }
  const std::string when = constant ? std::string() : fmt::format(" at time {}", time);
  if (parts.size() == 1) {
    throw Error("contradictory-conditions", fmt::format("a condition cannot hold{}: {}", when, parts.front()),
                "its left-hand side is zero whatever the displacements: correct its coefficients or its value");
  }
  if (parts.size() > most_terms_shown) {
    const std::size_t more = parts.size() - most_terms_shown;
    // The relation that closed the chain is among the last; the first ones are what it meets.
    parts.erase(parts.begin() + most_terms_shown / 2, parts.end() - most_terms_shown / 2);
    parts.push_back(fmt::format("{} more", more));
  }
  throw Error("contradictory-conditions",
              fmt::format("conditions contradict each other{}: {}", when, fmt::join(parts, "; ")),
              "remove one of them, or give them values that agree");
}

SymmetricMatrix Elimination::reduce(SymmetricMatrix stiffness) const {
  if (!selected_.empty()) return select_unknowns(std::move(stiffness), selected_);
  if (!plan_ || !plan_->fits(stiffness)) plan_ = std::make_unique<Congruence>(stiffness, transformation_);
  return plan_->apply(stiffness);
}

SkewMatrix Elimination::reduce_skew(const SkewMatrix& stiffness) const {
  // With W = L - L^T: T^T W T = R - R^T, R = T^T L T.
  const SkewMatrix transposed_transformation = transformation_.transpose();
  const SkewMatrix right = stiffness * transformation_;
  const SkewMatrix half = transposed_transformation * right;
  const SkewMatrix mirrored = half.transpose();
  const SkewMatrix reduced = half - mirrored;
  return reduced.triangularView<Eigen::StrictlyLower>();
}

}  // namespace comma::solver
