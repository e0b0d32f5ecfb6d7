#include "solver/fields/stresses/beam_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "solver/elements/slender/rotating_beam.hpp"
#include "solver/elements/slender/slender_forces.hpp"
#include "solver/fields/points/extrapolation.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

/// The loads between the ends of each beam.
class SpanLoads {
 public:
  SpanLoads(const Model& model, std::span<const AppliedLoad> loads) : model_(model) {
    for (const AppliedLoad& applied : loads) {
      for (const BeamForce& force : applied.load->beam_forces) {
        if (Load* load = new_load(force.cell, applied)) load->beam_forces.push_back(force);
      }
      for (const GravityLoad& gravity : applied.load->gravities) {
        for (const int cell : gravity.cells) {
          if (Load* load = new_load(cell, applied)) load->gravities.push_back({{cell}, gravity.acceleration});
        }
      }
      for (const RotationLoad& rotation : applied.load->rotations) {
        for (const int cell : rotation.cells) {
          if (Load* load = new_load(cell, applied)) {
            load->rotations.push_back({{cell}, rotation.speed, rotation.axis, rotation.centre});
          }
        }
      }
    }
  }

  const std::map<int, std::vector<AppliedLoad>>& by_cell() const { return by_cell_; }

 private:
  /// A load of one cell alone; null where the cell is no beam.
  Load* new_load(int cell, const AppliedLoad& applied) {
    if (!is_beam(model_.formulations[cell])) return nullptr;
    auto load = std::make_shared<Load>();
    by_cell_[cell].push_back({load, applied.multiplier});
    return load.get();
  }

  const Model& model_;
  std::map<int, std::vector<AppliedLoad>> by_cell_;
};

}  // namespace

TurnedAxes turned_axes(const Model& model, const BehaviourOfCells& behaviours, const NodalField& displacement,
                       const ElementField* variables) {
  const Mesh& mesh = *model.mesh;
  const std::array columns = {displacement.component("DX"), displacement.component("DY"), displacement.component("DZ")};
  const auto place = [&](int node) {
    Eigen::Vector3d at = Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(node)].data());
    for (int c = 0; c < 3; ++c) at[c] += displacement.at(node, columns[static_cast<std::size_t>(c)]);
    return at;
  };
  TurnedAxes axes;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!is_rotating_beam(model.formulations[static_cast<std::size_t>(cell)],
                          behaviours[static_cast<std::size_t>(cell)].kinematics))
      continue;
    const auto nodes = mesh.cell(cell);
    std::array<double, rotating_beam_variables> own{};
    if (variables != nullptr && variables->points(cell) > 0)
      for (int v = 0; v < std::min<int>(own.size(), variables->components.size()); ++v)
        own[static_cast<std::size_t>(v)] = variables->at(cell, 0, v);
    axes.emplace(cell, rotated_axes(place(nodes[1]) - place(nodes[0]), own));
  }
  return axes;
}

ElementField end_section_forces(const ForceInput& input, const ElementField& at_nodes,
                                std::span<const AppliedLoad> loads, double time, const TurnedAxes& turned) {
  ElementField field = section_forces(at_nodes);
  std::array<int, 6> columns;
  for (int c = 0; c < 6; ++c) columns[c] = field.component(beam_force_names[c]);
  const SpanLoads spans(input.model, loads);
  std::vector<long double> forces(static_cast<std::size_t>(input.dofs.size()), 0.0L);
  for (const auto& [cell, own_loads] : spans.by_cell()) {
    if (field.points(cell) != 2) continue;
    add_external_forces(input, own_loads, time, forces);
    const auto now = turned.find(cell);
    const Eigen::Matrix3d axes = now == turned.end() ? slender_axes(input, cell) : now->second;
    for (int end = 0; end < 2; ++end) {
      const int node = input.model.mesh->cell(cell)[end];
      for (int part = 0; part < 2; ++part) {
        Eigen::Vector3d global;
        for (int c = 0; c < 3; ++c) {
          const int dof = input.dofs.dof(node, static_cast<Component>(3 * part + c));
          global[c] = static_cast<double>(std::exchange(forces[dof], 0.0L));
        }
        // The section force at the first end acts upon the beam with the opposite sign.
        const Eigen::Vector3d own = (end == 0 ? 1.0 : -1.0) * (axes * global);
        for (int c = 0; c < 3; ++c) {
          const std::size_t place = static_cast<std::size_t>(field.starts[cell] + end) * field.components.size();
          field.values[place + static_cast<std::size_t>(columns[3 * part + c])] += own[c];
        }
      }
    }
  }
  return field;
}

}  // namespace comma::solver
