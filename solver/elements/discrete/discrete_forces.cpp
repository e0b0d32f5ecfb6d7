#include "solver/elements/discrete/discrete_forces.hpp"

#include <array>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, 2> plane_forces = {"N", "VY"};
constexpr std::array<std::string_view, 3> plane_forces_moment = {"N", "VY", "MFZ"};
constexpr std::array<std::string_view, 3> space_forces = {"N", "VY", "VZ"};
constexpr std::array<std::string_view, 6> space_forces_moments = {"N", "VY", "VZ", "MT", "MFY", "MFZ"};

}  // namespace

std::span<const std::string_view> discrete_force_names(Formulation formulation) {
  switch (formulation) {
    case Formulation::spring_2d:
      return plane_forces;
    case Formulation::spring_rotation_2d:
      return plane_forces_moment;
    case Formulation::spring_3d:
      return space_forces;
    default:
      return space_forces_moments;
  }
}

void require_small_displacements(const BlockInput& input, int cell, std::string_view subject) {
  if (input.behaviour_of(cell).kinematics == Kinematics::small) return;
  throw Error("unsupported",
              fmt::format("cell {}: {} small displacements only", input.model.mesh->cell_name(cell), subject),
              "give these cells DEFORMATION='PETIT'");
}

int discrete_translations(Formulation formulation) {
  return formulation == Formulation::spring_2d || formulation == Formulation::spring_rotation_2d ? 2 : 3;
}

const DiscreteStiffness& discrete_stiffness(const BlockInput& input, int cell) {
  const Mesh& mesh = *input.model.mesh;
  const auto found = input.properties.discrete.find(cell);
  if (found == input.properties.discrete.end())
    throw Error("missing-properties",
                fmt::format("the discrete element on cell {} has no stiffness", mesh.cell_name(cell)));
  const Eigen::MatrixXd& matrix = found->second.matrix;
  const int size = static_cast<int>(mesh.cell(cell).size()) *
                   discrete_components(input.model.formulations[static_cast<std::size_t>(cell)]);
  if (matrix.rows() != size || matrix.cols() != size) {
    throw Error("wrong-size", fmt::format("the stiffness of the discrete element on cell {} is {} x {}, not {} x {}",
                                          mesh.cell_name(cell), matrix.rows(), matrix.cols(), size, size));
  }
  return found->second;
}

}  // namespace comma::solver
