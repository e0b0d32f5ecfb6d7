#include "commands/alarms/known_names.hpp"
#include "solver/model/stress_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace comma::commands {

namespace {

// A field is called QUANTITY_LOCATION; these are the quantities of mechanical results (U4.81.04, section 3).
constexpr std::array<std::string_view, 56> quantities = {
    "SIEF", "SIGM", "SIPO", "SIPM", "SIRO", "SIZ1", "SIZ2", "SIEQ", "EFGE", "EFCA", "EGRU", "EPSI", "EPSG", "EPSL",
    "EPME", "EPMG", "EPMQ", "EPGQ", "EPEQ", "EPFD", "EPFP", "EPVC", "EPSP", "EPSA", "DEGE", "DERA", "ENEL", "ENTR",
    "ETOT", "EPOT", "ECIN", "DISS", "INDL", "VARI", "VAEX", "VARC", "ENDO", "CRIT", "PDIL", "PRAC", "PRME", "SING",
    "ERME", "ERZ1", "ERZ2", "QIRE", "QIZ1", "QIZ2", "FLUX", "META", "DURT", "STRX", "COHE", "INTE", "PRES", "TEMP"};
constexpr std::array<std::string_view, 4> locations = {"ELGA", "ELNO", "NOEU", "ELEM"};
constexpr std::array<std::string_view, 32> other_fields = {
    "DEPL",        "VITE",        "ACCE",      "TEMP",         "PRES",       "IRRA",      "SECH",       "HYDR_NOEU",
    "HYDR_ELNO",   "NEUT",        "GEOMETRIE", "COMPORTEMENT", "COMPORTHER", "COMPMETA",  "CONT_NOEU",  "CONT_ELEM",
    "INDC_ELEM",   "SECO_ELEM",   "FORC_NODA", "REAC_NODA",    "FORC_EXTE",  "FORC_AMOR", "FORC_LIAI",  "DEPL_ABSOLU",
    "VITE_ABSOLU", "ACCE_ABSOLU", "DEPL_VIBR", "SISE_ELNO",    "VALE_CONT",  "PRES_NOEU", "MODE_FLAMB", "MODE_STAB"};

bool is_users_own(std::string_view name) {
  return name.size() > 4 && name.starts_with("UT") && std::isdigit(static_cast<unsigned char>(name[2])) != 0;
}

/// The components of displacements and of nodal forces, those of contact's multipliers included.
std::vector<std::string> nodal_components(const solver::Model& model) {
  solver::ComponentMask mask = 0;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell)
    mask |= model.components_of(cell) | model.corner_components_of(cell);
  std::vector<std::string> names;
  for (int index = 0; index < solver::component_count; ++index) {
    const auto component = static_cast<solver::Component>(index);
    if (solver::contains(mask, component)) names.emplace_back(solver::name_of(component));
  }
  names.insert(names.end(), {"LAGS_C", "LAGS_F1", "LAGS_F2"});
  return names;
}

}  // namespace

bool is_field_name(std::string_view name) {
  if (is_users_own(name) || std::ranges::find(other_fields, name) != other_fields.end()) return true;
  const std::size_t bar = name.rfind('_');
  if (bar == std::string_view::npos) return false;
  return std::ranges::find(locations, name.substr(bar + 1)) != locations.end() &&
         std::ranges::find(quantities, name.substr(0, bar)) != quantities.end();
}

std::vector<std::string> field_names() {
  std::vector<std::string> names(other_fields.begin(), other_fields.end());
  for (const std::string_view quantity : quantities) {
    for (const std::string_view location : locations)
      names.push_back(std::string(quantity) + "_" + std::string(location));
  }
  // Fields of one's own (CHAM_UTIL) go up to UT20.
  for (int number = 1; number <= 20; ++number) {
    for (const std::string_view location : locations) names.push_back(fmt::format("UT{:02}_{}", number, location));
  }
  return names;
}

std::optional<std::vector<std::string>> components_of_field(std::string_view field, const solver::Model& model) {
  for (const std::string_view nodal : {"DEPL", "FORC_NODA", "REAC_NODA"}) {
    if (field == nodal) return nodal_components(model);
  }
  if (is_users_own(field)) return std::vector<std::string>{"X"};
  const std::string_view quantity = field.substr(0, 4);
  if (quantity == "SIEF" || quantity == "SIGM") {
    std::vector<std::string> names{"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ", "SIP", "N",   "VY", "VZ", "MT",
                                   "MFY",  "MFZ",  "NXX",  "NYY",  "NXY",  "MXX",  "MYY", "MXY", "QX", "QY"};
    names.insert(names.end(), solver::hourglass_stress_names.begin(), solver::hourglass_stress_names.end());
    return names;
  }
  static constexpr std::array<std::string_view, 5> strains = {"EPSI", "EPME", "EPSG", "EPMG", "EPSP"};
  if (std::ranges::find(strains, quantity) != strains.end())
    return std::vector<std::string>{"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};
  if (quantity == "VARI") return std::vector<std::string>{"V", "VARI"};
  return std::nullopt;
}

bool has_component(const std::vector<std::string>& components, std::string_view name) {
  if (std::ranges::find(components, name) != components.end()) return true;
  // "V" stands for V1, V2 ..., "X" for X1, X2 ...
  const bool numbered =
      name.size() > 1 && std::ranges::all_of(name.substr(1), [](unsigned char c) { return std::isdigit(c) != 0; });
  return numbered && std::ranges::find(components, name.substr(0, 1)) != components.end();
}

const std::vector<std::string>& result_parameters() {
  static const std::vector<std::string> names = {
      "INST",           "NUME_ORDRE", "ITER_GLOB", "CHAR_MINI", "ETA_PILOTAGE", "RESI_GLOB_RELA",
      "RESI_GLOB_MAXI", "RESI_GLOB",  "RESI_RELA", "RESI_MAXI", "RESI_REFE",    "RESI_COMP",
      "PARM_THETA",     "DELTAT",     "CHAR_CRIT", "FREQ",      "MODELE",       "CHAMPMAT",
      "CARAELEM",       "EXCIT",      "TRAV_EXT",  "ENER_CIN",  "ENER_TOT",     "TRAV_AMOR",
      "TRAV_LIAI",      "DISS_SCH",   "TYPE_DEFO", "TYPE_MODE", "NB_EVENT",     "NOEUD_CMP"};
  return names;
}

}  // namespace comma::commands
