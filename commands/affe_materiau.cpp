#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/materials/combination.hpp"

namespace comma::commands {

namespace {

using interpreter::ConceptPtr;
using interpreter::DiagnosticError;
using solver::Parameter;

// NOM_VARC with the field that EVOL holds it in (U4.43.03).
struct VariableName {
  const char* name;
  Parameter variable;
  const char* field;
  const char* component;  ///< of the field; EPSA has several
};

constexpr VariableName variables[] = {
    {"TEMP", Parameter::temperature, "TEMP", "TEMP"},    {"SECH", Parameter::drying, "SECH", "SECH"},
    {"HYDR", Parameter::hydration, "HYDR_ELNO", "HYDR"}, {"NEUT1", Parameter::neutral_1, "NEUT", "X1"},
    {"NEUT2", Parameter::neutral_2, "NEUT", "X1"},       {"NEUT3", Parameter::neutral_3, "NEUT", "X1"},
    {"EPSA", Parameter::strain_xx, "EPSA_ELNO", nullptr}};

const VariableName& named_variable(const Keywords& assignment) {
  return *std::ranges::find_if(variables,
                               [&](const VariableName& known) { return assignment.text("NOM_VARC") == known.name; });
}

std::vector<solver::VariableSnapshot> snapshots(const Keywords& assignment, const std::string& field) {
  std::vector<solver::VariableSnapshot> found;
  for (const solver::ResultStep& step : assignment.data<ResultConcept>("EVOL").result.steps) {
    const auto held = step.fields.find(field);
    if (held != step.fields.end()) found.push_back({step.instant, std::make_shared<const solver::Field>(held->second)});
  }
  if (!found.empty()) return found;
  throw DiagnosticError("unknown-field",
                        fmt::format("AFFE_VARC: {} holds no {}", assignment.concept_of("EVOL")->name, field),
                        assignment.span_of("EVOL"), "NOM_CHAM names the field of the result that holds the variable");
}

// EPSA: one variable for each component that the fields have.
constexpr std::array<const char*, 6> strain_components = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};

int component_in(const solver::Field& field, const char* name) {
  return std::visit([&](const auto& any) { return any.component(name); }, field);
}

void add_strains(const solver::CommandVariable& whole, const Keywords& assignment,
                 std::vector<solver::CommandVariable>& known) {
  if (assignment.has("VALE_REF")) {
    throw DiagnosticError("excluded-keyword", "AFFE_VARC: EPSA has no reference value: it is the strain itself",
                          assignment.span_of("VALE_REF"), "leave out VALE_REF");
  }
  const std::size_t before = known.size();
  for (std::size_t c = 0; c < strain_components.size(); ++c) {
    const auto lacks = [&](const solver::VariableSnapshot& snapshot) {
      return component_in(*snapshot.field, strain_components[c]) < 0;
    };
    if (std::ranges::all_of(whole.snapshots, lacks)) continue;
    if (std::ranges::any_of(whole.snapshots, lacks)) {
      throw DiagnosticError(
          "unknown-component",
          fmt::format("AFFE_VARC: EPSA has {} at some instants and not at others", strain_components[c]),
          assignment.span);
    }
    solver::CommandVariable& one = known.emplace_back(whole);
    one.variable = solver::strain_parameters[c];
    for (solver::VariableSnapshot& snapshot : one.snapshots) {
      const int component = component_in(*snapshot.field, strain_components[c]);
      snapshot.field = std::make_shared<const solver::Field>(solver::with_components(*snapshot.field, {&component, 1}));
    }
  }
  if (known.size() == before) {
    throw DiagnosticError("unknown-component",
                          "AFFE_VARC: the field for EPSA has none of the components EPXX, EPYY, EPZZ, EPXY, EPXZ, EPYZ",
                          assignment.span);
  }
}

// Temperatures that change through the thickness of a plate would bend it.
void check_even_through_thickness(const solver::CommandVariable& variable, const Keywords& assignment) {
  if (variable.variable != Parameter::temperature) return;
  for (const char* name : {"TEMP_MIL", "TEMP_INF", "TEMP_SUP"}) {
    for (const solver::VariableSnapshot& snapshot : variable.snapshots) {
      const int column = component_in(*snapshot.field, name);
      if (column < 0) continue;
      const auto& values = solver::values_of(*snapshot.field);
      const std::size_t width = solver::components_of(*snapshot.field).size();
      for (std::size_t i = static_cast<std::size_t>(column); i < values.size(); i += width) {
        if (std::isnan(values[i])) continue;
        throw DiagnosticError(
            "unsupported",
            fmt::format("AFFE_VARC: comma does not know {}, a temperature within the thickness of a plate", name),
            assignment.span_of(assignment.has("CHAM_GD") ? "CHAM_GD" : "EVOL"),
            "give TEMP, the same through the thickness, and curvatures by PRE_EPSI");
      }
    }
  }
}

// Leaves of each field the component that is the variable, by its name or that which its quantity has.
void keep_component(const char* name, const Keywords& assignment, solver::CommandVariable& variable) {
  for (solver::VariableSnapshot& snapshot : variable.snapshots) {
    const int own = component_in(*snapshot.field, assignment.text("NOM_VARC").c_str());
    const int component = own >= 0 ? own : component_in(*snapshot.field, name);
    if (component < 0) {
      throw DiagnosticError(
          "unknown-component",
          fmt::format("AFFE_VARC: a field of {} has {}, and this one has not", assignment.text("NOM_VARC"), name),
          assignment.span_of(assignment.has("CHAM_GD") ? "CHAM_GD" : "EVOL"),
          fmt::format("it has {}", fmt::join(solver::components_of(*snapshot.field), ", ")));
    }
    if (solver::components_of(*snapshot.field).size() > 1)
      snapshot.field = std::make_shared<const solver::Field>(solver::with_components(*snapshot.field, {&component, 1}));
  }
}

// The groups of a mesh may have changed since the command named them.
template <class What>
struct Assigned {
  What what;
  std::vector<int> cells;
};

solver::CommandVariable command_variable(const Assigned<Keywords>& assigned) {
  const Keywords& assignment = assigned.what;
  const VariableName& name = named_variable(assignment);
  solver::CommandVariable variable;
  variable.variable = name.variable;
  variable.cells = assigned.cells;
  if (assignment.has("VALE_REF")) variable.reference = assignment.real("VALE_REF");
  if (assignment.has("CHAM_GD")) {
    variable.snapshots.push_back(
        {0.0, std::make_shared<const solver::Field>(assignment.data<FieldConcept>("CHAM_GD").field)});
    variable.left = variable.right = solver::Extension::constant;
    return variable;
  }
  variable.snapshots = snapshots(assignment, assignment.has("NOM_CHAM") ? assignment.text("NOM_CHAM") : name.field);
  if (assignment.has("FONC_INST"))
    variable.instant = time_function(assignment.concept_of("FONC_INST"), assignment.span_of("FONC_INST"));
  variable.left = extension_named(assignment.text("PROL_GAUCHE"));
  variable.right = extension_named(assignment.text("PROL_DROITE"));
  return variable;
}

// One kind of law may be given by numbers or by functions, and elasticity in several forms.
std::string kind_of_law(const std::string& keyword) {
  if (keyword.ends_with("_FO")) return kind_of_law(keyword.substr(0, keyword.size() - 3));
  return keyword == "ELAS_ORTH" || keyword == "ELAS_ISTR" ? "ELAS" : keyword;
}

// Code_Aster refuses materials that give the same law.
void check_different_laws(const Keywords& assignment) {
  std::map<std::string, std::string> givers;
  for (const ConceptPtr& material : assignment.concepts("MATER")) {
    for (const std::string& law : interpreter::data_of<MaterialConcept>(material, "MATER").laws) {
      const auto [giver, is_new] = givers.emplace(kind_of_law(law), material->name + " (" + law + ")");
      if (is_new) continue;
      throw DiagnosticError("contradictory-keywords",
                            fmt::format("AFFE_MATERIAU: {} and {} ({}) give the same cells one kind of law",
                                        giver->second, material->name, law),
                            assignment.span_of("MATER"), "name one of them, or define a material without that law");
    }
  }
}

std::shared_ptr<const solver::Material> material_of(const Keywords& assignment) {
  check_different_laws(assignment);
  std::shared_ptr<const solver::Material> all;
  for (const ConceptPtr& handle : assignment.concepts("MATER")) {
    const auto& material = interpreter::data_of<MaterialConcept>(handle, "MATER").material;
    all = all ? std::make_shared<const solver::Material>(solver::combined(*all, *material)) : material;
  }
  return all;
}

struct MaterialAssignments {
  std::size_t cell_count = 0;
  std::vector<Assigned<Keywords>> materials;
  std::vector<Assigned<Keywords>> variables;  ///< no cells: all
};

MaterialAssignments material_assignments(const Call& call, const solver::Mesh& mesh) {
  MaterialAssignments found;
  found.cell_count = static_cast<std::size_t>(mesh.cell_count());
  for (const Keywords& assignment : call.factors("AFFE"))
    found.materials.push_back({assignment, selected_cells(assignment, mesh)});
  for (const Keywords& assignment : call.factors("AFFE_VARC")) {
    if (assignment.text("NOM_VARC") == "GEOM") continue;
    found.variables.push_back(
        {assignment, names_a_place(assignment) ? selected_cells(assignment, mesh) : std::vector<int>()});
  }
  return found;
}

std::vector<ConceptPtr> sources_of(const MaterialAssignments& assignments) {
  std::vector<ConceptPtr> sources;
  for (const auto& [assignment, cells] : assignments.materials)
    for (const ConceptPtr& material : assignment.concepts("MATER")) sources.push_back(material);
  for (const auto& [assignment, cells] : assignments.variables)
    sources.push_back(assignment.concept_of(assignment.has("CHAM_GD") ? "CHAM_GD" : "EVOL"));
  return sources;
}

std::shared_ptr<const solver::MaterialField> material_field(const MaterialAssignments& assignments) {
  auto field = std::make_shared<solver::MaterialField>();
  field->by_cell.resize(assignments.cell_count);
  for (const auto& [assignment, cells] : assignments.materials) {
    const auto material = material_of(assignment);
    for (const int cell : cells) field->by_cell[static_cast<std::size_t>(cell)] = material;
  }
  for (const Assigned<Keywords>& assigned : assignments.variables) {
    const Keywords& assignment = assigned.what;
    solver::CommandVariable variable = command_variable(assigned);
    check_even_through_thickness(variable, assignment);
    if (const char* component = named_variable(assignment).component) keep_component(component, assignment, variable);
    if (assignment.text("NOM_VARC") == "EPSA") {
      add_strains(variable, assignment, field->variables);
    } else {
      field->variables.push_back(std::move(variable));
    }
  }
  return field;
}

// A cell has the variable where all of its nodes, or points, have.
solver::Coverage coverage(const solver::CommandVariable& variable, const solver::Mesh& mesh, int cell) {
  std::size_t given = 0, possible = 0;
  for (const solver::VariableSnapshot& snapshot : variable.snapshots) {
    if (const auto* nodal = std::get_if<solver::NodalField>(snapshot.field.get())) {
      for (const int node : mesh.cell(cell)) given += std::isnan(nodal->at(node, 0)) ? 0 : 1;
      possible += mesh.cell(cell).size();
    } else {
      const auto& on_cells = std::get<solver::ElementField>(*snapshot.field);
      const int points = on_cells.points(cell);
      for (int point = 0; point < points; ++point) given += std::isnan(on_cells.at(cell, point, 0)) ? 0 : 1;
      possible += static_cast<std::size_t>(std::max(points, 1));
    }
  }
  if (given == 0) return solver::Coverage::none;
  return given == possible ? solver::Coverage::whole : solver::Coverage::partial;
}

void warn_of_partial_variables(const MaterialAssignments& assignments, const solver::MaterialField& field,
                               const solver::Mesh& mesh, Context& context) {
  std::size_t next = 0;  // of the field's
  for (std::size_t k = 0; k < assignments.variables.size() && next < field.variables.size(); ++k) {
    if (assignments.variables[k].what.text("NOM_VARC") == "EPSA") {  // one assignment makes several variables
      while (next < field.variables.size() &&
             std::ranges::find(solver::strain_parameters, field.variables[next].variable) !=
                 solver::strain_parameters.end())
        ++next;
      continue;
    }
    const solver::CommandVariable& variable = field.variables[next++];
    std::vector<int> cells = variable.cells;
    if (cells.empty())
      for (int cell = 0; cell < mesh.cell_count(); ++cell) cells.push_back(cell);
    std::erase_if(cells, [&](int cell) { return coverage(variable, mesh, cell) != solver::Coverage::partial; });
    if (cells.empty()) continue;
    const Keywords& assignment = assignments.variables[k].what;
    context.diagnostics.alarm(
        "partial-variable",
        fmt::format("AFFE_VARC: {} is given at some of the nodes or instants alone of {} cell{}, {} the first: "
                    "wherever a value is missing they have their reference value",
                    assignment.text("NOM_VARC"), cells.size(), cells.size() == 1 ? "" : "s",
                    mesh.cell_name(cells.front())),
        assignment.span,
        "give the field at all nodes of the cells and at all instants, or name the cells that have it");
  }
}

}  // namespace

Product affe_materiau(const Call& call, Context& context) {
  auto product = std::make_shared<MaterialFieldConcept>();
  product->mesh =
      call.has("MAILLAGE") ? call.data<MeshConcept>("MAILLAGE").mesh : call.data<ModelConcept>("MODELE").model->mesh;
  const MaterialAssignments assignments = material_assignments(call, *product->mesh);
  auto sources = sources_of(assignments);
  product->field = {std::move(sources), [assignments] { return material_field(assignments); }};
  warn_of_partial_variables(assignments, *product->field.get(), *product->mesh, context);
  return product;
}

}  // namespace comma::commands
