#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "commands/commands.hpp"
#include "commands/functions/curves.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

const solver::TabulatedFunction& points_of(const Keywords& curve, const char* keyword) {
  const auto* table = curve.data<FunctionConcept>(keyword).table();
  if (table != nullptr) return *table;
  throw DiagnosticError(
      "unsupported", fmt::format("IMPR_FONCTION: {} is not given by points", curve.concept_of(keyword)->name),
      curve.span_of(keyword), "say by LIST_PARA where it is evaluated, or tabulate it by CALC_FONC_INTERP");
}

std::vector<double> values_at(const Keywords& curve, const char* keyword, const std::vector<double>& places) {
  const auto& function = curve.data<FunctionConcept>(keyword);
  if (function.parameters().size() > 1) {
    throw DiagnosticError("unsupported",
                          fmt::format("IMPR_FONCTION: {} depends on {} parameters, a curve on one",
                                      curve.concept_of(keyword)->name, function.parameters().size()),
                          curve.span_of(keyword));
  }
  std::vector<double> values;
  for (const double place : places) values.push_back(function.evaluate({&place, 1}));
  return values;
}

// Where a function is evaluated: by LIST_PARA, else at its own points.
std::vector<double> places_of(const Keywords& curve, const char* keyword) {
  return curve.has("LIST_PARA") ? curve.data<ListConcept>("LIST_PARA").values : points_of(curve, keyword).x;
}

// TRI: its letters name what orders the points, the first letter above the second.
void sort_points(Curve& curve, const std::string& keys) {
  if (keys == "N") return;
  std::vector<std::size_t> order(curve.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    for (const char key : keys) {
      const auto& values = key == 'X' ? curve.x : curve.y;
      if (values[a] != values[b]) return values[a] < values[b];
    }
    return false;
  });
  const Curve before = curve;
  for (std::size_t i = 0; i < order.size(); ++i) {
    curve.x[i] = before.x[order[i]];
    curve.y[i] = before.y[order[i]];
  }
}

void fill_points(const Keywords& given, Curve& curve) {
  if (given.has("FONCTION")) {
    curve.label = given.concept_of("FONCTION")->name;
    curve.x = places_of(given, "FONCTION");
    curve.y = values_at(given, "FONCTION", curve.x);
  } else if (given.has("FONC_X")) {
    curve.label = given.concept_of("FONC_Y")->name;
    const auto places = places_of(given, "FONC_X");
    curve.x = values_at(given, "FONC_X", places);
    curve.y = values_at(given, "FONC_Y", places);
  } else if (given.has("LIST_RESU")) {
    curve.label = given.concept_of("LIST_RESU")->name;
    curve.x = given.data<ListConcept>("LIST_PARA").values;
    curve.y = given.data<ListConcept>("LIST_RESU").values;
  } else {
    curve.x = given.reals("ABSCISSE");
    curve.y = given.reals("ORDONNEE");
  }
}

Curve curve_of(const Keywords& given) {
  Curve curve;
  fill_points(given, curve);
  if (curve.x.size() != curve.y.size()) {
    throw DiagnosticError(
        "wrong-count",
        fmt::format("IMPR_FONCTION: a curve has {} abscissae and {} ordinates", curve.x.size(), curve.y.size()),
        given.span);
  }
  sort_points(curve, given.text("TRI"));
  if (given.has("LEGENDE")) curve.label = given.text("LEGENDE");
  const auto number = [&](const char* keyword) {
    return given.has(keyword) ? std::optional<int>(static_cast<int>(given.integer(keyword))) : std::nullopt;
  };
  curve.colour = number("COULEUR");
  curve.marker = number("MARQUEUR");
  curve.style = number("STYLE");
  curve.marker_step = number("FREQ_MARQUEUR");
  return curve;
}

std::string lines_of(const Call& call, const char* keyword) {
  return call.has(keyword) ? fmt::format("{}", fmt::join(call.texts(keyword), "\n")) : "";
}

Axis axis_of(const Call& call, char name) {
  Axis axis;
  const auto keyword = [&](const char* stem) { return fmt::format("{}_{}", stem, name); };
  if (const auto label = keyword("LEGENDE"); call.has(label)) axis.label = call.text(label);
  if (const auto bounds = keyword("BORNE"); call.has(bounds))
    axis.bounds = {call.reals(bounds)[0], call.reals(bounds)[1]};
  if (const auto grid = keyword("GRILLE"); call.has(grid)) axis.grid = call.real(grid);
  if (const auto scale = keyword("ECHELLE"); call.has(scale)) axis.logarithmic = call.text(scale) == "LOG";
  return axis;
}

Drawing drawing_of(const Call& call) {
  Drawing drawing{lines_of(call, "TITRE"), lines_of(call, "SOUS_TITRE"), axis_of(call, 'X'), axis_of(call, 'Y'), {}};
  for (const Keywords& given : call.factors("COURBE")) drawing.curves.push_back(curve_of(given));
  return drawing;
}

// The abscissae of the first curve lead; other functions are interpolated there (U4.33.01).
Table columns_of(const Call& call, const Drawing& drawing) {
  const auto given = call.factors("COURBE");
  const Curve& first = drawing.curves.front();
  Table table;
  table.columns = {given.front().has("FONCTION")
                       ? given.front().data<FunctionConcept>("FONCTION").parameters().empty()
                             ? "ABSCISSE"
                             : given.front().data<FunctionConcept>("FONCTION").parameters().front()
                       : "ABSCISSE"};
  for (const double x : first.x) table.rows.push_back({x});
  for (std::size_t k = 0; k < given.size(); ++k) {
    const Curve& curve = drawing.curves[k];
    table.columns.push_back(curve.label);
    const bool same = curve.x == first.x;
    if (!same && !given[k].has("FONCTION")) {
      throw DiagnosticError(
          "different-abscissae",
          "IMPR_FONCTION: in columns all curves have the abscissae of the first, and this one has others",
          given[k].span, "write it by an IMPR_FONCTION of its own");
    }
    const auto values = same ? curve.y : values_at(given[k], "FONCTION", first.x);
    for (std::size_t i = 0; i < first.x.size(); ++i) table.rows[i].emplace_back(values[i]);
  }
  return table;
}

std::string as_columns(const Call& call, const Drawing& drawing) {
  Table table = columns_of(call, drawing);
  const TableLayout layout{call.text("SEPARATEUR"), call.text("FORMAT_R"),    call.text("COMMENTAIRE"),
                           call.text("COMM_PARA"),  call.text("DEBUT_LIGNE"), call.text("FIN_LIGNE")};
  const std::string next_line = "\n" + layout.comment + " ";
  for (const char* keyword : {"TITRE", "SOUS_TITRE"}) {
    if (!call.has(keyword)) continue;
    table.title +=
        (table.title.empty() ? "" : next_line) + fmt::format("{}", fmt::join(call.texts(keyword), next_line));
  }
  return format_table(table, layout) + "\n";
}

}  // namespace

Product impr_fonction(const Call& call, Context& context) {
  const Drawing drawing = drawing_of(call);
  const std::string& format = call.text("FORMAT");
  const int unit = static_cast<int>(call.integer("UNITE"));
  if (format == "TABLEAU") {
    context.write(unit, "resu", 8, as_columns(call, drawing));
  } else if (format == "XMGRACE") {
    context.write(unit, "agr", 29, grace_file(drawing));
  } else {
    context.write(unit, "dogr", 25, curve_columns(drawing));
    context.write(static_cast<int>(call.integer("UNITE_DIGR")), "digr", 26, drawing_description(drawing));
  }
  return nullptr;
}

}  // namespace comma::commands
