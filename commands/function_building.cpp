#include "commands/function_building.hpp"

#include <fmt/format.h>

#include "interpreter/diagnostic.hpp"

namespace comma::commands {

solver::Extension extension_named(const std::string& word) {
  if (word == "CONSTANT") return solver::Extension::constant;
  if (word == "LINEAIRE") return solver::Extension::linear;
  return solver::Extension::excluded;
}

solver::Scale scale_named(const std::string& word) { return word == "LOG" ? solver::Scale::logarithmic : solver::Scale::linear; }

void read_shape(const interpreter::Keywords& keywords, solver::TabulatedFunction& function) {
  if (keywords.has("INTERPOL")) {
    const auto scales = keywords.texts("INTERPOL");
    function.x_scale = scale_named(scales.front());
    function.y_scale = scale_named(scales.back());
  }
  if (keywords.has("PROL_GAUCHE")) function.left = extension_named(keywords.text("PROL_GAUCHE"));
  if (keywords.has("PROL_DROITE")) function.right = extension_named(keywords.text("PROL_DROITE"));
}

void check_rising(const interpreter::Keywords& keywords, const std::string& keyword, const std::vector<double>& values) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[i - 1]) continue;
    throw interpreter::DiagnosticError("wrong-order", fmt::format("{}: {} does not lie beyond {}", keyword, values[i], values[i - 1]),
                                       keywords.span_of(keyword), "values must rise");
  }
}

}  // namespace comma::commands
