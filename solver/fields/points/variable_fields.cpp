#include "solver/fields/points/variable_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/elements/slender/slender_member.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// A field at the Gauss points of continua and in the middle of bars: `write(cell, point, target)` for each.
template <class Write>
ElementField at_points(const FieldInput& input, std::string quantity, std::vector<std::string> components,
                       Write&& write) {
  ContinuumPoints points(input.model);
  ElementField field{std::move(quantity), Support::gauss_point, std::move(components), {0}, {}};
  const std::size_t width = field.components.size();
  for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) {
    const bool of_bar = is_bar(input.model.formulations[static_cast<std::size_t>(cell)]);
    const std::size_t count = points.covers(cell) ? points.samples(cell).size() : of_bar ? 1 : 0;
    field.starts.push_back(field.starts.back() + static_cast<int>(count));
    field.values.resize(static_cast<std::size_t>(field.starts.back()) * width, absent);
    for (std::size_t g = 0; g < count; ++g) {
      const MaterialPoint at = of_bar ? middle_of(*input.model.mesh, cell, input.state)
                                      : points.material_point(cell, input.state, static_cast<int>(g));
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

using NamedVariable = std::pair<const char*, std::optional<Parameter>>;

/// Those of Code_Aster 17.3, of which comma knows no IRRA, CORR and PTOT, and what is given beyond them.
std::vector<NamedVariable> named_variables(const MaterialField& materials) {
  std::vector<NamedVariable> names = {{"TEMP", Parameter::temperature},
                                      {"HYDR", Parameter::hydration},
                                      {"SECH", Parameter::drying},
                                      {"IRRA", {}},
                                      {"CORR", {}},
                                      {"PTOT", {}},
                                      {"NEUT1", Parameter::neutral_1},
                                      {"NEUT2", Parameter::neutral_2}};
  const NamedVariable further[] = {{"NEUT3", Parameter::neutral_3},  {"EPSAXX", Parameter::strain_xx},
                                   {"EPSAYY", Parameter::strain_yy}, {"EPSAZZ", Parameter::strain_zz},
                                   {"EPSAXY", Parameter::strain_xy}, {"EPSAXZ", Parameter::strain_xz},
                                   {"EPSAYZ", Parameter::strain_yz}};
  for (const NamedVariable& each : further)
    if (std::ranges::any_of(materials.variables,
                            [&](const CommandVariable& given) { return given.variable == each.second; }))
      names.push_back(each);
  return names;
}

bool has_continua(const Model& model) {
  const ContinuumPoints points(model);
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell)
    if (points.covers(cell)) return true;
  return false;
}

}  // namespace

ElementField command_variable_field(const FieldInput& input) {
  const std::vector<NamedVariable> variables = named_variables(input.materials);
  std::vector<std::string> names;
  for (const NamedVariable& each : variables) names.emplace_back(each.first);
  return at_points(input, "VARC_R", names, [&](int, const MaterialPoint& at, double* target) {
    for (const NamedVariable& each : variables) *target++ = each.second ? at[*each.second] : absent;
  });
}

ElementField variable_strain_field(const FieldInput& input) {
  std::vector<std::string> names = {"EPTHER_L", "EPTHER_T", "EPTHER_N", "EPSECH", "EPHYDR", "EPPTOT"};
  if (!has_continua(input.model)) names.resize(1);
  return at_points(input, "EPSI_R", std::move(names), [&](int cell, const MaterialPoint& at, double* target) {
    std::array<double, 6> strains{};  // 0 of a pressure in pores, which comma knows none of
    std::visit([&](const auto& material) { write_strains(material, at, strains.data()); },
               *material_of(input, cell).elasticity);
    const bool of_bar = is_bar(input.model.formulations[static_cast<std::size_t>(cell)]);
    std::copy_n(strains.begin(), of_bar ? 1 : 6, target);
  });
}

}  // namespace comma::solver
