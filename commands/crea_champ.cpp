#include <fmt/format.h>

#include <algorithm>

#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/commands.hpp"
#include "commands/fields/field_extraction.hpp"
#include "commands/fields/field_reading.hpp"
#include "commands/fields/field_types.hpp"
#include "commands/fields/input_field_reading.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/constraints/directions.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_algebra.hpp"
#include "solver/fields/data/field_room.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/points/discretisation.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using FieldPtr = std::shared_ptr<FieldConcept>;

// What MAILLAGE or MODELE says the new field lies on.
FieldPtr on_support(const Call& call) {
  auto product = std::make_shared<FieldConcept>();
  if (call.has("MODELE")) {
    product->model = call.data<ModelConcept>("MODELE").model;
    product->mesh = product->model->mesh;
  } else {
    product->mesh = call.data<MeshConcept>("MAILLAGE").mesh;
  }
  return product;
}

const solver::Model& needed_model(const Call& call, const FieldConcept& support, const FieldType& type) {
  if (support.model) return *support.model;
  throw DiagnosticError("missing-keyword", fmt::format("CREA_CHAMP: a field {} lies on a model", describe(type.place)),
                        call.span, call.has("MAILLAGE") ? "give MODELE in place of MAILLAGE" : "give MODELE");
}

solver::Field empty_field(const Call& call, const FieldConcept& support, const FieldType& type,
                          std::vector<std::string> components) {
  if (type.place == FieldPlace::node)
    return solver::empty_nodal_field(*support.mesh, type.quantity_name(), std::move(components));
  if (type.place == FieldPlace::zone)
    return solver::empty_cell_field(*support.mesh, type.quantity_name(), std::move(components));
  return solver::empty_element_field(needed_model(call, support, type), type.quantity_name(), support_of(type.place),
                                     std::move(components), lives_on_skin(type));
}

void add_name(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

// The nodes or cells that an occurrence names. On cells a group of nodes says nothing.
std::vector<int> places(const Keywords& occurrence, const FieldConcept& field, const FieldType& type) {
  if (type.place == FieldPlace::node) return selected_nodes(occurrence, *field.mesh);
  for (const char* keyword : {"GROUP_NO", "NOEUD"}) {
    if (!occurrence.given(keyword)) continue;
    throw DiagnosticError(
        "wrong-place",
        fmt::format("CREA_CHAMP: {} names nodes, and the field has its values {}", keyword, describe(type.place)),
        occurrence.span_of(keyword), "name cells by GROUP_MA, MAILLE or TOUT");
  }
  return selected_cells(occurrence, *field.mesh);
}

void finish(const Call& call, FieldConcept& product) {
  if (call.has("PROL_ZERO") && call.text("PROL_ZERO") == "OUI") {
    double zero = 0.0;
    if (!product.functions.empty()) {
      zero = static_cast<double>(product.functions.size());
      product.functions.push_back(std::make_shared<ConstantConcept>(0.0));
    }
    auto* element = std::get_if<solver::ElementField>(&product.field);
    if (element != nullptr && product.model && product.functions.empty())
      solver::fill_with_zeros(*element, *product.model);
    else
      solver::fill_absent(product.field, zero);
  }
  if (auto* element = std::get_if<solver::ElementField>(&product.field)) solver::drop_empty_cells(*element);
}

// The value to store: a number, or the index of a function that is kept beside the field.
std::vector<double> values_of(const Keywords& occurrence, const FieldType& type, FieldConcept& product) {
  const char* wanted = type.functions ? "VALE_F" : type.integers ? "VALE_I" : "VALE";
  if (!occurrence.given(wanted)) {
    throw DiagnosticError("missing-keyword",
                          fmt::format("CREA_CHAMP: a field of {} takes its values from {}",
                                      type.functions  ? "functions"
                                      : type.integers ? "integers"
                                                      : "numbers",
                                      wanted),
                          occurrence.span, "or ask for a TYPE_CHAM that ends in _R (VALE), _I (VALE_I) or _F (VALE_F)");
  }
  if (type.integers) {
    const auto integers = occurrence.integers("VALE_I");
    return {integers.begin(), integers.end()};
  }
  if (!type.functions) return occurrence.reals("VALE");
  std::vector<double> indices;
  for (const auto& handle : occurrence.concepts("VALE_F")) {
    interpreter::data_of<FunctionConcept>(handle, "VALE_F");
    indices.push_back(static_cast<double>(product.functions.size()));
    product.functions.push_back(std::dynamic_pointer_cast<const FunctionConcept>(handle->data));
  }
  return indices;
}

FieldPtr from_values(const Call& call, const FieldType& type) {
  FieldPtr product = on_support(call);
  std::vector<std::string> components;
  for (const Keywords& occurrence : call.factors("AFFE")) {
    for (const std::string& name : occurrence.texts("NOM_CMP")) {
      check_component(occurrence, "NOM_CMP", type, name);
      add_name(components, name);
    }
  }
  product->field = empty_field(call, *product, type, components);
  for (const Keywords& occurrence : call.factors("AFFE")) {
    const auto names = occurrence.texts("NOM_CMP");
    const auto values = values_of(occurrence, type, *product);
    if (names.size() != values.size()) {
      throw DiagnosticError(
          "wrong-count", fmt::format("CREA_CHAMP: {} components stand against {} values", names.size(), values.size()),
          occurrence.span_of("NOM_CMP"), "give one value a component");
    }
    const auto where = places(occurrence, *product, type);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto column = std::ranges::find(components, names[i]) - components.begin();
      solver::assign(product->field, static_cast<int>(column), values[i], &where);
    }
  }
  return product;
}

solver::FieldPiece piece_of(const Keywords& occurrence, interpreter::Diagnostics& diagnostics) {
  solver::FieldPiece piece;
  piece.field = &number_field(occurrence.concept_of("CHAM_GD"), occurrence, "CHAM_GD").field;
  const std::vector<std::string>& all = solver::components_of(*piece.field);
  const bool renames = occurrence.given("NOM_CMP_RESU");
  piece.from = !occurrence.given("NOM_CMP") ? all
               : renames                    ? occurrence.texts("NOM_CMP")
                                            : known_components(occurrence, all, diagnostics);
  piece.to = renames ? occurrence.texts("NOM_CMP_RESU") : piece.from;
  if (piece.from.size() != piece.to.size()) {
    throw DiagnosticError("wrong-count",
                          fmt::format("CREA_CHAMP: {} components become {}", piece.from.size(), piece.to.size()),
                          occurrence.span_of("NOM_CMP_RESU"), "give as many names in NOM_CMP_RESU as in NOM_CMP");
  }
  for (const std::string& name : piece.from) component_of(occurrence, all, name);
  piece.factor = occurrence.real("COEF_R");
  piece.adds = occurrence.text("CUMUL") == "OUI";
  return piece;
}

FieldPtr from_pieces(const Call& call, const FieldType& type, interpreter::Diagnostics& diagnostics) {
  FieldPtr product = on_support(call);
  std::vector<solver::FieldPiece> pieces;
  std::vector<std::string> components;
  for (const Keywords& occurrence : call.factors("ASSE")) {
    pieces.push_back(piece_of(occurrence, diagnostics));
    const char* keyword = occurrence.given("NOM_CMP_RESU") ? "NOM_CMP_RESU"
                          : occurrence.given("NOM_CMP")    ? "NOM_CMP"
                                                           : "CHAM_GD";
    for (const std::string& name : pieces.back().to) {
      check_component(occurrence, keyword, type, name);
      add_name(components, name);
    }
  }
  product->field = empty_field(call, *product, type, std::move(components));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto where = places(call.factors("ASSE")[i], *product, type);
    solver::put_piece(product->field, pieces[i], &where);
  }
  return product;
}

void take_support(FieldConcept& product, const FieldConcept& from) {
  product.mesh = from.mesh;
  product.model = from.model;
}

// Of a sum of displacements, where all of them have as many.
std::shared_ptr<const MultiplierSum> multipliers_of_terms(const Call& call) {
  std::vector<std::pair<double, std::shared_ptr<const MultiplierSum>>> terms;
  for (const Keywords& occurrence : call.factors("COMB")) {
    const auto& field = occurrence.data<FieldConcept>("CHAM_GD");
    if (!field.multipliers) return nullptr;
    terms.emplace_back(occurrence.real("COEF_R"), field.multipliers);
  }
  return std::make_shared<const MultiplierSum>(std::move(terms));
}

FieldPtr from_terms(const Call& call) {
  auto product = std::make_shared<FieldConcept>();
  std::vector<solver::FieldTerm> terms;
  for (const Keywords& occurrence : call.factors("COMB")) {
    const FieldConcept& data = number_field(occurrence.concept_of("CHAM_GD"), occurrence, "CHAM_GD");
    if (terms.empty()) take_support(*product, data);
    terms.push_back({&data.field, occurrence.real("COEF_R")});
  }
  product->field = solver::linear_combination(terms);
  product->multipliers = multipliers_of_terms(call);
  return product;
}

FieldPtr from_functions(const Call& call, const FieldType& type) {
  const auto& which = call.data<FieldConcept>("CHAM_F");
  if (which.functions.empty()) {
    throw DiagnosticError(
        "wrong-type",
        fmt::format("CREA_CHAMP: {} is a field of numbers, not of functions", call.concept_of("CHAM_F")->name),
        call.span_of("CHAM_F"), "make it by OPERATION='AFFE' with a TYPE_CHAM that ends in _F");
  }
  std::vector<const solver::Field*> arguments;
  for (const auto& handle : call.concepts("CHAM_PARA"))
    arguments.push_back(&number_field(handle, call, "CHAM_PARA").field);
  auto product = std::make_shared<FieldConcept>();
  take_support(*product, which);
  product->field = solver::evaluate(*which.mesh, which.field, value_functions(which), arguments, type.quantity_name());
  return product;
}

FieldPtr of_mesh(const Call& call) {
  auto product = on_support(call);
  product->field = solver::node_coordinates(*product->mesh);
  return product;
}

// Unit normals at the nodes of boundary cells.
FieldPtr of_normals(const Call& call) {
  FieldPtr product = on_support(call);
  auto normals = solver::empty_nodal_field(*product->mesh, "GEOM_R", {"X", "Y", "Z"});
  for (const auto& [node, normal] : solver::mean_normals(*product->mesh, selected_cells(call, *product->mesh)))
    std::copy_n(normal.data(), 3, normals.values.begin() + 3 * node);
  product->field = std::move(normals);
  return product;
}

// CHAM_GD at other places.
FieldPtr brought(const Call& call, const FieldType& type) {
  const FieldConcept& from = number_field(call.concept_of("CHAM_GD"), call, "CHAM_GD");
  auto product = std::make_shared<FieldConcept>();
  take_support(*product, from);
  if (call.has("MODELE")) {
    product->model = call.data<ModelConcept>("MODELE").model;
    require_mesh(call, "MODELE", product->model->mesh.get(), *product->mesh);
  }
  try {
    if (type.place == FieldPlace::node) {
      product->field = solver::brought_to_nodes(*product->mesh, product->model.get(), from.field);
    } else {
      product->field = solver::brought_to(needed_model(call, *product, type), from.field, support_of(type.place),
                                          lives_on_skin(type));
    }
  } catch (const solver::Error& error) {
    throw DiagnosticError(error.code(), std::string("CREA_CHAMP: ") + error.what(), call.span_of("CHAM_GD"),
                          error.hint());
  }
  return product;
}

FieldPtr extracted(const Call& call, const FieldType& type) {
  if (call.has("RESULTAT")) return field_of_result(call);
  if (call.has("TABLE")) return field_of_table(call, type);
  if (call.has("CARA_ELEM")) return field_of_characteristics(call);
  return call.has("CHARGE") ? field_of_load(call) : of_mesh(call);
}

FieldPtr computed(const Call& call, const FieldType& type, Context& context) {
  const std::string& operation = call.text("OPERATION");
  FieldPtr product = operation == "ASSE"   ? from_pieces(call, type, context.diagnostics)
                     : operation == "COMB" ? from_terms(call)
                                           : from_functions(call, type);
  require_finite(product->field, *product->mesh, "CREA_CHAMP", call.span_of("OPERATION"));
  return product;
}

FieldPtr made_by(const Call& call, const FieldType& type, Context& context) {
  const std::string& operation = call.text("OPERATION");
  if (operation == "AFFE") return from_values(call, type);
  if (operation == "ASSE" || operation == "COMB" || operation == "EVAL") return computed(call, type, context);
  if (operation == "NORMALE") return of_normals(call);
  return operation == "DISC" ? brought(call, type) : extracted(call, type);
}

// Of another quantity it would be taken for what it is not. Functions have components alone.
void check_type(const Call& call, const FieldType& type, const solver::Field& field) {
  if (!lies_at(field, type.place)) {
    throw DiagnosticError("wrong-type",
                          fmt::format("CREA_CHAMP: the field has its values {}, not {} as TYPE_CHAM says",
                                      describe(place_of(field)), describe(type.place)),
                          call.span_of("TYPE_CHAM"));
  }
  const std::string& quantity = std::visit([](const auto& any) -> const std::string& { return any.quantity; }, field);
  const auto& components = solver::components_of(field);
  const auto unknown =
      std::ranges::find_if(components, [&](const std::string& name) { return !has_component(type, name); });
  if (quantity == type.quantity_name() && (call.text("OPERATION") != "EVAL" || unknown == components.end())) return;
  const std::string what = quantity == type.quantity_name() ? *unknown : quantity.substr(0, quantity.size() - 2);
  throw DiagnosticError(
      "wrong-type", fmt::format("CREA_CHAMP: the field is one of {}, not of {} as TYPE_CHAM says", what, type.quantity),
      call.span_of("TYPE_CHAM"), "OPERATION='ASSE' with NOM_CMP and NOM_CMP_RESU makes components of another quantity");
}

}  // namespace

Product crea_champ(const Call& call, Context& context) {
  const FieldType type = field_type(call.text("TYPE_CHAM"));
  if (call.has("TYPE_MAXI")) warn_of_missing_instants("CREA_CHAMP", call, context.diagnostics);
  FieldPtr product = made_by(call, type, context);
  check_type(call, type, product->field);
  finish(call, *product);
  return product;
}

}  // namespace comma::commands
