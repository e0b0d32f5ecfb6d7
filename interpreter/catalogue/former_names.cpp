#include "interpreter/catalogue/former_names.hpp"

#include <map>
#include <utility>

namespace comma::interpreter {
namespace {

using Key = std::pair<std::string_view, std::string_view>;

struct Former {
  std::string_view hint;
  std::string_view today = {};  ///< the keyword of the same level that stands for it, if there is one
};

constexpr Former in_behaviour{"it belongs to COMPORTEMENT now"},
    in_list{"DEFI_LIST_INST cuts steps now: give its list as LIST_INST"},
    in_contact{"DEFI_CONTACT says this now, and CONTACT= of STAT_NON_LINE takes it"},
    by_verdict{
        "VALE_CALC compares with what was computed before, and VALE_REFE besides with a reference from elsewhere "
        "(REFERENCE, PRECISION)",
        "VALE_CALC"},
    by_verdict_i{"VALE_CALC_I compares with what was computed before", "VALE_CALC_I"},
    by_verdict_c{"VALE_CALC_C compares with what was computed before", "VALE_CALC_C"},
    by_verdict_k{"VALE_CALC_K compares with what was computed before", "VALE_CALC_K"},
    leave_out{"leave it out: it is not needed any more"};

const std::map<Key, Former>& keywords() {
  static const std::map<Key, Former> table = {
      {{"AFFE_CHAR_MECA", "CONTACT"}, in_contact},
      {{"AFFE_CHAR_MECA_F", "CONTACT"}, in_contact},
      {{"AFFE_CHAR_MECA", "LIAISON_UNILATER"},
       {"DEFI_CONTACT(FORMULATION='LIAISON_UNIL') bounds displacements now, and CONTACT= of STAT_NON_LINE takes it"}},
      {{"AFFE_CHAR_MECA_F", "LIAISON_UNILATER"},
       {"DEFI_CONTACT(FORMULATION='LIAISON_UNIL') bounds displacements now, and CONTACT= of STAT_NON_LINE takes it"}},
      {{"AFFE_CHAR_MECA", "TEMP_CALCULEE"}, {"AFFE_VARC of AFFE_MATERIAU gives temperatures now"}},
      {{"AFFE_CHAR_MECA", "EPSA_CALCULEE"}, {"AFFE_VARC of AFFE_MATERIAU gives such strains now"}},
      {{"AFFE_CHAR_MECA/CHAMNO_IMPO", "COEF_MULT"}, {"COEF_IMPO gives the factor now", "COEF_IMPO"}},
      {{"AFFE_MODELE", "PARTITION"}, {"leave it out: comma does not divide models among processors"}},
      {{"MODI_MAILLAGE", "MODELE"}, leave_out},
      {{"IMPR_RESU/RESU", "VERI_DOM"}, leave_out},
      {{"CALC_CHAMP", "OPTION"},
       {"CONTRAINTE, DEFORMATION, ENERGIE, CRITERES, VARI_INTERNE, PROPRIETES and FORCE name the fields now"}},
      {{"POST_RELEVE_T/ACTION", "CHEMIN"},
       {"GROUP_NO names the nodes of the line now: DEFI_GROUP finds them (OPTION='SEGM_DROI_ORDO')"}},
      {{"DEFI_MATERIAU", "DIS_CHOC"}, {"DIS_CONTACT gives what RELATION='DIS_CHOC' takes"}},
      {{"TEST_RESU/RESU", "VALE"}, by_verdict},
      {{"TEST_RESU/CHAM_NO", "VALE"}, by_verdict},
      {{"TEST_RESU/CHAM_ELEM", "VALE"}, by_verdict},
      {{"TEST_TABLE", "VALE"}, by_verdict},
      {{"TEST_FONCTION/VALEUR", "VALE"}, by_verdict},
      {{"TEST_RESU/RESU", "VALE_R"}, by_verdict},
      {{"TEST_RESU/RESU", "VALE_I"}, by_verdict_i},
      {{"TEST_RESU/RESU", "VALE_C"}, by_verdict_c},
      {{"TEST_RESU/RESU", "VALE_K"}, by_verdict_k},
      {{"TEST_TABLE", "VALE_R"}, by_verdict},
      {{"TEST_TABLE", "VALE_I"}, by_verdict_i},
      {{"TEST_TABLE", "VALE_C"}, by_verdict_c},
      {{"TEST_TABLE", "VALE_K"}, by_verdict_k},
      {{"STAT_NON_LINE", "PARM_THETA"}, in_behaviour},
      {{"STAT_NON_LINE/CONVERGENCE", "RESI_INTE_RELA"}, in_behaviour},
      {{"STAT_NON_LINE/CONVERGENCE", "ITER_INTE_MAXI"}, in_behaviour},
      {{"STAT_NON_LINE/CONVERGENCE", "ITER_INTE_PAS"}, in_behaviour},
      {{"STAT_NON_LINE/CONVERGENCE", "RESO_INTE"}, in_behaviour},
      {{"STAT_NON_LINE/INCREMENT", "SUBD_PAS"}, in_list},
      {{"STAT_NON_LINE/INCREMENT", "SUBD_PAS_MINI"}, in_list},
      {{"STAT_NON_LINE/INCREMENT", "SUBD_METHODE"}, in_list},
      {{"STAT_NON_LINE/INCREMENT", "SUBD_NIVEAU"}, in_list},
      {{"STAT_NON_LINE/INCREMENT", "COEF_SUBD_PAS_1"}, in_list},
  };
  return table;
}

}  // namespace

std::string hint_on_former_keyword(std::string_view level, std::string_view keyword) {
  const auto found = keywords().find({level, keyword});
  return found == keywords().end() ? std::string() : std::string(found->second.hint);
}

std::string of_former_keyword(std::string_view level, std::string_view keyword) {
  const auto found = keywords().find({level, keyword});
  return found == keywords().end() ? std::string() : std::string(found->second.today);
}

std::string of_former_field(std::string_view name) {
  const auto last = name.rfind('_');
  if (last == std::string_view::npos) return {};
  const std::string_view end = name.substr(last + 1), rest = name.substr(0, last);
  const auto is_equivalent = rest.starts_with("EQUI_");
  if (is_equivalent && end == "SIGM") return "SIEQ" + std::string(rest.substr(4));
  if (is_equivalent && end == "EPSI") return "EPEQ" + std::string(rest.substr(4));
  const bool has_place = rest.find('_') != std::string_view::npos;
  return has_place && (end == "DEPL" || end == "ELGA" || end == "DYNA") ? std::string(rest) : std::string();
}

}  // namespace comma::interpreter
