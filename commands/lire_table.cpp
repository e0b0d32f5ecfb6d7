#include <fstream>

#include "commands/commands.hpp"
#include "commands/tables/text_table.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"

namespace comma::commands {

Product lire_table(const Call& call, Context& context) {
  const auto path = context.files.input(static_cast<int>(call.integer("UNITE")), {"table", "tab", "txt"});
  std::ifstream file(path);
  if (!file) throw interpreter::DiagnosticError("missing-file", "LIRE_TABLE: cannot read " + path.string(), call.span);
  context.console.progress("  reads " + path.string());
  const auto number = static_cast<int>(call.integer("NUME_TABLE"));
  const std::string& separator = call.text("SEPARATEUR");
  auto product = std::make_shared<TableConcept>();
  product->table = call.text("FORMAT") == "ASTER" ? read_aster_table(file, separator, number)
                                                  : read_plain_table(file, separator, number);
  if (call.has("TITRE")) product->table.title = call.texts("TITRE").front();
  return product;
}

}  // namespace comma::commands
