#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>

#include "commands/commands.hpp"
#include "commands/functions/curves.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

using Evaluation = std::function<double(double)>;

/// What stands against the abscissae of a curve: values, and the function behind them where there is one.
struct Line {
  std::string legend;
  std::string result = {};             ///< of the function, its NOM_RESU
  std::vector<double> x = {}, y = {};  ///< abscissae and values
  Evaluation function = {};
};

/// One occurrence of COURBE: one line, two for FONC_X and FONC_Y, or as many as a function of two parameters has
/// tables.
struct Source {
  Keywords given;
  std::string parameter;  ///< name of the abscissae; empty for those that are not written
  std::vector<Line> lines;

  bool is_parametric() const { return given.has("FONC_X"); }
};

std::string legend_of(const Keywords& given, const std::string& name) {
  return given.has("LEGENDE") ? given.text("LEGENDE") : name;
}

// By LIST_PARA, else at points of its own.
void take_points(const Keywords& given, const char* keyword, const solver::TabulatedFunction* points, Line& line) {
  if (points == nullptr && !given.has("LIST_PARA")) {
    throw DiagnosticError(
        "unsupported", fmt::format("IMPR_FONCTION: {} is not given by points", given.concept_of(keyword)->name),
        given.span_of(keyword), "say by LIST_PARA where it is evaluated, or tabulate it by CALC_FONC_INTERP");
  }
  line.result = points != nullptr ? points->result : "TOUTRESU";
  line.x = given.has("LIST_PARA") ? given.data<ListConcept>("LIST_PARA").values : points->x;
  for (const double place : line.x) line.y.push_back(line.function(place));
}

Line line_of(const Keywords& given, const char* keyword) {
  const auto& function = given.data<FunctionConcept>(keyword);
  const std::string& name = given.concept_of(keyword)->name;
  if (function.parameters().size() > 1) {
    throw DiagnosticError(
        "unsupported",
        fmt::format("IMPR_FONCTION: {} depends on {} parameters, a curve on one", name, function.parameters().size()),
        given.span_of(keyword));
  }
  Line line{legend_of(given, name)};
  line.function = [&function](double place) { return function.evaluate({&place, 1}); };
  take_points(given, keyword, function.points(), line);
  return line;
}

// A function of two parameters: a line for each value of the first.
std::vector<Line> lines_of(const Keywords& given, const SurfaceConcept& surface) {
  std::vector<Line> lines;
  const std::string name = legend_of(given, given.concept_of("FONCTION")->name);
  for (std::size_t i = 0; i < surface.rows().size(); ++i) {
    const solver::TabulatedFunction& row = *surface.rows()[i];
    Line& line = lines.emplace_back();
    line.legend = fmt::format("{} {}={:g}", name, surface.parameters().front(), surface.edges().x[i]);
    line.function = [&row](double place) { return row(place); };
    take_points(given, "FONCTION", &row, line);
    line.result = surface.edges().result;
  }
  return lines;
}

std::string parameter_of(const FunctionConcept& function) {
  return function.parameters().empty() ? "TOUTPARA" : function.parameters().back();
}

Source points_of(const Keywords& given) {
  if (given.has("FONCTION")) {
    const auto& function = given.data<FunctionConcept>("FONCTION");
    const auto* surface = dynamic_cast<const SurfaceConcept*>(&function);
    const auto lines = surface != nullptr ? lines_of(given, *surface) : std::vector{line_of(given, "FONCTION")};
    return {given, parameter_of(function), lines};
  }
  if (given.has("FONC_X")) {
    const Line x = line_of(given, "FONC_X");
    Line y = line_of(given, "FONC_Y");
    if (given.has("LIST_PARA")) return {given, parameter_of(given.data<FunctionConcept>("FONC_X")), {x, y}};
    y.x = x.x;
    y.y.clear();
    std::ranges::transform(y.x, std::back_inserter(y.y), y.function);
    return {given, "", {x, y}};
  }
  if (given.has("LIST_RESU")) {
    const std::string& name = given.concept_of("LIST_RESU")->name;
    const Line line{legend_of(given, given.concept_of("LIST_PARA")->name), name,
                    given.data<ListConcept>("LIST_PARA").values, given.data<ListConcept>("LIST_RESU").values};
    return {given, given.concept_of("LIST_PARA")->name, {line}};
  }
  return {given, "Absc", {{legend_of(given, ""), "Ordo", given.reals("ABSCISSE"), given.reals("ORDONNEE")}}};
}

// TRI: its letters name what orders the points, the first letter above the second.
void sort_points(std::vector<double>& x, std::vector<double>& y, const std::string& keys) {
  if (keys == "N") return;
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    for (const char key : keys) {
      const auto& values = key == 'X' ? x : y;
      if (values[a] != values[b]) return values[a] < values[b];
    }
    return false;
  });
  const auto before_x = x, before_y = y;
  for (std::size_t i = 0; i < order.size(); ++i) {
    x[i] = before_x[order[i]];
    y[i] = before_y[order[i]];
  }
}

Source source_of(const Keywords& given) {
  Source source = points_of(given);
  for (Line& line : source.lines) {
    if (line.x.size() != line.y.size()) {
      throw DiagnosticError(
          "wrong-count",
          fmt::format("IMPR_FONCTION: a curve has {} abscissae and {} ordinates", line.x.size(), line.y.size()),
          given.span);
    }
    if (!source.is_parametric()) sort_points(line.x, line.y, given.text("TRI"));
  }
  return source;
}

Curve curve_of(const Source& source, const Line& line) {
  const Keywords& given = source.given;
  Curve curve;
  curve.label = source.is_parametric() ? legend_of(given, given.concept_of("FONC_Y")->name) : line.legend;
  curve.x = source.is_parametric() ? source.lines.front().y : line.x;
  curve.y = line.y;
  if (source.is_parametric()) sort_points(curve.x, curve.y, given.text("TRI"));
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

Drawing drawing_of(const Call& call, const std::vector<Source>& sources) {
  Drawing drawing{lines_of(call, "TITRE"), lines_of(call, "SOUS_TITRE"), axis_of(call, 'X'), axis_of(call, 'Y'), {}};
  for (const Source& source : sources) {
    if (source.is_parametric())
      drawing.curves.push_back(curve_of(source, source.lines.back()));
    else
      for (const Line& line : source.lines) drawing.curves.push_back(curve_of(source, line));
  }
  return drawing;
}

// The name of a function's result, eight letters of it, and the number of the column; lists have their own.
std::string column_name(const Table& table, const Line& line, std::size_t number) {
  if (!line.function && table.column(line.result) < 0) return line.result;
  constexpr std::size_t most_letters = 8;
  return fmt::format("{}_{}", line.result.substr(0, most_letters), number);
}

std::vector<double> values_at(const Source& source, const Line& line, const std::vector<double>& places) {
  if (line.x == places) return line.y;
  if (!line.function) {
    throw DiagnosticError(
        "different-abscissae",
        "IMPR_FONCTION: in columns all curves have the abscissae of the first, and this one has others",
        source.given.span, "write it by an IMPR_FONCTION of its own");
  }
  std::vector<double> values;
  std::ranges::transform(places, std::back_inserter(values), line.function);
  return values;
}

// The abscissae of the first curve lead; other functions are interpolated there (U4.33.01).
Table columns_of(const std::vector<Source>& sources) {
  const std::vector<double>& places = sources.front().lines.front().x;
  Table table;
  table.rows.resize(places.size());
  if (!sources.front().parameter.empty()) {
    table.columns = {sources.front().parameter};
    for (std::size_t i = 0; i < places.size(); ++i) table.rows[i].emplace_back(places[i]);
  }
  std::size_t number = 0;
  for (const Source& source : sources) {
    for (const Line& line : source.lines) {
      table.columns.push_back(column_name(table, line, number++));
      const auto values = values_at(source, line, places);
      for (std::size_t i = 0; i < places.size(); ++i) table.rows[i].emplace_back(values[i]);
    }
  }
  return table;
}

// TITRE, SOUS_TITRE, and the number and the legend of each curve.
std::string title_of(const Call& call, const std::vector<Source>& sources, const std::string& comment) {
  std::vector<std::string> lines;
  for (const char* keyword : {"TITRE", "SOUS_TITRE"}) {
    const auto texts = call.has(keyword) ? call.texts(keyword) : std::vector<std::string>{""};
    lines.insert(lines.end(), texts.begin(), texts.end());
  }
  int number = 0;
  for (const Source& source : sources) {
    for (const Line& line : source.lines) {
      if (source.is_parametric() && &line != &source.lines.front()) continue;
      lines.push_back(fmt::format("Courbe {}", number++));
      lines.push_back(line.legend);
    }
  }
  return fmt::format("{0} {1}", comment, fmt::join(lines, "\n" + comment + " "));
}

std::string as_columns(const Call& call, const std::vector<Source>& sources) {
  Table table = columns_of(sources);
  const TableLayout layout{call.text("SEPARATEUR"), call.text("FORMAT_R"),    call.text("COMMENTAIRE"),
                           call.text("COMM_PARA"),  call.text("DEBUT_LIGNE"), call.text("FIN_LIGNE")};
  table.title = title_of(call, sources, layout.comment);
  return format_table(table, layout) + "\n";
}

}  // namespace

Product impr_fonction(const Call& call, Context& context) {
  std::vector<Source> sources;
  for (const Keywords& given : call.factors("COURBE")) sources.push_back(source_of(given));
  const Drawing drawing = drawing_of(call, sources);
  const std::string& format = call.text("FORMAT");
  const int unit = static_cast<int>(call.integer("UNITE"));
  if (format == "TABLEAU") {
    context.write(unit, "resu", 8, as_columns(call, sources));
  } else if (format == "XMGRACE") {
    context.write(unit, "agr", 29, grace_file(drawing));
  } else {
    context.write(unit, "dogr", 25, curve_columns(drawing));
    context.write(static_cast<int>(call.integer("UNITE_DIGR")), "digr", 26, drawing_description(drawing));
  }
  return nullptr;
}

}  // namespace comma::commands
