#include "commands/commands.hpp"

namespace comma::commands {

// comma opens a file when a command writes to it and closes it again, so LIBERER finds everything written, and what is
// written next goes on at its end. After ASSOCIER with ACCES='NEW' IMPR_RESU begins anew, tables and functions still go
// on: so does Code_Aster 17.3.
Product defi_fichier(const Call& call, Context& context) {
  const int unit = static_cast<int>(call.integer("UNITE"));
  if (call.text("ACTION") == "LIBERER") {
    context.files.name_output(unit, "");
    context.renewed_units.erase(unit);
    return nullptr;
  }
  if (call.text("ACTION") == "RESERVER") return nullptr;
  if (call.has("FICHIER")) context.files.name_output(unit, call.text("FICHIER"));
  if (call.text("ACTION") != "ASSOCIER" || call.text("TYPE") == "LIBRE" || call.text("ACCES") != "NEW") return nullptr;
  context.renewed_units.insert(unit);
  return nullptr;
}

}  // namespace comma::commands
