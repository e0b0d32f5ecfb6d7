// Commands without a page in the catalogue: those of Code_Aster that comma does not have, and those that nobody has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace comma::interpreter {

/// Whether Code_Aster has, or once had, a command of this name, and the catalogue has no page of it (the index of the
/// manuals U4 and U7).
bool is_foreign_command(std::string_view name);

/// What is to be told of a command without a page.
struct MissingCommand {
  std::string code;  ///< `unsupported` for one of Code_Aster, else `unknown-command`
  std::string message;
  std::string hint;
};

/// `known`: the commands there are, of which a near one is proposed.
MissingCommand missing_command(std::string_view name, const std::vector<std::string>& known);

}  // namespace comma::interpreter
