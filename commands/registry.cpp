#include "commands/registry.hpp"

#include <span>
#include <utility>

#include "solver/error.hpp"

namespace comma::commands {

namespace {

using Function = Product (*)(const Call&, Context&);

constexpr std::pair<const char*, Function> functions[] = {
    {"AFFE_CARA_ELEM", affe_cara_elem},
    {"AFFE_CHAR_CINE", affe_char_cine},
    {"AFFE_CHAR_CINE_F", affe_char_cine_f},
    {"AFFE_CHAR_MECA", affe_char_meca},
    {"AFFE_CHAR_MECA_F", affe_char_meca_f},
    {"AFFE_MATERIAU", affe_materiau},
    {"AFFE_MODELE", affe_modele},
    {"ASSE_MAILLAGE", asse_maillage},
    {"CALC_CHAMP", calc_champ},
    {"CALC_FONC_INTERP", calc_fonc_interp},
    {"CALC_FONCTION", calc_fonction},
    {"CALC_PRESSION", calc_pression},
    {"CALC_TABLE", calc_table},
    {"CREA_CHAMP", crea_champ},
    {"CREA_RESU", crea_resu},
    {"CREA_MAILLAGE", crea_maillage},
    {"CREA_TABLE", crea_table},
    {"DEBUT", debut},
    {"DEFI_CONSTANTE", defi_constante},
    {"DEFI_CONTACT", defi_contact},
    {"DEFI_FICHIER", defi_fichier},
    {"DEFI_FONCTION", defi_fonction},
    {"DEFI_GROUP", defi_group},
    {"DEFI_LIST_ENTI", defi_list_enti},
    {"DEFI_LIST_INST", defi_list_inst},
    {"DEFI_LIST_REEL", defi_list_reel},
    {"DEFI_MATERIAU", defi_materiau},
    {"DEFI_NAPPE", defi_nappe},
    {"DETRUIRE", detruire},
    {"EXTR_RESU", extr_resu},
    {"FIN", fin},
    {"FORMULE", formule},
    {"IMPR_FONCTION", impr_fonction},
    {"IMPR_RESU", impr_resu},
    {"IMPR_TABLE", impr_table},
    {"LIRE_FONCTION", lire_fonction},
    {"LIRE_MAILLAGE", lire_maillage},
    {"LIRE_TABLE", lire_table},
    {"MACR_LIGN_COUPE", macr_lign_coupe},
    {"MECA_STATIQUE", meca_statique},
    {"MODI_MAILLAGE", modi_maillage},
    {"MODI_REPERE", modi_repere},
    {"POST_CHAMP", post_champ},
    {"POST_ELEM", post_elem},
    {"POST_RELEVE_T", post_releve_t},
    {"PROJ_CHAMP", proj_champ},
    {"RECU_FONCTION", recu_fonction},
    {"RECU_TABLE", recu_table},
    {"STAT_NON_LINE", stat_non_line},
    {"TEST_FONCTION", test_fonction},
    {"TEST_RESU", test_resu},
    {"TEST_TABLE", test_table},
};

constexpr std::pair<const char*, Function> preparations[] = {
    {"MECA_STATIQUE", prepare_meca_statique},
    {"STAT_NON_LINE", prepare_stat_non_line},
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

interpreter::CommandTable table_of(std::span<const std::pair<const char*, Function>> named, Context& context) {
  interpreter::CommandTable table;
  for (const auto& [name, function] : named) {
    table.emplace(name,
                  [function = function, &context](const Call& call) { return run_located(function, call, context); });
  }
  return table;
}

}  // namespace

interpreter::CommandTable make_command_table(Context& context) { return table_of(functions, context); }

interpreter::CommandTable make_preparation_table(Context& context) { return table_of(preparations, context); }

}  // namespace comma::commands
