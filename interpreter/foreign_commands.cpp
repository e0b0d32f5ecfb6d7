#include "interpreter/foreign_commands.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "interpreter/diagnostic.hpp"

namespace comma::interpreter {

namespace {

/// Sorted.
constexpr std::array<std::string_view, 237> foreign = {
    "AFFE_CHAR_ACOU", "AFFE_CHAR_ACOU_F", "AFFE_CHAR_THER", "AFFE_CHAR_THER_F", "AIDE", "ASSEMBLAGE", "ASSE_ELEM_SSD", "ASSE_MATRICE",
    "ASSE_MATR_GENE", "ASSE_VECTEUR", "ASSE_VECT_GENE", "CALC_AMOR_MODAL", "CALC_BT", "CALC_CHAM_ELEM", "CALC_CHAR_CINE",
    "CALC_CHAR_SEISME", "CALC_CORR_SSD", "CALC_COUPURE", "CALC_ECREVISSE", "CALC_ELEM", "CALC_ERC_DYN", "CALC_ERREUR", "CALC_ESSAI",
    "CALC_ESSAI_GEOMECA", "CALC_EUROPLEXUS", "CALC_FATIGUE", "CALC_FERRAILLAGE", "CALC_FLUI_STRU", "CALC_FORC_AJOU", "CALC_FORC_NONL",
    "CALC_G", "CALC_GP", "CALC_G_XFEM", "CALC_H", "CALC_INTERF_SSD", "CALC_INTE_SPEC", "CALC_K_G", "CALC_MAC3COEUR", "CALC_MATE_HOMO",
    "CALC_MATR_AJOU", "CALC_MATR_ELEM", "CALC_META", "CALC_MISS", "CALC_MODAL", "CALC_MODES", "CALC_MODE_ROTATION", "CALC_NO",
    "CALC_POINT_MAT", "CALC_PRECONT", "CALC_SPEC", "CALC_SPECTRE_IPM", "CALC_STABILITE", "CALC_THERMECA_MULT", "CALC_TRANSFERT",
    "CALC_VECT_ELEM", "CHAINAGE_THM", "CO", "COMBINAISON_CHAR", "COMBINAISON_FERRAILLAGE", "COMB_FOURIER", "COMB_MATR_ASSE", "COMB_SISM_MODAL",
    "COPIER", "CREA_COUPE", "CREA_ELEM_SSD", "CREA_LIB_MFRONT", "DEBUG", "DEFI_BASE_MODALE", "DEFI_BASE_REDUITE", "DEFI_CABLE_BP",
    "DEFI_CABLE_OP", "DEFI_COMPOR", "DEFI_COMPOSITE", "DEFI_CONT", "DEFI_COQU_MULT", "DEFI_DOMAINE_REDUIT", "DEFI_FISS_XFEM",
    "DEFI_FLUI_STRU", "DEFI_FOND_FISS", "DEFI_GEOM_FIBRE", "DEFI_GLRC", "DEFI_GRILLE", "DEFI_INTERF_DYNA", "DEFI_INTE_SPEC",
    "DEFI_LIST_FREQ", "DEFI_MAILLAGE", "DEFI_MATER_GC", "DEFI_MODELE_GENE", "DEFI_OBSTACLE", "DEFI_PRES_EC8", "DEFI_SOL_EQUI",
    "DEFI_SOL_MISS", "DEFI_SPEC_TURB", "DEFI_SQUELETTE", "DEFI_TRC", "DEPL_INTERNE", "DYNA_ALEA_MODAL", "DYNA_ISS_VARI", "DYNA_LINE",
    "DYNA_LINE_HARM", "DYNA_LINE_TRAN", "DYNA_NON_LINE", "DYNA_SPEC_MODAL", "DYNA_TRAN_MODAL", "DYNA_VIBRA", "ELIM_LAGR", "ENGENDRE_TEST",
    "EXEC_LOGICIEL", "EXTR_CONCEPT", "EXTR_MODE", "EXTR_RESU", "EXTR_TABLE", "FACTORISER", "FACT_INTE_SPEC", "GENE_ACCE_SEISME",
    "GENE_FONC_ALEA", "GENE_MATR_ALEA", "GENE_VARI_ALEA", "IMPR_CLASSI", "IMPR_COURBE", "IMPR_DIAG_CAMPBELL", "IMPR_GENE", "IMPR_JEVEUX",
    "IMPR_MACR_ELEM", "IMPR_MISS_3D", "IMPR_OAR", "INCLUDE_MATERIAU", "INFO_EXEC_ASTER", "INFO_FONCTION", "INFO_MODE", "INTE_MAIL_2D",
    "INTE_MAIL_3D", "LIRE_CHAMP", "LIRE_FONCTION", "LIRE_FORC_MISS", "LIRE_IMPE_MISS", "LIRE_INTE_SPEC", "LIRE_MISS_3D", "LIRE_PLEXUS",
    "LIRE_RESU", "LIRE_TABLE", "MACRO_BASCULE_SCHEMA", "MACRO_ELAS_MULT", "MACRO_MATR_AJOU", "MACRO_MATR_ASSE", "MACRO_MISS_3D",
    "MACRO_MODE_MECA", "MACRO_PROJ_BASE", "MACR_ADAP_MAIL", "MACR_ASCOUF_CALC", "MACR_ASCOUF_MAIL", "MACR_ASPIC_CALC", "MACR_ASPIC_MAIL",
    "MACR_CARA_POUTRE", "MACR_ECLA_PG", "MACR_ECREVISSE", "MACR_ECRE_CALC", "MACR_ELEM_DYNA", "MACR_ELEM_STAT", "MACR_INFO_MAIL",
    "MACR_LIGN_COUPE", "MACR_RECAL", "MACR_SPECTRE", "MAC_MODES", "MECA_NON_LINE", "MODE_ITER_CYCL", "MODE_ITER_INV", "MODE_ITER_SIMULT",
    "MODE_NON_LINE", "MODE_STATIQUE", "MODI_BASE_MODALE", "MODI_MODELE", "MODI_MODELE_XFEM", "MODI_OBSTACLE", "MODI_REPERE", "NORM_MODE",
    "NUME_DDL", "NUME_DDL_GENE", "PERM_MAC3COEUR", "POST_BORDET", "POST_COQUE", "POST_CZM_FISS", "POST_DECOLLEMENT", "POST_DYNA_ALEA",
    "POST_DYNA_MODA_T", "POST_ENDO_FISS", "POST_FATIGUE", "POST_FATI_ALEA", "POST_GENE_PHYS", "POST_GP", "POST_JMOD", "POST_K1_K2_K3",
    "POST_K_BETA", "POST_K_TRANS", "POST_K_VARC", "POST_LIQUEFACTION", "POST_MAC3COEUR", "POST_MAIL_XFEM", "POST_NEWMARK", "POST_RCCM",
    "POST_ROCHE", "POST_USURE", "POST_ZAC", "PRE_GIBI", "PRE_GMSH", "PRE_IDEAS", "PRE_SEISME_NONL", "PROD_MATR_CHAM", "PROJ_BASE",
    "PROJ_CHAMP", "PROJ_MATR_BASE", "PROJ_MESU_MODAL", "PROJ_RESU_BASE", "PROJ_SPEC_BASE", "PROJ_VECT_BASE", "PROPA_FISS", "RAFF_GP",
    "RAFF_XFEM", "RECA_WEIBULL", "RECU_GENE", "RESOUDRE", "REST_COND_TRAN", "REST_GENE_PHYS", "REST_MODE_NONL", "REST_REDUIT_COMPLET",
    "REST_SOUS_STRUC", "REST_SPEC_PHYS", "REST_SPEC_TEMP", "SIMU_POINT_MAT", "STANLEY", "TEST_COMPOR", "TEST_FICHIER", "TEST_TEMPS",
    "THER_LINEAIRE", "THER_NON_LINE", "THER_NON_LINE_MO", "VERI_FERRAILLAGE"};
static_assert(std::ranges::is_sorted(foreign));

/// What does the same, or part of it, in comma.
const std::map<std::string_view, std::string_view>& substitutes() {
  static const std::map<std::string_view, std::string_view> table = {
      {"CALC_ELEM", "CALC_CHAMP computes these fields"},
      {"CALC_NO", "CALC_CHAMP computes these fields"},
      {"CALC_POINT_MAT", "a cube of one cell whose faces move shows the same law"},
      {"SIMU_POINT_MAT", "a cube of one cell whose faces move shows the same law"},
      {"MECA_NON_LINE", "STAT_NON_LINE solves such problems"},
      {"CO", "macro-commands of Code_Aster that comma has not make concepts by it"},
      {"DEFI_CONT", "DEFI_CONTACT defines contact"},
      {"LIRE_FONCTION", "DEFI_FONCTION takes the points themselves"},
      {"MACR_ADAP_MAIL", "finer meshes come from LIRE_MAILLAGE or CREA_MAILLAGE"},
      {"MACR_CARA_POUTRE", "AFFE_CARA_ELEM takes SECTION='CERCLE' and 'RECTANGLE', or the figures themselves by SECTION='GENERALE'"},
      {"MACR_LIGN_COUPE", "POST_RELEVE_T and CREA_TABLE take values at the nodes of a group, which DEFI_GROUP may find along a segment (OPTION='SEGM_DROI_ORDO')"},
      {"MODI_REPERE", "POST_RELEVE_T gives values in other axes (REPERE)"},
      {"POST_COQUE", "CALC_CHAMP with SIGM_ELNO and POST_CHAMP with EXTR_COQUE give the stresses of plates in their thickness"},
      {"IMPR_COURBE", "IMPR_FONCTION writes curves, and IMPR_TABLE tables"},
      {"INTE_MAIL_2D", "DEFI_GROUP finds the nodes of a line (OPTION='SEGM_DROI_ORDO'), and POST_RELEVE_T takes values there"},
      {"PRE_IDEAS", "LIRE_MAILLAGE reads the file itself (FORMAT='IDEAS')"},
      {"PRE_GMSH", "LIRE_MAILLAGE reads the file itself (FORMAT='GMSH')"},
  };
  return table;
}

}  // namespace

bool is_foreign_command(std::string_view name) { return std::ranges::binary_search(foreign, name); }

MissingCommand missing_command(std::string_view name, const std::vector<std::string>& known) {
  if (is_foreign_command(name)) {
    const auto substitute = substitutes().find(name);
    return {"unsupported", fmt::format("comma does not have Code_Aster's command {}", name),
            substitute == substitutes().end() ? "'comma explain' lists the commands that it has" : std::string(substitute->second)};
  }
  const std::string near = nearest(name, known);
  return {"unknown-command", fmt::format("there is no command {}", name), near.empty() ? "" : fmt::format("did you mean {}?", near)};
}

}  // namespace comma::interpreter
