#include "solver/elements/external_forces.hpp"

#include <array>

#include <fmt/format.h>

#include "solver/elements/quadrature.hpp"
#include "solver/elements/reference_element.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Shape functions of a skin cell type at the points of its family.
struct SkinSample {
  double weight;
  Eigen::VectorXd values;
  Eigen::MatrixXd derivatives;
};

using SkinSamples = std::array<std::vector<SkinSample>, cell_type_count>;

const std::vector<SkinSample>& samples_of(CellType type, SkinSamples& known) {
  auto& samples = known[static_cast<std::size_t>(type)];
  if (samples.empty()) {
    for (const auto& point : quadrature(type, boundary_family(type))) {
      samples.push_back({point.weight, shape_functions(type, point.at), shape_derivatives(type, point.at)});
    }
  }
  return samples;
}

void add_nodal_force(const Mesh& mesh, const DofMap& dofs, const NodalForce& force, double factor, double time,
                     std::span<long double> forces) {
  const int dof = dofs.dof(force.node, force.component);
  if (dof < 0) {
    throw Error("unknown-dof", fmt::format("a force is applied to {} at node {}, which has no such degree of freedom",
                                           name_of(force.component), mesh.node_name(force.node)));
  }
  const double value = force.function ? force.function(mesh.nodes[force.node], time) : force.value;
  forces[dof] += static_cast<long double>(factor) * value;
}

class PressureIntegrator {
 public:
  PressureIntegrator(const Model& model, const DofMap& dofs, double time, std::span<long double> forces)
      : model_(model), mesh_(*model.mesh), dofs_(dofs), time_(time), forces_(forces) {}

  void add(const PressureLoad& load, double factor) {
    check(load);
    const auto nodes = mesh_.cell(load.cell);
    for (const SkinSample& sample : samples_of(mesh_.cell_types[load.cell], samples_)) {
      const Eigen::Vector3d traction = factor * sample.weight * weighted_traction(load, sample);
      for (std::size_t a = 0; a < nodes.size(); ++a) add_to_node(nodes[a], sample.values[a] * traction);
    }
  }

 private:
  void check(const PressureLoad& load) const {
    const int skin = dimension(mesh_.cell_types[load.cell]);
    const int body = continuum_dimension(model_.formulations[load.cell]);
    if (body == 0 || skin != body - 1) {
      throw Error("not-a-skin", fmt::format("pressure is applied to cell {}, a {}, which is not on the boundary of a body of the model",
                                            mesh_.cell_name(load.cell), name_of(mesh_.cell_types[load.cell])));
    }
    if (skin == 2 && (load.shear != 0.0 || load.shear_function)) {
      throw Error("unsupported", fmt::format("shear is given on face {}, but it is defined on plane edges alone",
                                             mesh_.cell_name(load.cell)));
    }
  }

  /// Traction times the surface element that belongs to a unit of reference measure.
  Eigen::Vector3d weighted_traction(const PressureLoad& load, const SkinSample& sample) const {
    const auto nodes = mesh_.cell(load.cell);
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const Eigen::Map<const Eigen::Vector3d> node(mesh_.nodes[nodes[a]].data());
      at += sample.values[a] * node;
      for (int j = 0; j < sample.derivatives.cols(); ++j) tangents.col(j) += sample.derivatives(a, j) * node;
    }
    const Point place = {at[0], at[1], at[2]};
    const double pressure = load.pressure_function ? load.pressure_function(place, time_) : load.pressure;
    if (sample.derivatives.cols() == 2) return -pressure * tangents.col(0).cross(tangents.col(1));
    const double shear = load.shear_function ? load.shear_function(place, time_) : load.shear;
    const Eigen::Vector3d along = tangents.col(0);
    const Eigen::Vector3d outward(along[1], -along[0], 0.0);
    const double radius = is_axisymmetric(model_.formulations[load.cell]) ? at[0] : 1.0;
    return radius * (shear * along - pressure * outward);
  }

  void add_to_node(int node, const Eigen::Vector3d& force) {
    for (int c = 0; c < 3; ++c) {
      const int dof = dofs_.dof(node, static_cast<Component>(c));
      if (dof >= 0) forces_[dof] += force[c];
    }
  }

  const Model& model_;
  const Mesh& mesh_;
  const DofMap& dofs_;
  double time_;
  std::span<long double> forces_;
  SkinSamples samples_;
};

}  // namespace

void add_external_forces(const Model& model, const DofMap& dofs, std::span<const AppliedLoad> loads, double time,
                         std::span<long double> forces) {
  PressureIntegrator pressures(model, dofs, time, forces);
  for (const AppliedLoad& applied : loads) {
    const double factor = applied.multiplier ? applied.multiplier(time) : 1.0;
    for (const auto& force : applied.load->nodal_forces) add_nodal_force(*model.mesh, dofs, force, factor, time, forces);
    for (const auto& pressure : applied.load->pressures) pressures.add(pressure, factor);
  }
}

}  // namespace comma::solver
