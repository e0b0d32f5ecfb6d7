// What the commands that make tabulated functions share: the words for interpolation and for what lies beyond the ends.
#pragma once

#include <string>

#include "interpreter/graph/call.hpp"
#include "solver/functions/function.hpp"

namespace comma::commands {

solver::Extension extension_named(const std::string& word);  ///< CONSTANT, LINEAIRE, EXCLU
solver::Scale scale_named(const std::string& word);          ///< LIN, LOG
const char* word_of(solver::Extension extension);
const char* word_of(solver::Scale scale);

/// Reads INTERPOL, PROL_GAUCHE and PROL_DROITE, where they are given or have defaults, into a function; with a suffix
/// INTERPOL_FONC ...
void read_shape(const interpreter::Keywords& keywords, solver::TabulatedFunction& function,
                const std::string& suffix = "");

/// VALE: x1, y1, x2, y2 ... Throws DiagnosticError `wrong-count` for an odd number of values.
void read_pairs(const interpreter::Keywords& keywords, solver::TabulatedFunction& function);

/// Throws DiagnosticError `wrong-order` at `keyword` when the abscissas do not rise.
void check_rising(const interpreter::Keywords& keywords, const std::string& keyword, const std::vector<double>& values);

/// Throws DiagnosticError `out-of-bounds` where a point is not positive along an axis whose scale is logarithmic.
void check_scales(const interpreter::Keywords& keywords, const solver::TabulatedFunction& function);

}  // namespace comma::commands
