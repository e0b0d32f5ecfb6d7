// The integration points of solid, plane and axisymmetric cells, for fields and integrals over them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/elements/quadrature.hpp"
#include "solver/elements/slender/section.hpp"
#include "solver/materials/elasticity.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// What computed fields are made from, at one instant.
struct FieldInput {
  const Model& model;
  const MaterialField& materials;
  const ElementProperties& properties;
  const VariableState& state;
};

/// The material of a cell with its axes. Throws Error `missing-material` naming the cell.
CellMaterial material_of(const FieldInput& input, int cell);

/// Which points: those of the stiffness, where stresses live, or those of the mass.
enum class PointFamily : std::uint8_t { stiffness, mass };

/// A point of the reference cell: shape functions (one a node), derivatives (node x dimension).
struct ContinuumSample {
  double weight;
  Eigen::VectorXd values;
  Eigen::MatrixXd derivatives;
};

/// The point in the real cell. `weight`: the volume it stands for (area for a thickness of 1; per radian if
/// axisymmetric).
struct ContinuumPoint {
  double weight = 0.0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, max_nodes, 3> gradients;  ///< node x direction, 0 along Z in a plane
};

class ContinuumPoints {
 public:
  explicit ContinuumPoints(const Model& model, PointFamily family = PointFamily::stiffness)
      : model_(model), family_(family) {}

  /// Whether the cell is a continuum element, skin excluded.
  bool covers(int cell) const;
  /// The samples of a cell that is covered; the reference stays valid.
  const std::vector<ContinuumSample>& samples(int cell);
  ContinuumPoint locate(int cell, const ContinuumSample& sample) const;
  /// What the material knows at a point.
  MaterialPoint material_point(int cell, const VariableState& state, const ContinuumSample& sample,
                               const Eigen::Vector3d& at, int point) const;
  /// The same of a sample by its number.
  MaterialPoint material_point(int cell, const VariableState& state, int point);

 private:
  const Model& model_;
  PointFamily family_;
  /// By cell type; full, reduced and mixed integration (with one field, with two) apart.
  std::array<std::array<std::vector<ContinuumSample>, 4>, cell_type_count> known_;
};

}  // namespace comma::solver
