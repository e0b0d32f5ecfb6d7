#include "solver/nonlinear/iterations/reference_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/contact/extent.hpp"
#include "solver/elements/quadrature.hpp"
#include "solver/elements/solids/corner_unknowns.hpp"
#include "solver/error.hpp"
#include "solver/fields/points/continuum_points.hpp"

namespace comma::solver {
namespace {

using Eigen::VectorXd;

constexpr std::array<Component, 3> rotations = {Component::drx, Component::dry, Component::drz};

/// Internal forces below this share of the largest are rounding.
constexpr double vanishing_force = 1e-12;
/// More than any force.
constexpr double unknown = std::numeric_limits<double>::infinity();

class Summation {
 public:
  Summation(const Model& model, const DofMap& dofs, const ReferenceEfforts& efforts)
      : model_(model),
        mesh_(*model.mesh),
        dofs_(dofs),
        efforts_(efforts),
        points_(model),
        least_(VectorXd::Constant(dofs.size(), unknown)) {}

  VectorXd of_all() {
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      if (model_.formulations[static_cast<std::size_t>(cell)] == Formulation::none) continue;
      if (points_.covers(cell))
        add_continuum(cell);
      else if (!model_.is_skin(cell))
        add_structure(cell);
    }
    return (least_.array() < unknown).select(least_, 0.0);
  }

 private:
  void require(double effort, int cell, const char* keyword) const {
    if (effort > 0.0) return;
    throw Error("missing-reference",
                fmt::format("RESI_REFE_RELA: the element on cell {} needs {}", mesh_.cell_name(cell), keyword),
                fmt::format("give {}", keyword));
  }

  void add_least(int node, Component component, double force) {
    const int dof = dofs_.dof(node, component);
    if (dof >= 0) least_[dof] = std::min(least_[dof], force);
  }

  void add_continuum(int cell) {
    require(efforts_.stress, cell, "SIGM_REFE");
    const auto nodes = mesh_.cell(cell);
    VectorXd forces = VectorXd::Zero(static_cast<Eigen::Index>(nodes.size())), round = forces;
    for (const ContinuumSample& sample : points_.samples(cell)) {
      const ContinuumPoint point = points_.locate(cell, sample);
      const double weight = efforts_.stress * std::abs(point.weight);
      forces += weight * point.gradients.cwiseAbs().rowwise().sum();
      if (is_axisymmetric(model_.formulations[static_cast<std::size_t>(cell)]))
        round += weight / point.at[0] * sample.values.cwiseAbs();
    }
    if (model_.corner_components_of(cell) != 0) return add_mixed(cell, forces);
    const auto points = static_cast<double>(points_.samples(cell).size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      for (const Component component : translation_components)
        add_least(nodes[i], component, (forces[at] + (component == Component::dx ? round[at] : 0.0)) / points);
    }
  }

  /// Code_Aster takes the mean over the components of the stress, SIP among them, where other elements take it over
  /// their points (docs/conformance/convergence.md). The balance of the pressure is one of strains, that of the
  /// swelling one of stresses: integrals of both times the shape functions of the corners.
  void add_mixed(int cell, const VectorXd& forces) {
    const double components = continuum_dimension(model_.formulations[static_cast<std::size_t>(cell)]) == 3 ? 7.0 : 5.0;
    for (Eigen::Index i = 0; i < forces.size(); ++i)
      for (const Component component : translation_components)
        add_least(mesh_.cell(cell)[static_cast<std::size_t>(i)], component, forces[i] / components);
    require(efforts_.strain, cell, "EPSI_REFE");
    const CellType type = mesh_.cell_types[static_cast<std::size_t>(cell)];
    const Quadrature rule =
        quadrature(type, stiffness_family(type, model_.formulations[static_cast<std::size_t>(cell)]));
    const CellType linear = linear_cell(model_, cell);
    VectorXd volumes = VectorXd::Zero(corner_count(type));
    for (std::size_t g = 0; g < rule.size(); ++g)
      volumes += points_.locate(cell, points_.samples(cell)[g]).weight * shape_functions(linear, rule[g].at);
    for (Eigen::Index i = 0; i < volumes.size(); ++i) {
      const int node = mesh_.cell(cell)[static_cast<std::size_t>(i)];
      add_least(node, Component::pressure, efforts_.strain * std::abs(volumes[i]));
      add_least(node, Component::swelling, efforts_.stress * std::abs(volumes[i]));
    }
  }

  /// Resultants of plates are forces and moments a length.
  void add_structure(int cell) {
    require(efforts_.force, cell, "EFFORT_REFE");
    const auto nodes = mesh_.cell(cell);
    const bool turns = std::ranges::any_of(rotations, [&](Component each) { return dofs_.dof(nodes[0], each) >= 0; });
    if (turns) require(efforts_.moment, cell, "MOMENT_REFE");
    const double length = is_plate(model_.formulations[static_cast<std::size_t>(cell)]) ? extent(mesh_, cell) : 1.0;
    for (const int node : nodes) {
      for (const Component component : translation_components) add_least(node, component, efforts_.force * length);
      for (const Component component : rotations) add_least(node, component, efforts_.moment * length);
    }
  }

  const Model& model_;
  const Mesh& mesh_;
  const DofMap& dofs_;
  const ReferenceEfforts& efforts_;
  ContinuumPoints points_;
  VectorXd least_;
};

}  // namespace

VectorXd reference_forces(const Model& model, const DofMap& dofs, const ReferenceEfforts& efforts) {
  return Summation(model, dofs, efforts).of_all();
}

ReferenceForces::ReferenceForces(const Model& model, const DofMap& dofs, const Elimination& elimination,
                                 const NewtonOptions& options)
    : dofs_(dofs) {
  if (options.referred_residual) all_ = reference_forces(model, dofs, options.reference);
  renumber(elimination);
}

void ReferenceForces::renumber(const Elimination& elimination) {
  kinds_.clear();
  for (const int dof : elimination.kept()) kinds_.push_back(static_cast<int>(dofs_.component_of(dof)));
  if (all_.size() == 0) return;
  reduced_ = all_(elimination.kept());
}

namespace {

double largest_share(const VectorXd& forces, const VectorXd& references) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < references.size(); ++i)
    if (references[i] > 0.0) largest = std::max(largest, std::abs(forces[i]) / references[i]);
  return largest;
}

}  // namespace

double ReferenceForces::share(const VectorXd& residual) const { return largest_share(residual, reduced_); }

double ReferenceForces::share_of_all(const VectorXd& forces) const { return largest_share(forces, all_); }

void ReferenceForces::begin_step(const VectorXd& internal_forces) {
  largest_.fill(0.0);
  for (int dof = 0; dof < dofs_.size(); ++dof) {
    if (!is_motion(dofs_.component_of(dof))) continue;
    double& largest = largest_[static_cast<std::size_t>(dofs_.component_of(dof))];
    largest = std::max(largest, std::abs(internal_forces[dof]));
  }
  double pushed = 0.0;
  for (const Component each : translation_components)
    pushed = std::max(pushed, largest_[static_cast<std::size_t>(each)]);
  for (const Component each : {Component::pressure, Component::swelling})
    largest_[static_cast<std::size_t>(each)] = pushed;
}

double ReferenceForces::share_of_kind(double force, int kind) const {
  const double of_all = std::ranges::max(largest_);
  const double own = largest_[static_cast<std::size_t>(kind)];
  return std::abs(force) / (own > vanishing_force * of_all ? own : of_all);
}

std::optional<double> ReferenceForces::share_by_component(const VectorXd& residual) const {
  if (!(std::ranges::max(largest_) > 0.0)) return std::nullopt;
  double share = 0.0;
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    share = std::max(share, share_of_kind(residual[i], kinds_[static_cast<std::size_t>(i)]));
  return share;
}

std::optional<double> ReferenceForces::share_by_component_of_all(const VectorXd& forces) const {
  if (!(std::ranges::max(largest_) > 0.0)) return std::nullopt;
  double share = 0.0;
  for (int dof = 0; dof < forces.size(); ++dof)
    share = std::max(share, share_of_kind(forces[dof], static_cast<int>(dofs_.component_of(dof))));
  return share;
}

}  // namespace comma::solver
