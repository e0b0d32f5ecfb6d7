#include "solver/elements/external_forces.hpp"

#include <array>

#include <fmt/format.h>

#include "solver/elements/inertia_forces.hpp"
#include "solver/elements/plates/plate_axes.hpp"
#include "solver/elements/slender/slender_forces.hpp"
#include "solver/error.hpp"
#include "solver/mesh/place.hpp"

namespace comma::solver {

void check_pressure(const Model& model, const PressureLoad& load) {
  const Mesh& mesh = *model.mesh;
  const int skin = dimension(mesh.cell_types[load.cell]);
  const int body = continuum_dimension(model.formulations[load.cell]);
  const bool plate = is_plate(model.formulations[load.cell]) && !model.is_skin(load.cell);
  if (!plate && (body == 0 || skin != body - 1)) {
    throw Error(
        "not-a-skin",
        fmt::format(
            "pressure is applied to cell {}, a {}, which is neither on the boundary of a body of the model nor a plate",
            mesh.cell_name(load.cell), name_of(mesh.cell_types[load.cell])));
  }
  if (skin == 2 && (load.shear != 0.0 || load.shear_function)) {
    throw Error("unsupported", fmt::format("shear is given on face {}, but it is defined on plane edges alone",
                                           mesh.cell_name(load.cell)));
  }
}

namespace {

double interpolated(const NodalFunction& function, std::span<const int> nodes, const CellSample& sample, double time) {
  double value = 0.0;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    value += sample.values[static_cast<Eigen::Index>(a)] * function(nodes[a], time);
  return value;
}

}  // namespace

double pressure_at(const PressureLoad& load, const Mesh& mesh, const CellSample& sample, const Point& at, double time) {
  if (load.pressure_at_nodes) return interpolated(load.pressure_at_nodes, mesh.cell(load.cell), sample, time);
  return load.pressure_function ? load.pressure_function(at, time) : load.pressure;
}

namespace {

constexpr std::array<std::string_view, 3> axis_names = {"X", "Y", "Z"};

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

/// Components of a load at a place, its functions evaluated there.
template <std::size_t N>
Eigen::Matrix<double, static_cast<int>(N), 1> values_at(const std::array<double, N>& values,
                                                        const std::array<FieldFunction, N>& functions, const Point& at,
                                                        double time) {
  Eigen::Matrix<double, static_cast<int>(N), 1> result;
  for (std::size_t c = 0; c < N; ++c) result[static_cast<int>(c)] = functions[c] ? functions[c](at, time) : values[c];
  return result;
}

}  // namespace

void check_distributed_force(const Model& model, const DistributedForce& load) {
  const Mesh& mesh = *model.mesh;
  const int body = continuum_dimension(model.formulations[load.cell]);
  const int type_dimension = dimension(mesh.cell_types[load.cell]);
  if (is_plate(model.formulations[load.cell])) return;
  if (body == 0 || type_dimension == 0 || type_dimension > body) {
    throw Error("unsupported",
                fmt::format("a distributed force acts on cell {}, a {}, which is no part of a continuum of the model",
                            mesh.cell_name(load.cell), name_of(mesh.cell_types[load.cell])));
  }
  for (int c = body; c < 3; ++c) {
    if (load.force[c] == 0.0 && !load.functions[c] && !load.functions_at_nodes[c]) continue;
    throw Error("unknown-dof",
                fmt::format("a force along {} acts on cell {}, whose nodes have no such degree of freedom",
                            axis_names[c], mesh.cell_name(load.cell)));
  }
}

Eigen::Vector3d distributed_force_at(const DistributedForce& load, const Mesh& mesh, const CellSample& sample,
                                     const Point& at, double time) {
  Eigen::Vector3d density = values_at(load.force, load.functions, at, time);
  for (int c = 0; c < 3; ++c)
    if (const NodalFunction& function = load.functions_at_nodes[static_cast<std::size_t>(c)])
      density[c] = interpolated(function, mesh.cell(load.cell), sample, time);
  return density;
}

namespace {

/// Sums forces over edges, faces and volumes.
class CellIntegrator {
 public:
  CellIntegrator(const ForceInput& input, double time, std::span<long double> forces)
      : input_(input), mesh_(*input.model.mesh), time_(time), forces_(forces) {}

  void add(const PressureLoad& load, double factor) {
    check_pressure(input_.model, load);
    const int cell_dimension = dimension(mesh_.cell_types[load.cell]);
    integrate(load.cell, of_skin(load.cell), [&](const CellPoint& point, const CellSample& sample) -> Eigen::Vector3d {
      const Point at = to_point(point.at);
      const double pressure = pressure_at(load, mesh_, sample, at, time_);
      const double shear = load.shear_function ? load.shear_function(at, time_) : load.shear;
      return factor * (shear * point.tangents.col(0) - pressure * point.normal(cell_dimension));
    });
  }

  void add(const DistributedForce& load, double factor) {
    check_distributed_force(input_.model, load);
    const int cell_dimension = dimension(mesh_.cell_types[load.cell]);
    // Forces in a body are integrated where its stresses are (ssnv263c), those on a plate as its pressure; gravity and
    // centrifugal forces with the mass.
    const CellType type = mesh_.cell_types[load.cell];
    const Formulation formulation = input_.model.formulations[load.cell];
    const bool on_surface = input_.model.is_skin(load.cell) || is_plate(formulation);
    const auto& samples = on_surface ? of_skin(load.cell) : samples_.of_stiffness(type, formulation);
    integrate(load.cell, samples, [&](const CellPoint& point, const CellSample& sample) -> Eigen::Vector3d {
      return factor * point.measure(cell_dimension) *
             distributed_force_at(load, mesh_, sample, to_point(point.at), time_);
    });
  }

  void add(const PlateForce& load, double factor) {
    const PlateSection& section = plate_section(load.cell);
    const Eigen::Matrix3d axes = plate_axes(mesh_, load.cell, section);
    const Eigen::Matrix3d to_mesh = load.in_own_axes ? Eigen::Matrix3d(axes.transpose()) : Eigen::Matrix3d::Identity();
    const Eigen::Vector3d arm = height_of(load.level, section) * axes.row(2).transpose();
    const auto density = [&](const CellPoint& point) -> Vector6 {
      const Vector6 given =
          point.measure(2) * factor * values_at(load.force, load.functions, to_point(point.at), time_);
      Vector6 acting;
      acting.head<3>() = to_mesh * given.head<3>();
      acting.tail<3>() = to_mesh * given.tail<3>() + arm.cross(acting.head<3>());
      return acting;
    };
    const NodeColumns places = node_places(mesh_, load.cell);
    const auto nodes = mesh_.cell(load.cell);
    for (const CellSample& sample : of_skin(load.cell)) {
      const Vector6 acting = sample.weight * density(locate(places, sample));
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (int c = 0; c < 6; ++c)
          forces_[input_.dofs.dof(nodes[a], static_cast<Component>(c))] +=
              sample.values[static_cast<Eigen::Index>(a)] * acting[c];
    }
  }

  void add(const GravityLoad& load, double factor) {
    add_inertia(load.cells, gravity_field(load, input_.model), factor);
  }

  void add(const RotationLoad& load, double factor) {
    add_inertia(load.cells, centrifugal_field(load, input_.model), factor);
  }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  const PlateSection& plate_section(int cell) const {
    const auto found = input_.properties.plates.find(cell);
    if (found != input_.properties.plates.end()) return found->second;
    throw Error(
        "missing-properties",
        fmt::format("a force in the thickness or in the own axes of a plate acts on cell {}, which has no thickness",
                    mesh_.cell_name(cell)));
  }

  /// From the surface of the mesh, along the normal.
  static double height_of(PlateLevel level, const PlateSection& section) {
    switch (level) {
      case PlateLevel::mesh:
        break;
      case PlateLevel::middle:
        return section.offset;
      case PlateLevel::upper:
        return section.offset + 0.5 * section.thickness;
      case PlateLevel::lower:
        return section.offset - 0.5 * section.thickness;
    }
    return 0.0;
  }

  const std::vector<CellSample>& of_skin(int cell) {
    const bool is_edge = dimension(mesh_.cell_types[cell]) == 1 && input_.model.is_skin(cell) &&
                         continuum_dimension(input_.model.formulations[cell]) == 3;
    return samples_.of(mesh_.cell_types[cell], is_edge ? CellRole::edge : CellRole::skin);
  }

  /// `density`(point, sample): force for a unit of reference measure at a point.
  template <class F>
  void integrate(int cell, const std::vector<CellSample>& samples, F&& density) {
    const bool axisymmetric = is_axisymmetric(input_.model.formulations[cell]);
    const NodeColumns places = node_places(mesh_, cell);
    NodeColumns nodal = NodeColumns::Zero(3, places.cols());
    for (const CellSample& sample : samples) {
      const CellPoint point = locate(places, sample);
      const Eigen::Vector3d force = (axisymmetric ? point.at[0] : 1.0) * sample.weight * density(point, sample);
      nodal += force.lazyProduct(sample.values.transpose());
    }
    for (Eigen::Index a = 0; a < nodal.cols(); ++a) add_to_node(mesh_.cell(cell)[a], nodal.col(a));
  }

  void add_inertia(std::span<const int> cells, const AccelerationField& field, double factor) {
    for (const int cell : cells) add_inertia_forces(input_, cell, field, factor, samples_, forces_);
  }

  void add_to_node(int node, const Eigen::Vector3d& force) {
    for (int c = 0; c < 3; ++c) {
      const int dof = input_.dofs.dof(node, static_cast<Component>(c));
      if (dof >= 0) forces_[dof] += force[c];
    }
  }

  const ForceInput& input_;
  const Mesh& mesh_;
  double time_;
  std::span<long double> forces_;
  CellSamples samples_;
};

void add_beam_force(const ForceInput& input, const BeamForce& load, double factor, double time,
                    std::span<long double> forces) {
  const Mesh& mesh = *input.model.mesh;
  const Formulation formulation = input.model.formulations[load.cell];
  if (input.model.components_of(load.cell) == 0 || (!is_beam(formulation) && !is_bar(formulation))) {
    throw Error("not-a-beam",
                fmt::format("a beam's force acts on cell {}, which is no bar or beam", mesh.cell_name(load.cell)));
  }
  const Eigen::Matrix3d axes = slender_axes(input, load.cell);
  std::array<Eigen::Matrix<double, 6, 1>, 2> at_ends;
  for (int end = 0; end < 2; ++end) {
    at_ends[end] = factor * values_at(load.force, load.functions, mesh.nodes[mesh.cell(load.cell)[end]], time);
    if (load.axes == BeamAxes::own) continue;
    at_ends[end].head<3>() = (axes * at_ends[end].head<3>()).eval();
    at_ends[end].tail<3>() = (axes * at_ends[end].tail<3>()).eval();
  }
  add_force_per_length(input, load.cell, at_ends, forces);
}

}  // namespace

void add_external_forces(const ForceInput& input, std::span<const AppliedLoad> loads, double time,
                         std::span<long double> forces) {
  CellIntegrator integrator(input, time, forces);
  for (const AppliedLoad& applied : loads) {
    const Load& load = *applied.load;
    const double factor = applied.multiplier ? applied.multiplier(time) : 1.0;
    for (const auto& force : load.nodal_forces)
      add_nodal_force(*input.model.mesh, input.dofs, force, factor, time, forces);
    for (const auto& pressure : load.pressures) integrator.add(pressure, factor);
    for (const auto& force : load.distributed_forces) integrator.add(force, factor);
    for (const auto& force : load.plate_forces) integrator.add(force, factor);
    for (const auto& force : load.beam_forces) add_beam_force(input, force, factor, time, forces);
    for (const auto& gravity : load.gravities) integrator.add(gravity, factor);
    for (const auto& rotation : load.rotations) integrator.add(rotation, factor);
  }
}

}  // namespace comma::solver
