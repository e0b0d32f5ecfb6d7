// The commands, one function each, named as the command in lower case. Each lives in a file of its own; the registry
// ties the names to them. They get checked keywords and turn them into calls of the solver: no numerics, no syntax
// checks.
#pragma once

#include "commands/concepts.hpp"
#include "commands/context.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

using interpreter::Call;
using interpreter::Keywords;

Product affe_cara_elem(const Call& call, Context& context);
Product affe_char_cine(const Call& call, Context& context);
Product affe_char_meca(const Call& call, Context& context);
Product affe_char_cine_f(const Call& call, Context& context);
Product affe_char_meca_f(const Call& call, Context& context);
Product affe_materiau(const Call& call, Context& context);
Product affe_modele(const Call& call, Context& context);
Product asse_maillage(const Call& call, Context& context);
Product calc_champ(const Call& call, Context& context);
Product calc_fonc_interp(const Call& call, Context& context);
Product calc_fonction(const Call& call, Context& context);
Product calc_pression(const Call& call, Context& context);
Product calc_table(const Call& call, Context& context);
Product crea_champ(const Call& call, Context& context);
Product crea_resu(const Call& call, Context& context);
Product crea_maillage(const Call& call, Context& context);
Product crea_table(const Call& call, Context& context);
Product debut(const Call& call, Context& context);
Product defi_constante(const Call& call, Context& context);
Product defi_contact(const Call& call, Context& context);
Product defi_fichier(const Call& call, Context& context);
Product defi_fonction(const Call& call, Context& context);
Product defi_group(const Call& call, Context& context);
Product defi_list_enti(const Call& call, Context& context);
Product defi_list_inst(const Call& call, Context& context);
Product defi_list_reel(const Call& call, Context& context);
Product defi_materiau(const Call& call, Context& context);
Product defi_nappe(const Call& call, Context& context);
Product detruire(const Call& call, Context& context);
Product extr_resu(const Call& call, Context& context);
Product fin(const Call& call, Context& context);
Product formule(const Call& call, Context& context);
Product impr_fonction(const Call& call, Context& context);
Product impr_resu(const Call& call, Context& context);
Product impr_table(const Call& call, Context& context);
Product lire_fonction(const Call& call, Context& context);
Product lire_maillage(const Call& call, Context& context);
Product lire_table(const Call& call, Context& context);
Product macr_lign_coupe(const Call& call, Context& context);
Product meca_statique(const Call& call, Context& context);
/// Null: see make_preparation_table.
Product prepare_meca_statique(const Call& call, Context& context);
Product modi_maillage(const Call& call, Context& context);
Product modi_repere(const Call& call, Context& context);
Product post_champ(const Call& call, Context& context);
Product post_elem(const Call& call, Context& context);
Product post_releve_t(const Call& call, Context& context);
Product proj_champ(const Call& call, Context& context);
Product recu_fonction(const Call& call, Context& context);
Product recu_table(const Call& call, Context& context);
Product stat_non_line(const Call& call, Context& context);
/// Null: see make_preparation_table.
Product prepare_stat_non_line(const Call& call, Context& context);
Product test_fonction(const Call& call, Context& context);
Product test_resu(const Call& call, Context& context);
Product test_table(const Call& call, Context& context);

}  // namespace comma::commands
