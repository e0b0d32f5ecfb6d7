// Strains that elements have without stress, summed over the loads that impose them.
#pragma once

#include <span>
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

  bool empty() const { return continuum_.empty() && slender_.empty(); }
  bool acts_on(int cell) const { return continuum_.contains(cell) || slender_.contains(cell); }

  /// (xx, yy, zz, 2 xy, 2 xz, 2 yz) at a point of a solid or plane cell: shear as angles, as Hooke's law takes it.
  Eigen::Matrix<double, 6, 1> continuum(int cell, const Eigen::Vector3d& at) const;
  /// Elongation and the curvatures about the own y and z axes at a point of a bar or beam.
  Eigen::Vector3d slender(int cell, const Eigen::Vector3d& at) const;

 private:
  template <class Strain>
  struct Part {
    const Strain* strain;
    double factor;
  };
  template <class Strain>
  using Parts = std::unordered_map<int, std::vector<Part<Strain>>>;

  double time_;
  Parts<InitialStrain> continuum_;
  Parts<InitialSlenderStrain> slender_;
};

}  // namespace comma::solver
