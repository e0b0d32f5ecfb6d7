#include "commands/commands.hpp"
#include "commands/tables/text_table.hpp"

namespace comma::commands {

Product lire_table(const Call& call, Context& context) {
  std::ifstream file = open_input(call, context, {"table", "tab", "txt"});
  const auto number = static_cast<int>(call.integer("NUME_TABLE"));
  const std::string& separator = call.text("SEPARATEUR");
  auto product = std::make_shared<TableConcept>();
  product->table = call.text("FORMAT") == "ASTER" ? read_aster_table(file, separator, number)
                                                  : read_plain_table(file, separator, number);
  if (call.has("TITRE")) product->table.title = call.texts("TITRE").front();
  return product;
}

}  // namespace comma::commands
