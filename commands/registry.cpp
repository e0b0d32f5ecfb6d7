#include "commands/registry.hpp"

#include <utility>

#include "solver/error.hpp"

namespace comma::commands {

namespace {

using Function = Product (*)(const Call&, Context&);

constexpr std::pair<const char*, Function> functions[] = {
    {"AFFE_CARA_ELEM", affe_cara_elem},
    {"AFFE_CHAR_CINE", affe_char_cine},
    {"AFFE_CHAR_MECA", affe_char_meca},
    {"AFFE_MATERIAU", affe_materiau},
    {"AFFE_MODELE", affe_modele},
    {"CALC_CHAMP", calc_champ},
    {"DEBUT", debut},
    {"DEFI_CONSTANTE", defi_constante},
    {"DEFI_CONTACT", defi_contact},
    {"DEFI_FONCTION", defi_fonction},
    {"DEFI_GROUP", defi_group},
    {"DEFI_LIST_REEL", defi_list_reel},
    {"DEFI_MATERIAU", defi_materiau},
    {"FIN", fin},
    {"IMPR_RESU", impr_resu},
    {"IMPR_TABLE", impr_table},
    {"LIRE_MAILLAGE", lire_maillage},
    {"MODI_MAILLAGE", modi_maillage},
    {"POST_RELEVE_T", post_releve_t},
    {"STAT_NON_LINE", stat_non_line},
    {"TEST_RESU", test_resu},
};

// An error of a command says where it was called, unless the command knew better.
Product run_located(Function function, const Call& call, Context& context) {
  try {
    return function(call, context);
  } catch (const solver::Error& error) {
    throw interpreter::DiagnosticError(error.code(), call.command + ": " + error.what(), call.span, error.hint());
  } catch (const interpreter::DiagnosticError& error) {
    if (error.diagnostic().span) throw;
    interpreter::Diagnostic located = error.diagnostic();
    located.message = call.command + ": " + located.message;
    located.span = call.span;
    throw interpreter::DiagnosticError(std::move(located));
  }
}

}  // namespace

interpreter::CommandTable make_command_table(Context& context) {
  interpreter::CommandTable table;
  for (const auto& [name, function] : functions) {
    table.emplace(name, [function = function, &context](const Call& call) { return run_located(function, call, context); });
  }
  return table;
}

}  // namespace comma::commands
