#include "solver/fields/field_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "solver/elements/beam_points.hpp"
#include "solver/elements/discrete_forces.hpp"
#include "solver/elements/quadrature.hpp"
#include "solver/error.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

std::vector<std::string>& components_of(Field& field) {
  return std::visit([](auto& values) -> std::vector<std::string>& { return values.components; }, field);
}
std::string& quantity_of(Field& field) {
  return std::visit([](auto& values) -> std::string& { return values.quantity; }, field);
}
int component_of(const Field& field, std::string_view name) {
  return std::visit([&](const auto& values) { return values.component(name); }, field);
}

/// The stresses or strains of an element that carries stiffness; nothing for other quantities.
std::set<std::string_view> known_components(const ElementField& field, Formulation formulation, CellType type) {
  static const std::set<std::string_view> plane_strains = {"EPXX", "EPYY", "EPZZ", "EPXY"},
                                          solid_strains = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};
  const int continuum = continuum_dimension(formulation);
  if (field.support == Support::cell) return {};
  if (field.quantity == "EPSI_R")
    return continuum == 3 ? solid_strains : continuum == 2 ? plane_strains : std::set<std::string_view>();
  if (field.quantity != "SIEF_R") return {};
  std::set<std::string_view> names;
  const auto add = [&](auto&& others) { names.insert(others.begin(), others.end()); };
  if (continuum == 2) add(plane_stress_names);
  if (continuum == 3) add(solid_stress_names);
  if (mixed_field_count(formulation) > 0) add(std::array{std::string_view("SIP")});
  if (is_stabilised(formulation, type) && field.support == Support::gauss_point) add(hourglass_stress_names);
  if (is_beam(formulation)) add(beam_force_names);
  if (is_bar(formulation)) add(std::array{beam_force_names[0]});
  if (is_discrete(formulation)) add(discrete_force_names(formulation));
  return names;
}

/// The rows of a field: place p has those from starts()[p] to starts()[p + 1].
class FieldRows {
 public:
  explicit FieldRows(const Field& field) {
    if (const auto* element = std::get_if<ElementField>(&field)) {
      starts_ = element->starts;
      return;
    }
    const auto& nodal = std::get<NodalField>(field);
    starts_.resize(nodal.values.size() / nodal.components.size() + 1);
    std::iota(starts_.begin(), starts_.end(), 0);
  }
  int place_count() const { return static_cast<int>(starts_.size()) - 1; }
  int begin(int place) const { return starts_[place]; }
  int end(int place) const { return starts_[place + 1]; }
  int count(int place) const { return end(place) - begin(place); }
  int total() const { return starts_.back(); }

 private:
  std::vector<int> starts_;
};

bool same_kind(const Field& a, const Field& b) {
  if (a.index() != b.index()) return false;
  const auto* element = std::get_if<ElementField>(&a);
  return element == nullptr || element->support == std::get<ElementField>(b).support;
}

void check_places(const Field& a, const Field& b) {
  if (same_kind(a, b) && FieldRows(a).place_count() == FieldRows(b).place_count()) return;
  throw Error("incompatible-field", "the fields do not lie at the same places",
              "give fields of one mesh, all at its nodes, or at nodes of cells, Gauss points, cells alike");
}

template <class Visit>
void each_place(int count, const std::vector<int>* places, Visit&& visit) {
  if (places != nullptr) {
    for (const int place : *places) visit(place);
  } else {
    for (int place = 0; place < count; ++place) visit(place);
  }
}

int point_count(const Model& model, int cell, Support support, bool skin) {
  const Formulation formulation = model.formulations[cell];
  const bool is_skin = model.is_skin(cell);
  if (formulation == Formulation::none || (is_skin && !skin)) return 0;
  const CellType type = model.mesh->cell_types[cell];
  if (support == Support::cell) return 1;
  if (support == Support::element_node) return node_count(type);
  if (is_skin) return static_cast<int>(quadrature(type, boundary_family(type)).size());
  if (continuum_dimension(formulation) > 0) {
    return static_cast<int>(quadrature(type, stiffness_family(type, formulation)).size());
  }
  if (is_plate(formulation)) return static_cast<int>(quadrature(type, plate_family(type)).size());
  return is_beam(formulation) ? beam_point_count : 1;
}

}  // namespace

ElementField empty_element_field(const Model& model, std::string quantity, Support support,
                                 std::vector<std::string> components, bool skin) {
  ElementField field{std::move(quantity), support, std::move(components), {0}, {}};
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    field.starts.push_back(field.starts.back() + point_count(model, cell, support, skin));
  }
  field.values.assign(static_cast<std::size_t>(field.starts.back()) * field.components.size(), absent);
  return field;
}

ElementField empty_cell_field(const Mesh& mesh, std::string quantity, std::vector<std::string> components) {
  ElementField field{std::move(quantity), Support::cell, std::move(components), {}, {}};
  field.starts.resize(mesh.cell_types.size() + 1);
  std::iota(field.starts.begin(), field.starts.end(), 0);
  field.values.assign(mesh.cell_types.size() * field.components.size(), absent);
  return field;
}

NodalField empty_nodal_field(const Mesh& mesh, std::string quantity, std::vector<std::string> components) {
  std::vector<double> values(mesh.nodes.size() * components.size(), absent);
  return {std::move(quantity), std::move(components), std::move(values)};
}

const std::vector<std::string>& components_of(const Field& field) {
  return std::visit([](const auto& values) -> const std::vector<std::string>& { return values.components; }, field);
}

NodalField node_coordinates(const Mesh& mesh) {
  NodalField field = empty_nodal_field(mesh, "GEOM_R", {"X", "Y", "Z"});
  auto target = field.values.begin();
  for (const Point& at : mesh.nodes) target = std::copy(at.begin(), at.end(), target);
  return field;
}

Field uniform_like(const Field& other, std::string component, double value) {
  Field field = other;
  values_of(field).assign(static_cast<std::size_t>(FieldRows(other).total()), value);
  components_of(field) = {std::move(component)};
  return field;
}

std::optional<FieldEntry> first_infinite(const Field& field) {
  const FieldRows rows(field);
  const auto width = static_cast<int>(components_of(field).size());
  const auto& values = values_of(field);
  for (int place = 0; place < rows.place_count(); ++place) {
    for (int i = 0; i < rows.count(place) * width; ++i) {
      if (std::isinf(values[static_cast<std::size_t>(rows.begin(place)) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(i)])) {
        return FieldEntry{place, i / width, i % width};
      }
    }
  }
  return std::nullopt;
}

void assign(Field& field, int component, double value, const std::vector<int>* places) {
  const FieldRows rows(field);
  const std::size_t width = components_of(field).size();
  auto& values = values_of(field);
  each_place(rows.place_count(), places, [&](int place) {
    for (int row = rows.begin(place); row < rows.end(place); ++row) {
      values[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(component)] = value;
    }
  });
}

void fill_absent(Field& field, double value) {
  for (double& each : values_of(field)) {
    if (std::isnan(each)) each = value;
  }
}

void fill_with_zeros(ElementField& field, const Model& model) {
  std::map<std::pair<Formulation, CellType>, std::set<std::string_view>> known;
  std::set<std::string_view> wanted;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (field.points(cell) == 0 || model.is_skin(cell)) continue;
    const std::pair kind(model.formulations[static_cast<std::size_t>(cell)],
                         model.mesh->cell_types[static_cast<std::size_t>(cell)]);
    if (known.contains(kind)) continue;
    known[kind] = known_components(field, kind.first, kind.second);
    wanted.insert(known[kind].begin(), known[kind].end());
  }
  const std::size_t before = field.components.size();
  for (const std::string_view name : wanted)
    if (field.component(name) < 0) field.components.emplace_back(name);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(field.starts.back()) * field.components.size());
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    const auto kind = known.find(
        {model.formulations[static_cast<std::size_t>(cell)], model.mesh->cell_types[static_cast<std::size_t>(cell)]});
    std::vector<double> unsaid;
    for (const std::string& name : field.components) {
      const bool is_own = kind == known.end() || kind->second.empty() || kind->second.contains(name);
      unsaid.push_back(is_own || !wanted.contains(name) ? 0.0 : absent);
    }
    for (int row = field.starts[static_cast<std::size_t>(cell)]; row < field.starts[static_cast<std::size_t>(cell) + 1];
         ++row)
      for (std::size_t c = 0; c < unsaid.size(); ++c) {
        const double said = c < before ? field.values[static_cast<std::size_t>(row) * before + c] : absent;
        values.push_back(std::isnan(said) ? unsaid[c] : said);
      }
  }
  field.values = std::move(values);
}

std::span<const double> values_of_cell(const ElementField& field, int cell) {
  const std::size_t width = field.components.size(), first = static_cast<std::size_t>(field.starts[cell]) * width,
                    end = static_cast<std::size_t>(field.starts[cell + 1]) * width;
  return std::span(field.values).subspan(first, end - first);
}

bool has_other_than_zero(const ElementField& field, int cell) {
  return std::ranges::any_of(values_of_cell(field, cell), [](double value) { return std::abs(value) > 0.0; });
}

bool is_zero(const ElementField& field, int cell) {
  return !has_other_than_zero(field, cell) &&
         std::ranges::any_of(values_of_cell(field, cell), [](double value) { return value == 0.0; });
}

void drop_empty_cells(ElementField& field) {
  const auto cell_count = static_cast<int>(field.starts.size()) - 1;
  const auto width = static_cast<std::ptrdiff_t>(field.components.size());
  std::vector<int> starts = {0};
  std::vector<double> values;
  for (int cell = 0; cell < cell_count; ++cell) {
    const auto begin = field.values.begin() + field.starts[cell] * width;
    const auto end = field.values.begin() + field.starts[cell + 1] * width;
    const bool carries = std::any_of(begin, end, [](double value) { return !std::isnan(value); });
    if (carries) values.insert(values.end(), begin, end);
    starts.push_back(starts.back() + (carries ? field.points(cell) : 0));
  }
  field.starts = std::move(starts);
  field.values = std::move(values);
}

ElementField on_cells(const ElementField& field, std::span<const int> cells) {
  std::vector<bool> chosen(field.starts.size() - 1, false);
  for (const int cell : cells) chosen[static_cast<std::size_t>(cell)] = true;
  const auto width = static_cast<std::ptrdiff_t>(field.components.size());
  ElementField part{field.quantity, field.support, field.components, {0}, {}};
  for (int cell = 0; cell < static_cast<int>(chosen.size()); ++cell) {
    if (chosen[static_cast<std::size_t>(cell)]) {
      part.values.insert(part.values.end(), field.values.begin() + field.starts[cell] * width,
                         field.values.begin() + field.starts[cell + 1] * width);
    }
    part.starts.push_back(static_cast<int>(static_cast<std::ptrdiff_t>(part.values.size()) / width));
  }
  const auto has_several = [&](int cell) { return part.points(cell) > 0 && field.values_a_point(cell) > 1; };
  if (std::ranges::any_of(cells, has_several)) part.sub_points = field.sub_points;
  return part;
}

NodalField on_nodes(const NodalField& field, std::span<const int> nodes) {
  const std::size_t width = field.components.size();
  NodalField part{field.quantity, field.components, std::vector<double>(field.values.size(), absent)};
  for (const int node : nodes) {
    const auto begin = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * width);
    std::copy_n(field.values.begin() + begin, width, part.values.begin() + begin);
  }
  return part;
}

std::optional<int> cell_of_other_values(const ElementField& field, const ElementField& given) {
  // Values as near to each other as this share of the largest are the same.
  constexpr double same = 1e-6;
  Field both = field;
  take_common_values(both, given);
  const std::vector<double>& values = values_of(both);
  double largest = 0.0;
  for (const std::vector<double>* each : {&values, &field.values})
    for (const double value : *each)
      if (!std::isnan(value)) largest = std::max(largest, std::abs(value));
  for (std::size_t cell = 0; cell + 1 < field.starts.size(); ++cell) {
    const auto width = field.components.size(), end = static_cast<std::size_t>(field.starts[cell + 1]) * width;
    for (auto k = static_cast<std::size_t>(field.starts[cell]) * width; k < end; ++k)
      if (std::abs(values[k] - field.values[k]) > same * largest) return static_cast<int>(cell);
  }
  return std::nullopt;
}

ElementField side_by_side(const ElementField& first, const ElementField& second) {
  if (first.values.empty()) return second;
  ElementField both{first.quantity, first.support, first.components, {0}, {}};
  for (const std::string& name : second.components)
    if (both.component(name) < 0) both.components.push_back(name);
  const bool is_layered = !first.sub_points.empty() || !second.sub_points.empty();
  for (int cell = 0; cell + 1 < static_cast<int>(first.starts.size()); ++cell) {
    const ElementField& part = first.points(cell) > 0 ? first : second;
    for (int point = 0; point < part.points(cell); ++point) {
      for (const std::string& name : both.components) {
        const int column = part.component(name);
        both.values.push_back(column < 0 ? absent : part.at(cell, point, column));
      }
    }
    both.starts.push_back(both.starts.back() + part.points(cell));
    if (is_layered) both.sub_points.push_back(part.values_a_point(cell));
  }
  return both;
}

Field with_components(const Field& field, std::span<const int> components) {
  const std::size_t width = components_of(field).size();
  const auto rows = static_cast<std::size_t>(FieldRows(field).total());
  Field part = field;
  components_of(part).clear();
  for (const int component : components)
    components_of(part).push_back(components_of(field)[static_cast<std::size_t>(component)]);
  auto& values = values_of(part);
  values.clear();
  for (std::size_t row = 0; row < rows; ++row) {
    for (const int component : components)
      values.push_back(values_of(field)[row * width + static_cast<std::size_t>(component)]);
  }
  return part;
}

namespace {

/// Whether a model alone does not say at how many points the element of a cell has forces.
bool has_open_room(const Model& model, int cell, Support support) {
  return support == Support::gauss_point && is_discrete(model.formulations[static_cast<std::size_t>(cell)]);
}

}  // namespace

void take_room(ElementField& target, const Model& model, std::span<const FieldPiece> pieces,
               std::span<const std::vector<int>> places) {
  std::vector<int> counts(target.starts.size() - 1);
  for (std::size_t cell = 0; cell < counts.size(); ++cell) counts[cell] = target.points(static_cast<int>(cell));
  std::vector<bool> is_taken(counts.size(), false);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto* piece = std::get_if<ElementField>(pieces[i].field);
    if (piece == nullptr || piece->starts.size() != target.starts.size()) continue;
    for (const int cell : places[i]) {
      if (is_taken[cell] || piece->points(cell) == 0 || !has_open_room(model, cell, target.support)) continue;
      counts[cell] = piece->points(cell);
      is_taken[cell] = true;
    }
  }
  std::inclusive_scan(counts.begin(), counts.end(), target.starts.begin() + 1);
  target.values.assign(static_cast<std::size_t>(target.starts.back()) * target.components.size(), absent);
}

void put_piece(Field& target, const FieldPiece& piece, const std::vector<int>* places) {
  check_places(target, *piece.field);
  const FieldRows to_rows(target), from_rows(*piece.field);
  const auto& from = piece.from.empty() ? components_of(*piece.field) : piece.from;
  const auto& to = piece.to.empty() ? from : piece.to;
  const std::size_t from_width = components_of(*piece.field).size(), to_width = components_of(target).size();
  const auto& given = values_of(*piece.field);
  auto& values = values_of(target);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const int source = component_of(*piece.field, from[i]), sink = component_of(target, to[i]);
    if (source < 0 || sink < 0) {
      throw Error("unknown-component", fmt::format("the field has no component {}", source < 0 ? from[i] : to[i]));
    }
    each_place(to_rows.place_count(), places, [&](int place) {
      if (from_rows.count(place) == 0 || to_rows.count(place) == 0) return;
      if (from_rows.count(place) != to_rows.count(place)) {
        throw Error("incompatible-field", fmt::format("a cell has {} points in one field and {} in the other",
                                                      from_rows.count(place), to_rows.count(place)));
      }
      for (int point = 0; point < to_rows.count(place); ++point) {
        const double value = given[static_cast<std::size_t>(from_rows.begin(place) + point) * from_width +
                                   static_cast<std::size_t>(source)];
        if (std::isnan(value)) continue;
        double& slot =
            values[static_cast<std::size_t>(to_rows.begin(place) + point) * to_width + static_cast<std::size_t>(sink)];
        const double base = piece.adds && !std::isnan(slot) ? slot : 0.0;
        slot = made_number(base + piece.factor * value);
      }
    });
  }
}

void take_common_values(Field& target, const Field& source) {
  check_places(target, source);
  const FieldRows to_rows(target), from_rows(source);
  const auto &names = components_of(target), &given_names = components_of(source);
  const auto& given = values_of(source);
  auto& values = values_of(target);
  for (std::size_t sink = 0; sink < names.size(); ++sink) {
    const int column = component_of(source, names[sink]);
    for (int place = 0; column >= 0 && place < to_rows.place_count(); ++place) {
      if (from_rows.count(place) != to_rows.count(place)) continue;
      for (int point = 0; point < to_rows.count(place); ++point) {
        double& slot = values[static_cast<std::size_t>(to_rows.begin(place) + point) * names.size() + sink];
        const double value = given[static_cast<std::size_t>(from_rows.begin(place) + point) * given_names.size() +
                                   static_cast<std::size_t>(column)];
        if (!std::isnan(slot) && !std::isnan(value)) slot = value;
      }
    }
  }
}

namespace {

/// Room wherever one of the terms has it.
std::vector<int> united_starts(std::span<const FieldTerm> terms) {
  std::vector<FieldRows> rows;
  for (const FieldTerm& term : terms) rows.emplace_back(*term.field);
  std::vector<int> starts = {0};
  for (int place = 0; place < rows.front().place_count(); ++place) {
    int points = 0;
    for (const FieldRows& own : rows) points = std::max(points, own.count(place));
    starts.push_back(starts.back() + points);
  }
  return starts;
}

}  // namespace

Field linear_combination(std::span<const FieldTerm> terms) {
  // The components and the room of all terms together.
  std::vector<std::string> components;
  for (const FieldTerm& term : terms) {
    check_places(*terms.front().field, *term.field);
    for (const std::string& name : components_of(*term.field)) {
      if (std::find(components.begin(), components.end(), name) == components.end()) components.push_back(name);
    }
  }
  const auto starts = united_starts(terms);
  Field sum = *terms.front().field;
  if (auto* element = std::get_if<ElementField>(&sum)) element->starts = starts;
  values_of(sum).assign(static_cast<std::size_t>(starts.back()) * components.size(), absent);
  components_of(sum) = std::move(components);
  for (const FieldTerm& term : terms) put_piece(sum, {term.field, {}, {}, term.factor, true});
  return sum;
}

namespace {

/// Where a parameter of a function stands among the arguments.
struct ArgumentPlace {
  std::size_t argument;
  int component;
};

std::vector<ArgumentPlace> argument_places(const ValueFunction& function, std::span<const Field* const> arguments) {
  std::vector<ArgumentPlace> places;
  for (const std::string& parameter : function.parameters) {
    std::size_t argument = 0;
    while (argument < arguments.size() && component_of(*arguments[argument], parameter) < 0) ++argument;
    if (argument == arguments.size()) {
      throw Error("missing-variable",
                  fmt::format("a function depends on {}, which is a component of none of the fields", parameter));
    }
    places.push_back({argument, component_of(*arguments[argument], parameter)});
  }
  return places;
}

}  // namespace

Field evaluate(const Mesh& mesh, const Field& which, std::span<const ValueFunction> functions,
               std::span<const Field* const> arguments, std::string quantity) {
  const FieldRows rows(which);
  std::vector<FieldRows> argument_rows;
  for (const Field* argument : arguments) {
    check_places(which, *argument);
    argument_rows.emplace_back(*argument);
  }
  std::vector<std::vector<ArgumentPlace>> places;
  for (const ValueFunction& function : functions) places.push_back(argument_places(function, arguments));
  Field result = which;
  quantity_of(result) = std::move(quantity);
  const std::size_t width = components_of(result).size();
  std::vector<double> at;
  const auto value_at = [&](int place, int point, std::size_t index) {
    at.clear();
    for (const ArgumentPlace& source : places[index]) {
      const FieldRows& source_rows = argument_rows[source.argument];
      const bool carried = point < source_rows.count(place);
      const std::size_t source_width = components_of(*arguments[source.argument]).size();
      const double value =
          carried ? values_of(*arguments[source.argument])[static_cast<std::size_t>(source_rows.begin(place) + point) *
                                                               source_width +
                                                           static_cast<std::size_t>(source.component)]
                  : absent;
      if (std::isnan(value)) {
        const bool nodal = std::holds_alternative<NodalField>(which);
        throw Error(
            "missing-variable",
            fmt::format("a function depends on {}, which has no value at {} {}", functions[index].parameters[at.size()],
                        nodal ? "node" : "a point of cell", nodal ? mesh.node_name(place) : mesh.cell_name(place)));
      }
      at.push_back(value);
    }
    return made_number(functions[index].value(at));
  };
  for (int place = 0; place < rows.place_count(); ++place) {
    for (int point = 0; point < rows.count(place); ++point) {
      for (std::size_t c = 0; c < width; ++c) {
        double& value = values_of(result)[static_cast<std::size_t>(rows.begin(place) + point) * width + c];
        if (!std::isnan(value)) value = value_at(place, point, static_cast<std::size_t>(value));
      }
    }
  }
  return result;
}

}  // namespace comma::solver
