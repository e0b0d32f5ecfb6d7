#include "solver/elements/imposed_strains.hpp"

#include <fmt/format.h>

#include "solver/elements/slender_forces.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

void check_continuum(const Model& model, int cell) {
  const int body = continuum_dimension(model.formulations[cell]);
  if (body > 0 && dimension(model.mesh->cell_types[cell]) == body) return;
  throw Error("unsupported",
              fmt::format("an initial strain is given in cell {}, a {}, which is no part of a solid or plane body",
                          model.mesh->cell_name(cell), name_of(model.mesh->cell_types[cell])));
}

void check_slender(const Model& model, const InitialSlenderStrain& load) {
  const Formulation formulation = model.formulations[load.cell];
  const bool carries = model.components_of(load.cell) != 0 && (is_bar(formulation) || is_beam(formulation));
  if (!carries) {
    throw Error("unsupported", fmt::format("an initial elongation is given in cell {}, which is no bar or beam",
                                           model.mesh->cell_name(load.cell)));
  }
  const bool bends = load.strain[1] != 0.0 || load.strain[2] != 0.0 || load.functions[1] || load.functions[2];
  if (bends && is_bar(formulation)) {
    throw Error("unsupported", fmt::format("an initial curvature is given in bar {}, which does not bend",
                                           model.mesh->cell_name(load.cell)));
  }
}

/// The sum of the parts at a place; N components.
template <int N, class Parts>
Eigen::Matrix<double, N, 1> sum(const Parts& parts, const Eigen::Vector3d& at, double time) {
  Eigen::Matrix<double, N, 1> result = Eigen::Matrix<double, N, 1>::Zero();
  const Point place = {at[0], at[1], at[2]};
  for (const auto& [strain, factor] : parts) {
    for (int c = 0; c < N; ++c) {
      const auto& function = strain->functions[static_cast<std::size_t>(c)];
      result[c] += factor * (function ? function(place, time) : strain->strain[static_cast<std::size_t>(c)]);
    }
  }
  return result;
}

}  // namespace

ImposedStrains::ImposedStrains(const Model& model, std::span<const AppliedLoad> loads, double time) : time_(time) {
  for (const AppliedLoad& applied : loads) {
    const double factor = applied.multiplier ? applied.multiplier(time) : 1.0;
    for (const InitialStrain& strain : applied.load->initial_strains) {
      check_continuum(model, strain.cell);
      continuum_[strain.cell].push_back({&strain, factor});
    }
    for (const InitialSlenderStrain& strain : applied.load->initial_slender_strains) {
      check_slender(model, strain);
      slender_[strain.cell].push_back({&strain, factor});
    }
  }
}

Eigen::Matrix<double, 6, 1> ImposedStrains::continuum(int cell, const Eigen::Vector3d& at) const {
  const auto found = continuum_.find(cell);
  if (found == continuum_.end()) return Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> strain = sum<6>(found->second, at, time_);
  strain.tail<3>() *= 2.0;
  return strain;
}

Eigen::Vector3d ImposedStrains::slender(int cell, const Eigen::Vector3d& at) const {
  const auto found = slender_.find(cell);
  return found == slender_.end() ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                 : Eigen::Vector3d(sum<3>(found->second, at, time_));
}

}  // namespace comma::solver
