#include "commands/commands.hpp"

namespace comma::commands {

// comma opens a file when a command writes to it and closes it again, so LIBERER finds everything written. ASSOCIER
// empties the file: what is written next starts anew (U4.12.03).
Product defi_fichier(const Call& call, Context& context) {
  const int unit = static_cast<int>(call.integer("UNITE"));
  if (call.text("ACTION") == "LIBERER") {
    context.files.name_output(unit, "");
    context.released_units.insert(unit);
    return nullptr;
  }
  if (call.text("ACTION") == "RESERVER") return nullptr;
  if (call.has("FICHIER")) context.files.name_output(unit, call.text("FICHIER"));
  if (call.text("ACTION") != "ASSOCIER" || call.text("TYPE") == "LIBRE" || call.text("ACCES") != "NEW") return nullptr;
  const auto path = context.files.output(unit, "resu", text_unit);
  context.written.erase(path.string());
  return nullptr;
}

}  // namespace comma::commands
