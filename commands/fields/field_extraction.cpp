#include "commands/fields/field_extraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/analysis/result_reading.hpp"
#include "commands/tables/table_filter.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_room.hpp"
#include "solver/fields/field_history.hpp"
#include "solver/mesh/name_finder.hpp"

namespace comma::commands {

using interpreter::Call;
using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

// --- of a result

solver::Field extreme_of_steps(const Call& call, const solver::Result& result) {
  static const std::map<std::string, solver::ExtremeOverTime, std::less<>> kinds = {
      {"MAXI", solver::ExtremeOverTime::greatest},
      {"MINI", solver::ExtremeOverTime::least},
      {"MAXI_ABS", solver::ExtremeOverTime::greatest_magnitude},
      {"MINI_ABS", solver::ExtremeOverTime::least_magnitude},
      {"NORM_TRAN", solver::ExtremeOverTime::longest_translation}};
  std::vector<solver::FieldAtInstant> steps;
  for (const solver::ResultStep* step : steps_with_field(call, result))
    steps.push_back({step->instant, &field_of(call, *step)});
  const auto shown = call.text("TYPE_RESU") == "INST" ? solver::ExtremeShown::instant : solver::ExtremeShown::value;
  return solver::extreme_over_time(steps, kinds.at(call.text("TYPE_MAXI")), shown);
}

// Between the two steps around INST, if no step stands there.
solver::Field interpolated(const Call& call, const solver::Result& result) {
  const double instant = call.reals("INST").front();
  const auto reach = instant_reach(call, instant);
  const auto later =
      std::ranges::find_if(result.steps, [&](const auto& step) { return step.instant >= instant - reach; });
  if (later == result.steps.end() || (later == result.steps.begin() && later->instant > instant + reach) ||
      later->instant <= instant + reach) {
    return field_of(call, only_step(call, result, "a field is taken of one"));
  }
  const auto& earlier = *std::prev(later);
  return solver::between_instants({earlier.instant, &field_of(call, earlier)},
                                  {later->instant, &field_of(call, *later)}, instant);
}

solver::Field read_result(const Call& call, const solver::Result& result) {
  if (call.has("TYPE_MAXI")) return extreme_of_steps(call, result);
  const bool between = call.text("INTERPOL") == "LIN" && call.given("INST") && call.reals("INST").size() == 1;
  return between ? interpolated(call, result) : field_of(call, only_step(call, result, "a field is taken of one"));
}

// A step's displacements stand beside multipliers.
std::shared_ptr<const MultiplierSum> multipliers_beside(const Call& call) {
  if (call.text("NOM_CHAM") != "DEPL" || call.has("TYPE_MAXI") || call.text("INTERPOL") == "LIN") return {};
  auto data = std::dynamic_pointer_cast<const ResultConcept>(call.concept_of("RESULTAT")->data);
  const int order = only_step(call, data->result, "a field is taken of one").order;
  return std::make_shared<const MultiplierSum>([data, order] {
    const auto step = std::ranges::find(data->result.steps, order, &solver::ResultStep::order);
    return step == data->result.steps.end() ? std::vector<double>() : multipliers_of(*data, *step);
  });
}

// --- of a table

// Names are texts or, where a table was read from a file, numbers.
std::string name_in(const Cell& cell) {
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return std::to_string(*integer);
  const auto* text = std::get_if<std::string>(&cell);
  return text != nullptr ? *text : std::string();
}

class TableReader {
 public:
  TableReader(const Call& call, const FieldType& type, FieldConcept& product)
      : call_(call), type_(type), product_(product), table_(call.data<TableConcept>("TABLE").table) {}

  void read() {
    check_columns();
    const auto columns = component_columns();
    std::vector<std::string> names;
    for (const int column : columns) names.push_back(table_.columns[static_cast<std::size_t>(column)]);
    make_room(std::move(names));
    for (const auto& row : table_.rows) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto value = number_in(row[static_cast<std::size_t>(columns[i])]);
        if (value) store(slot(row, i), *value, row);
      }
    }
  }

 private:
  bool nodal() const { return type_.place == FieldPlace::node; }

  int column(const char* name) const { return table_.column(name); }

  void require(const char* name) const {
    if (column(name) >= 0) return;
    throw DiagnosticError("unknown-column",
                          fmt::format("CREA_CHAMP: a table of values {} has a column {}", describe(type_.place), name),
                          call_.span_of("TABLE"));
  }

  void check_columns() const {
    require(nodal() ? "NOEUD" : "MAILLE");
    if (type_.place == FieldPlace::gauss_point) require("POINT");
    if (type_.place == FieldPlace::element_node && column("NOEUD") < 0) require("POINT");
  }

  std::vector<int> component_columns() const {
    std::vector<int> columns;
    for (std::size_t i = 0; i < table_.columns.size(); ++i)
      if (has_component(type_, table_.columns[i])) columns.push_back(static_cast<int>(i));
    if (!columns.empty()) return columns;
    throw DiagnosticError("unknown-column",
                          fmt::format("CREA_CHAMP: no column of the table is a component of {}", type_.quantity),
                          call_.span_of("TABLE"), "rename the columns by CALC_TABLE");
  }

  void make_room(std::vector<std::string> names) {
    if (nodal()) {
      product_.field = solver::empty_nodal_field(*product_.mesh, type_.quantity_name(), std::move(names));
      return;
    }
    if (type_.place == FieldPlace::zone) {
      product_.field = solver::empty_cell_field(*product_.mesh, type_.quantity_name(), std::move(names));
    } else if (product_.model) {
      product_.field = solver::empty_element_field(*product_.model, type_.quantity_name(), support_of(type_.place),
                                                   std::move(names), lives_on_skin(type_));
    } else {
      throw DiagnosticError("missing-keyword",
                            fmt::format("CREA_CHAMP: a field {} lies on a model", describe(type_.place)), call_.span,
                            "give MODELE");
    }
  }

  double& slot(const std::vector<Cell>& row, std::size_t component) {
    if (auto* field = std::get_if<solver::NodalField>(&product_.field))
      return field->values[static_cast<std::size_t>(node_of(row)) * field->components.size() + component];
    auto& field = std::get<solver::ElementField>(product_.field);
    const int cell = cell_of(row);
    const int point = point_of(row, field, cell);
    if (point < 0 || point >= field.points(cell)) {
      throw DiagnosticError("out-of-bounds",
                            fmt::format("CREA_CHAMP: the table has point {} of cell {}, where the field has {}",
                                        point + 1, product_.mesh->cell_name(cell), field.points(cell)),
                            call_.span_of("TABLE"));
    }
    return field.values[static_cast<std::size_t>(field.starts[cell] + point) * field.components.size() + component];
  }

  // Rows of several instants would overwrite each other.
  void store(double& slot, double value, const std::vector<Cell>& row) const {
    if (std::isnan(slot)) {
      slot = value;
      return;
    }
    const std::string& name = name_in(row[static_cast<std::size_t>(column(nodal() ? "NOEUD" : "MAILLE"))]);
    throw DiagnosticError("repeated-row",
                          fmt::format("CREA_CHAMP: the table has several rows for one place, at {}", name),
                          call_.span_of("TABLE"), "leave the rows of one instant by CALC_TABLE, OPERATION='FILTRE'");
  }

  int node_of(const std::vector<Cell>& row) const {
    const std::string name = name_in(row[static_cast<std::size_t>(column("NOEUD"))]);
    if (const int node = nodes_.find(name); node >= 0) return node;
    throw DiagnosticError("unknown-node", "CREA_CHAMP: the table names a node that the mesh lacks: " + name,
                          call_.span_of("TABLE"));
  }

  int cell_of(const std::vector<Cell>& row) const {
    const std::string name = name_in(row[static_cast<std::size_t>(column("MAILLE"))]);
    if (const int cell = cells_.find(name); cell >= 0) return cell;
    throw DiagnosticError("unknown-cell", "CREA_CHAMP: the table names a cell that the mesh lacks: " + name,
                          call_.span_of("TABLE"));
  }

  int point_of(const std::vector<Cell>& row, const solver::ElementField& field, int cell) const {
    if (field.support == solver::Support::cell) return 0;
    if (field.support == solver::Support::element_node && column("NOEUD") >= 0) {
      const auto nodes = product_.mesh->cell(cell);
      const auto found = std::ranges::find(nodes, node_of(row));
      return found == nodes.end() ? -1 : static_cast<int>(found - nodes.begin());
    }
    const auto number = number_in(row[static_cast<std::size_t>(column("POINT"))]);
    return number ? static_cast<int>(std::lround(*number)) - 1 : -1;
  }

  const Call& call_;
  const FieldType& type_;
  FieldConcept& product_;
  const Table& table_;
  mutable solver::NameFinder nodes_{*product_.mesh, solver::NameFinder::Kind::nodes},
      cells_{*product_.mesh, solver::NameFinder::Kind::cells};
};

}  // namespace

std::shared_ptr<FieldConcept> field_of_result(const Call& call) {
  const solver::Result& result = call.data<ResultConcept>("RESULTAT").result;
  auto product = std::make_shared<FieldConcept>();
  product->model = result.model;
  product->mesh = result.model ? std::shared_ptr<const solver::Mesh>(result.model->mesh) : result.bare_mesh;
  try {
    product->field = read_result(call, result);
    product->multipliers = multipliers_beside(call);
    const auto& data = call.data<ResultConcept>("RESULTAT");
    const bool of_one_step = !call.has("TYPE_MAXI") && call.text("INTERPOL") != "LIN";
    product->behaviours = of_one_step ? data.problem_of(only_step(call, result, "a field is taken of one")).behaviours
                                      : data.problem.behaviours;
  } catch (const solver::Error& error) {
    throw DiagnosticError(error.code(), std::string("CREA_CHAMP: ") + error.what(), call.span_of("NOM_CHAM"),
                          error.hint());
  }
  return product;
}

std::shared_ptr<FieldConcept> field_of_table(const Call& call, const FieldType& type) {
  auto product = std::make_shared<FieldConcept>();
  if (call.has("MODELE")) {
    product->model = call.data<ModelConcept>("MODELE").model;
    product->mesh = product->model->mesh;
  } else if (call.has("MAILLAGE")) {
    product->mesh = call.data<MeshConcept>("MAILLAGE").mesh;
  } else {
    throw DiagnosticError("missing-keyword", "CREA_CHAMP: a table says nothing of the mesh", call.span,
                          "give MAILLAGE or MODELE");
  }
  TableReader(call, type, *product).read();
  return product;
}

}  // namespace comma::commands
