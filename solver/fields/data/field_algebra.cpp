#include "solver/fields/data/field_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/data/field_rows.hpp"

namespace comma::solver {

namespace {

std::string& quantity_of(Field& field) {
  return std::visit([](auto& values) -> std::string& { return values.quantity; }, field);
}
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

}  // namespace

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
