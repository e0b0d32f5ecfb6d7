#include "commands/functions/function_building.hpp"

#include <fmt/format.h>

#include "interpreter/diagnostic.hpp"

namespace comma::commands {

solver::Extension extension_named(const std::string& word) {
  if (word == "CONSTANT") return solver::Extension::constant;
  if (word == "LINEAIRE") return solver::Extension::linear;
  return solver::Extension::excluded;
}

solver::Scale scale_named(const std::string& word) {
  return word == "LOG" ? solver::Scale::logarithmic : solver::Scale::linear;
}

const char* word_of(solver::Extension extension) {
  if (extension == solver::Extension::excluded) return "EXCLU";
  return extension == solver::Extension::constant ? "CONSTANT" : "LINEAIRE";
}

const char* word_of(solver::Scale scale) { return scale == solver::Scale::linear ? "LIN" : "LOG"; }

void read_shape(const interpreter::Keywords& keywords, solver::TabulatedFunction& function, const std::string& suffix) {
  if (keywords.has("INTERPOL" + suffix)) {
    const auto scales = keywords.texts("INTERPOL" + suffix);
    function.x_scale = scale_named(scales.front());
    function.y_scale = scale_named(scales.back());
  }
  if (keywords.has("PROL_GAUCHE" + suffix)) function.left = extension_named(keywords.text("PROL_GAUCHE" + suffix));
  if (keywords.has("PROL_DROITE" + suffix)) function.right = extension_named(keywords.text("PROL_DROITE" + suffix));
}

void read_pairs(const interpreter::Keywords& keywords, solver::TabulatedFunction& function) {
  const auto values = keywords.reals("VALE");
  if (values.size() % 2 != 0) {
    throw interpreter::DiagnosticError(
        "wrong-count", fmt::format("DEFI_FONCTION: VALE holds pairs x, y; it has {} values", values.size()),
        keywords.span_of("VALE"), "give an even number of values");
  }
  for (std::size_t i = 0; i < values.size(); i += 2) {
    function.x.push_back(values[i]);
    function.y.push_back(values[i + 1]);
  }
}

void check_rising(const interpreter::Keywords& keywords, const std::string& keyword,
                  const std::vector<double>& values) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[i - 1]) continue;
    throw interpreter::DiagnosticError("wrong-order",
                                       fmt::format("{}: {} does not lie beyond {}", keyword, values[i], values[i - 1]),
                                       keywords.span_of(keyword), "values must rise");
  }
}

void check_scales(const interpreter::Keywords& keywords, const solver::TabulatedFunction& function) {
  for (std::size_t i = 0; i < function.x.size(); ++i) {
    const bool wrong_x = function.x_scale == solver::Scale::logarithmic && !(function.x[i] > 0.0);
    const bool wrong_y = function.y_scale == solver::Scale::logarithmic && !(function.y[i] > 0.0);
    if (!wrong_x && !wrong_y) continue;
    throw interpreter::DiagnosticError(
        "out-of-bounds",
        fmt::format("the function is {:g} at {} = {:g}, and the scale of its {} is logarithmic", function.y[i],
                    function.parameter, function.x[i], wrong_x ? "abscissas" : "ordinates"),
        keywords.has("INTERPOL") ? keywords.span_of("INTERPOL") : keywords.span,
        wrong_x ? "leave the point out, or give INTERPOL=('LIN', ...)"
                : "leave the point out, or give INTERPOL=(..., 'LIN')");
  }
}

}  // namespace comma::commands
