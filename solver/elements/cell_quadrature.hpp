// Integration over real edges, faces and volumes, whatever their dimension.
#pragma once

#include <array>
#include <map>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "solver/mesh/mesh.hpp"
#include "solver/mesh/reference_element.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Which family of R3.01.01 integrates over a cell: its own as part of a body, that of a skin, or of the edge of a
/// solid.
enum class CellRole : std::uint8_t { body, skin, edge };

/// Values of the shape functions (one a node) and their derivatives (node x dimension) at a point of the reference
/// cell.
struct CellSample {
  double weight;
  Eigen::VectorXd values;
  Eigen::MatrixXd derivatives;
};

/// A sample in the real cell.
struct CellPoint {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  Eigen::Matrix3d tangents = Eigen::Matrix3d::Zero();  ///< columns d(at)/d(xi), zero past the cell's dimension

  /// Length, area or volume for a unit of reference measure.
  double measure(int dimension) const;
  /// Normal of a face (right-hand rule) or of an edge in the plane (the tangent turned by -90 degrees), of length
  /// measure().
  Eigen::Vector3d normal(int dimension) const;
};

/// Something for each node of a cell, one a column; without allocation.
using NodeColumns = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, max_nodes>;

NodeColumns node_places(const Mesh& mesh, int cell);
CellPoint locate(const NodeColumns& places, const CellSample& sample);
CellPoint locate(const Mesh& mesh, int cell, const CellSample& sample);

/// The samples of each cell type, made when first asked for.
class CellSamples {
 public:
  const std::vector<CellSample>& of(CellType type, CellRole role);
  /// Those of the points at which an element of the formulation has its stresses.
  const std::vector<CellSample>& of_stiffness(CellType type, Formulation formulation);

 private:
  const std::vector<CellSample>& of_family(CellType type, std::string_view family);

  std::array<std::map<std::string_view, std::vector<CellSample>>, cell_type_count> known_;
};

}  // namespace comma::solver
