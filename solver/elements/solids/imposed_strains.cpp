#include "solver/elements/solids/imposed_strains.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/slender/slender_forces.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field.hpp"

namespace comma::solver {

using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

void check_continuum(const Model& model, const InitialStrain& load) {
  const int cell = load.cell;
  const int body = continuum_dimension(model.formulations[cell]);
  const bool leads_out = load.strain[4] != 0.0 || load.strain[5] != 0.0 || load.functions[4] || load.functions[5];
  if (body == 2 && leads_out) {
    throw Error("unknown-component",
                fmt::format("an initial strain of the plane cell {} has EPXZ or EPYZ, which lead out of the plane",
                            model.mesh->cell_name(cell)),
                "leave them out");
  }
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

void check_plate(const Model& model, int cell) {
  if (is_plate(model.formulations[cell]) && !model.is_skin(cell)) return;
  throw Error("unsupported", fmt::format("an initial strain of plates is given in cell {}, which is none",
                                         model.mesh->cell_name(cell)));
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

bool gives_initial_strains(const Load& load) {
  return !load.initial_strains.empty() || !load.initial_slender_strains.empty() ||
         !load.initial_plate_strains.empty() || !load.initial_strain_fields.empty();
}

ImposedStrains::ImposedStrains(const Model& model, std::span<const AppliedLoad> loads, double time) : time_(time) {
  for (const AppliedLoad& applied : loads) {
    // A function of time that ends before this instant is nobody's business here.
    if (!gives_initial_strains(*applied.load)) continue;
    const double factor = applied.multiplier ? applied.multiplier(time) : 1.0;
    for (const InitialStrain& strain : applied.load->initial_strains) {
      check_continuum(model, strain);
      continuum_[strain.cell].push_back({&strain, factor});
    }
    for (const InitialSlenderStrain& strain : applied.load->initial_slender_strains) {
      check_slender(model, strain);
      slender_[strain.cell].push_back({&strain, factor});
    }
    for (const InitialPlateStrain& strain : applied.load->initial_plate_strains) {
      check_plate(model, strain.cell);
      plates_[strain.cell].push_back({&strain, factor});
    }
    for (const auto& field : applied.load->initial_strain_fields) fields_.push_back({field.get(), factor});
  }
}

namespace {

bool has_values(const ElementField& field, int cell) {
  const auto width = static_cast<std::ptrdiff_t>(field.components.size());
  const auto first = field.values.begin() + field.starts[static_cast<std::size_t>(cell)] * width;
  return std::any_of(first, first + field.points(cell) * width, [](double value) { return !std::isnan(value); });
}

}  // namespace

bool ImposedStrains::acts_on(int cell) const {
  return continuum_.contains(cell) || slender_.contains(cell) || plates_.contains(cell) ||
         std::ranges::any_of(fields_, [&](const PartField& part) { return has_values(*part.field, cell); });
}

Vector6 ImposedStrains::continuum(int cell, int point, const Eigen::Vector3d& at) const {
  Vector6 strain = Vector6::Zero();
  if (const auto found = continuum_.find(cell); found != continuum_.end()) strain = sum<6>(found->second, at, time_);
  constexpr std::array<std::string_view, 6> names = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};
  for (int c = 0; c < 6; ++c) strain[c] += at_point(cell, point, names[static_cast<std::size_t>(c)]);
  strain.tail<3>() *= 2.0;
  return strain;
}

Eigen::Vector3d ImposedStrains::slender(int cell, const Eigen::Vector3d& at) const {
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();
  if (const auto found = slender_.find(cell); found != slender_.end()) strain = sum<3>(found->second, at, time_);
  constexpr std::array<std::string_view, 3> names = {"EPXX", "KY", "KZ"};
  for (int c = 0; c < 3; ++c) strain[c] += mean(cell, names[static_cast<std::size_t>(c)]);
  return strain;
}

Vector6 ImposedStrains::plate(int cell, const Eigen::Vector3d& at) const {
  Vector6 strain = Vector6::Zero();
  if (const auto found = plates_.find(cell); found != plates_.end()) strain = sum<6>(found->second, at, time_);
  constexpr std::array<std::string_view, 6> names = {"EXX", "EYY", "EXY", "KXX", "KYY", "KXY"};
  for (int c = 0; c < 6; ++c) strain[c] += mean(cell, names[static_cast<std::size_t>(c)]);
  strain[2] *= 2.0;
  strain[5] *= 2.0;
  return strain;
}

/// The sum of the fields there; what one does not carry is zero.
double ImposedStrains::at_point(int cell, int point, std::string_view component) const {
  double sum = 0.0;
  for (const auto& [field, factor] : fields_) {
    const int column = field->component(component);
    if (column < 0 || point >= field->points(cell)) continue;
    const double value = field->at(cell, point, column);
    if (!std::isnan(value)) sum += factor * value;
  }
  return sum;
}

double ImposedStrains::mean(int cell, std::string_view component) const {
  int points = 0;
  for (const auto& [field, factor] : fields_) points = std::max(points, field->points(cell));
  double sum = 0.0;
  for (int point = 0; point < points; ++point) sum += at_point(cell, point, component) / points;
  return sum;
}

void check_known_to_law(const ImposedStrains* known, const Mesh& mesh, int cell) {
  if (known != nullptr && known->acts_on(cell)) return;
  throw Error("unsupported",
              fmt::format("cell {}: with the pressure as an unknown, initial strains have no intensity that is sought",
                          mesh.cell_name(cell)),
              "leave out TYPE_CHARGE='FIXE_PILO' of the load with PRE_EPSI");
}

}  // namespace comma::solver
