// comma explain: the reference manual, out of the catalogue.
#include <fmt/format.h>

#include "commands/catalogue.hpp"
#include "commands/cli/options.hpp"
#include "interpreter/catalogue/explain.hpp"

namespace comma::commands {

int explain(const std::string& path) try {
  const interpreter::Catalogue catalogue(catalogue_blobs());
  fmt::print("{}", path.empty() ? interpreter::explain_all(catalogue) : interpreter::explain(catalogue, path));
  return all_verdicts_hold;
} catch (const interpreter::DiagnosticError& error) {
  fmt::print(stderr, "{}\n", interpreter::render(error.diagnostic()));
  return the_file_is_wrong;
}

}  // namespace comma::commands
