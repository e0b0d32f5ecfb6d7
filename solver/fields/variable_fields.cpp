#include "solver/fields/variable_fields.hpp"

#include <algorithm>
#include <cmath>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// A field at the Gauss points of continua: `write(cell, point, target)` for each.
template <class Write>
ElementField at_points(const FieldInput& input, std::string quantity, std::vector<std::string> components,
                       Write&& write) {
  ContinuumPoints points(input.model);
  ElementField field{std::move(quantity), Support::gauss_point, std::move(components), {0}, {}};
  const std::size_t width = field.components.size();
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    const std::size_t count = points.covers(cell) ? points.samples(cell).size() : 0;
    field.starts.push_back(field.starts.back() + static_cast<int>(count));
    field.values.resize(static_cast<std::size_t>(field.starts.back()) * width, absent);
    for (std::size_t g = 0; g < count; ++g) {
      const MaterialPoint at = points.material_point(cell, input.state, static_cast<int>(g));
      write(cell, at, field.values.data() + (static_cast<std::size_t>(field.starts[cell]) + g) * width);
    }
  }
  return field;
}

double drying_strain(const IsotropicElasticity& material, const MaterialPoint& at) {
  const double content = at[Parameter::drying];
  if (std::isnan(content)) return 0.0;
  const double factor = material.drying_shrinkage(at);
  if (factor == 0.0) return 0.0;
  const double reference = at.reference(Parameter::drying);
  if (std::isnan(reference)) throw Error("missing-reference", "a field of drying is given without its reference value");
  return factor * (content - reference);
}

double hydration_strain(const IsotropicElasticity& material, const MaterialPoint& at) {
  const double degree = at[Parameter::hydration];
  return std::isnan(degree) ? 0.0 : -material.hydration_shrinkage(at) * degree;
}

void write_strains(const IsotropicElasticity& material, const MaterialPoint& at, double* target) {
  std::fill_n(target, 3, thermal_strain(material.expansion, at));
  target[3] = drying_strain(material, at);
  target[4] = hydration_strain(material, at);
}

void write_strains(const OrthotropicElasticity& material, const MaterialPoint& at, double* target) {
  for (std::size_t i = 0; i < 3; ++i) target[i] = thermal_strain(material.expansion[i], at);
  target[3] = target[4] = 0.0;
}

}  // namespace

ElementField command_variable_field(const FieldInput& input) {
  static const std::vector<std::string> names = {"TEMP",   "SECH",   "HYDR",   "NEUT1",  "NEUT2",  "NEUT3",
                                                 "EPSAXX", "EPSAYY", "EPSAZZ", "EPSAXY", "EPSAXZ", "EPSAYZ"};
  static_assert(command_variable_count == 12);
  return at_points(input, "VARC_R", names, [](int, const MaterialPoint& at, double* target) {
    for (int i = 0; i < command_variable_count; ++i) target[i] = at[static_cast<Parameter>(i)];
  });
}

ElementField variable_strain_field(const FieldInput& input) {
  return at_points(input, "EPSI_R", {"EPTHER_L", "EPTHER_T", "EPTHER_N", "EPSECH", "EPHYDR", "EPPTOT"},
                   [&](int cell, const MaterialPoint& at, double* target) {
                     std::visit([&](const auto& material) { write_strains(material, at, target); },
                                *material_of(input, cell).elasticity);
                     target[5] = 0.0;  // of a pressure in pores, which comma knows none of
                   });
}

}  // namespace comma::solver
