// The unit numbers that DEFI_FICHIER gives back while the command file is read.
#pragma once

#include <map>
#include <set>
#include <string>

#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// Of U4.12.03. Which file stands behind a number is said when the call runs (Files::name_output).
class UnitNumbers {
 public:
  /// `taken`: those of an .export, which are not given.
  explicit UnitNumbers(std::set<int> taken) : taken_(std::move(taken)) {}

  /// The number of the unit that a call of DEFI_FICHIER is about. A call without UNITE gets it: the highest one up to
  /// 99 that is free, or where it sets a file free the one that the file has. Nothing is returned for ACTION='LIBERER'.
  /// `misses_calls`: some could not be read or are wrong, so that a file may have a number that nobody knows. Throws
  /// DiagnosticError `unknown-unit` where that file has none, `no-unit` where all are taken.
  interpreter::Value number_of(interpreter::Call& call, bool misses_calls = false);

 private:
  int unit_of_name(const interpreter::Call& call, bool misses_calls) const;
  int free_unit(const interpreter::Call& call) const;

  std::set<int> taken_;
  std::map<int, std::string> names_;  ///< of the files behind units that are in use
};

}  // namespace comma::commands
