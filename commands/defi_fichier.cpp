#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

int unit_of(const Call& call) {
  if (call.has("UNITE")) return static_cast<int>(call.integer("UNITE"));
  throw DiagnosticError("unsupported", "DEFI_FICHIER: comma gives no unit number back", call.span, "write UNITE too");
}

}  // namespace

// comma opens a file when a command writes to it and closes it again, so LIBERER finds everything written. ASSOCIER
// empties the file: what is written next starts anew (U4.12.03).
Product defi_fichier(const Call& call, Context& context) {
  const int unit = unit_of(call);
  if (call.text("ACTION") == "LIBERER") {
    context.files.name_output(unit, "");
    context.released_units.insert(unit);
    return nullptr;
  }
  if (call.has("FICHIER")) context.files.name_output(unit, call.text("FICHIER"));
  if (call.text("ACTION") != "ASSOCIER" || call.text("TYPE") == "LIBRE" || call.text("ACCES") != "NEW") return nullptr;
  const auto path = context.files.output(unit, "resu", text_unit);
  context.written.erase(path.string());
  return nullptr;
}

}  // namespace comma::commands
