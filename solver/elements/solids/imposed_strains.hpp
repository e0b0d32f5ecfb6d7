// Strains that elements have without stress, summed over the loads that impose them.
#pragma once

#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <Eigen/Dense>

#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The imposed strains of each cell at one moment. Keeps pointers into the loads.
class ImposedStrains {
 public:
  /// Throws Error `unsupported` naming a cell that has no strain of the kind given.
  ImposedStrains(const Model& model, std::span<const AppliedLoad> loads, double time);

  bool empty() const { return continuum_.empty() && slender_.empty() && plates_.empty() && fields_.empty(); }
  bool acts_on(int cell) const;

  /// (xx, yy, zz, 2 xy, 2 xz, 2 yz) at an integration point, the one of this number, of a solid or plane cell: shear as
  /// angles, as Hooke's law takes it.
  Eigen::Matrix<double, 6, 1> continuum(int cell, int point, const Eigen::Vector3d& at) const;
  /// Elongation and the curvatures about the own y and z axes at a point of a bar or beam.
  Eigen::Vector3d slender(int cell, const Eigen::Vector3d& at) const;
  /// (e_xx, e_yy, 2 e_xy, k_xx, k_yy, 2 k_xy) at a point of a plate, in its own axes about the surface of the mesh; of
  /// fields their mean over the cell.
  Eigen::Matrix<double, 6, 1> plate(int cell, const Eigen::Vector3d& at) const;

 private:
  template <class Strain>
  struct Part {
    const Strain* strain;
    double factor;
  };
  template <class Strain>
  using Parts = std::unordered_map<int, std::vector<Part<Strain>>>;

  struct PartField {
    const ElementField* field;
    double factor;
  };

  double at_point(int cell, int point, std::string_view component) const;
  double mean(int cell, std::string_view component) const;

  double time_;
  Parts<InitialStrain> continuum_;
  Parts<InitialSlenderStrain> slender_;
  Parts<InitialPlateStrain> plates_;
  std::vector<PartField> fields_;
};

/// Whether a load gives initial strains of any kind.
bool gives_initial_strains(const Load& load);

/// Throws Error `unsupported` unless the law of a cell with the pressure as an unknown sees strains less `known` ones
/// there: it takes no forces in their place.
void check_known_to_law(const ImposedStrains* known, const Mesh& mesh, int cell);

}  // namespace comma::solver
