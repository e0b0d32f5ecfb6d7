// Errors of the mechanics. The solver knows no command file: it says what is wrong and what would mend it; the commands
// layer adds the place in the file.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace comma::solver {

/// `code` is a stable word with hyphens: "singular-matrix", "no-convergence", "contradictory-conditions",
/// "damaged-mesh", "unknown-group", "unsupported" ... `hint` says what would mend it, or is empty.
class Error : public std::runtime_error {
 public:
  Error(std::string code, const std::string& message, std::string hint = {})
      : std::runtime_error(message), code_(std::move(code)), hint_(std::move(hint)) {}

  const std::string& code() const { return code_; }
  const std::string& hint() const { return hint_; }

 private:
  std::string code_;
  std::string hint_;
};

}  // namespace comma::solver
