#include "solver/fields/stresses/equivalent.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, 6> strain_names = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};
const std::array<std::string, 9> direction_names = {"VECT_1_X", "VECT_1_Y", "VECT_1_Z", "VECT_2_X", "VECT_2_Y",
                                                    "VECT_2_Z", "VECT_3_X", "VECT_3_Y", "VECT_3_Z"};

std::vector<std::string> stress_results() {
  std::vector<std::string> names = {"VMIS", "TRESCA", "PRIN_1", "PRIN_2", "PRIN_3", "VMIS_SG"};
  names.insert(names.end(), direction_names.begin(), direction_names.end());
  names.insert(names.end(), {"TRSIG", "TRIAX"});
  return names;
}

std::vector<std::string> strain_results() {
  std::vector<std::string> names = {"INVA_2", "PRIN_1", "PRIN_2", "PRIN_3", "INVA_2SG"};
  names.insert(names.end(), direction_names.begin(), direction_names.end());
  return names;
}

double norm_of_deviator(const Eigen::Matrix3d& tensor) {
  return (tensor - tensor.trace() / 3 * Eigen::Matrix3d::Identity()).norm();
}

double* write_directions(const Principal& principal, double* target) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) *target++ = principal.vectors(j, i);
  }
  return target;
}

void write_stress(const Eigen::Matrix3d& stress, double* target) {
  const Principal axes = principal(stress);
  const double trace = stress.trace();
  const double vmis = von_mises(stress);
  *target++ = vmis;
  *target++ = axes.values[2] - axes.values[0];
  for (const double value : axes.values) *target++ = value;
  *target++ = std::copysign(vmis, trace);
  target = write_directions(axes, target);
  *target++ = trace;
  // A state that is hydrostatic but for rounding has no triaxiality to speak of.
  const bool deviates = vmis > 8 * std::numeric_limits<double>::epsilon() * stress.cwiseAbs().maxCoeff();
  *target = deviates ? trace / 3 / vmis : 0.0;
}

void write_strain(const Eigen::Matrix3d& strain, double* target) {
  const Principal axes = principal(strain);
  const double second = std::sqrt(2.0 / 3) * norm_of_deviator(strain);
  *target++ = second;
  for (const double value : axes.values) *target++ = value;
  *target++ = std::copysign(second, strain.trace());
  write_directions(axes, target);
}

/// Applies `write` to every tensor of a field with `width` components a place; NaN where there is no tensor. Of a bar
/// the strain along itself is one.
template <class AnyField, class Write>
AnyField map_tensors(const AnyField& field, std::span<const std::string_view> names, std::vector<std::string> results,
                     Write&& write) {
  std::array<int, 6> columns;
  for (int i = 0; i < 6; ++i) columns[i] = field.component(names[i]);
  const bool has_tensors = columns[0] >= 0 && columns[1] >= 0 && columns[2] >= 0 && columns[3] >= 0;
  const bool of_bars = columns[0] >= 0 && field.components.size() == 1;
  if (!has_tensors && !of_bars && !field.values.empty()) {
    throw Error("incompatible-field",
                fmt::format("the field has no components {} {} {} {}", names[0], names[1], names[2], names[3]));
  }
  AnyField result = field;
  const std::size_t width = field.components.size();
  const std::size_t places = field.values.empty() ? 0 : field.values.size() / width;
  result.components = std::move(results);
  const std::size_t new_width = result.components.size();
  result.values.assign(places * new_width, absent);
  for (std::size_t place = 0; place < places; ++place) {
    const double* value = field.values.data() + place * width;
    if (std::isnan(value[columns[0]])) continue;
    const auto entry = [&](int i) { return columns[i] < 0 || std::isnan(value[columns[i]]) ? 0.0 : value[columns[i]]; };
    Eigen::Matrix3d tensor;
    tensor << entry(0), entry(3), entry(4), entry(3), entry(1), entry(5), entry(4), entry(5), entry(2);
    write(tensor, result.values.data() + place * new_width);
  }
  return result;
}

}  // namespace

Principal principal(const Eigen::Matrix3d& tensor) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

double von_mises(const Eigen::Matrix3d& stress) { return std::sqrt(1.5) * norm_of_deviator(stress); }

double tresca(const Eigen::Matrix3d& stress) {
  const Eigen::Vector3d values = principal(stress).values;
  return values[2] - values[0];
}

ElementField equivalent_stresses(const ElementField& stresses) {
  return map_tensors(stresses, solid_stress_names, stress_results(), write_stress);
}
NodalField equivalent_stresses(const NodalField& stresses) {
  return map_tensors(stresses, solid_stress_names, stress_results(), write_stress);
}
ElementField equivalent_strains(const ElementField& strains) {
  return map_tensors(strains, strain_names, strain_results(), write_strain);
}
NodalField equivalent_strains(const NodalField& strains) {
  return map_tensors(strains, strain_names, strain_results(), write_strain);
}

namespace {

const std::array<std::string_view, 6>& tensor_names(const NodalField& field) {
  return field.component(strain_names.front()) < 0 ? solid_stress_names : strain_names;
}

void write_invariants(const Eigen::Matrix3d& tensor, double* target) {
  *target++ = von_mises(tensor);
  *target++ = tresca(tensor);
  *target++ = tensor.trace();
  *target = tensor.determinant();
}

void write_principal(const Eigen::Matrix3d& tensor, double* target) {
  const Principal axes = principal(tensor);
  for (const double value : axes.values) *target++ = value;
  write_directions(axes, target);
}

}  // namespace

NodalField tensor_invariants(const NodalField& tensors) {
  return map_tensors(tensors, tensor_names(tensors), {"VMIS", "TRESCA", "TRACE", "DETER"}, write_invariants);
}

NodalField principal_values(const NodalField& tensors) {
  std::vector<std::string> names = {"PRIN_1", "PRIN_2", "PRIN_3"};
  names.insert(names.end(), direction_names.begin(), direction_names.end());
  return map_tensors(tensors, tensor_names(tensors), std::move(names), write_principal);
}

}  // namespace comma::solver
