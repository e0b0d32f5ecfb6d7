// Verdicts: a computed value against a reference, by Code_Aster's rules (U4.92.01).
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "interpreter/evaluation/host.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

using TestedValue = std::variant<double, std::int64_t, std::string>;

/// One tested reference, as the JSON report lists it.
struct Verdict {
  std::string file;
  int line = 0;
  std::string command;
  std::string label;           ///< "DEPL DY at A, INST=20"
  std::string kind;            ///< "VALE_CALC" or "VALE_REFE"
  std::string reference_type;  ///< "ANALYTIQUE", ...; "NON_REGRESSION" for VALE_CALC
  TestedValue reference;
  std::optional<TestedValue> computed;
  bool relative = true;
  double tolerance = 0.0;
  std::optional<double> order_of_magnitude;
  double error = 0.0;
  bool passed = false;
};

/// Judges a value against every reference that the keywords of a TEST_* occurrence give (VALE_CALC, VALE_CALC_I,
/// VALE_REFE, VALE_REFE_I ...; CRITERE, TOLE_MACHINE, PRECISION, ORDRE_GRANDEUR, VALE_ABS, which drops all signs).
std::vector<Verdict> judge(const interpreter::Keywords& test, const std::string& command, const std::string& label,
                           const TestedValue& computed);

/// The same of TEST_FONCTION, where VALE_ABS leaves references their signs and ORDRE_GRANDEUR counts for nothing
/// (17.3).
std::vector<Verdict> judge_function(const interpreter::Keywords& test, const std::string& label, double computed);

/// Judges a text against the one that the file expects: kind VALE_REFE.
Verdict judge_text(const interpreter::Keywords& test, const std::string& command, const std::string& label,
                   const std::string& expected, const std::string& computed);

/// The verdict of a claim that the file makes itself (CA.TestCase): kind VALE_REFE, reference type ASSERTION. Values
/// that are no numbers stand as the language writes them.
Verdict verdict_of(const interpreter::Assertion& assertion);

/// One line for the console: ok or FAILED, what, the computed value, the reference, the error against its tolerance.
std::string format_verdict(const Verdict& verdict);

}  // namespace comma::commands
