#include "commands/fields/field_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_rows.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;

namespace {

using Names = std::vector<std::string>;

// The components of each quantity as far as comma's elements and materials know them; the catalogue of CREA_CHAMP
// admits no other quantity.
const std::map<std::string, Names, std::less<>>& components_by_quantity() {
  static const std::map<std::string, Names, std::less<>> table = {
      {"TEMP", {"TEMP", "TEMP_MIL", "TEMP_INF", "TEMP_SUP", "SECH"}},
      {"SECH", {"SECH", "TEMP"}},
      {"HYDR", {"HYDR"}},
      {"CORR", {"CORR"}},
      {"IRRA", {"IRRA"}},
      {"PRES", {"PRES", "CISA", "VX", "VY", "VZ"}},
      {"GEOM", {"X", "Y", "Z"}},
      {"DEPL", {"DX", "DY", "DZ", "DRX", "DRY", "DRZ", "LAGS_C", "LAGS_F1", "LAGS_F2", "PRES", "GONF"}},
      {"FORC", {"FX", "FY", "FZ", "MX", "MY", "MZ"}},
      {"SIEF", {"SIXX",  "SIYY", "SIZZ", "SIXY", "SIXZ",   "SIYZ",   "SIP",    "N",       "VY",      "VZ",
                "MT",    "MFY",  "MFZ",  "VMIS", "TRESCA", "PRIN_1", "PRIN_2", "PRIN_3",  "VMIS_SG", "TRSIG",
                "TRIAX", "SN",   "SVY",  "SVZ",  "SMT",    "SMFY",   "SMFZ",   "SIXXMIN", "SIXXMAX", "NXX",
                "NYY",   "NXY",  "MXX",  "MYY",  "MXY",    "QX",     "QY"}},
      {"EPSI", {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ", "INVA_2", "PRIN_1", "PRIN_2", "PRIN_3", "INVA_2SG",
                "GAXY", "GAXZ", "GAT",  "KY",   "KZ",   "EXX",  "EYY",    "EXY",    "KXX",    "KYY",    "KXY"}},
      {"ENER", {"TOTALE", "TRAC_COM", "TORSION", "FLEX_Y", "FLEX_Z", "MEMBRANE", "FLEXION", "CISAILLE"}},
      {"DERA",
       {"DCHA_V", "DCHA_T", "IND_DCHA", "VAL_DCHA", "X11", "X22", "X33", "X12", "X13", "X23", "RADI_V", "ERR_RADI"}},
      {"CACOQU", {"EP", "ALPHA", "BETA", "CTOR", "EXCENT", "KAPPA"}},
      {"NBSP", {"COQ_NCOU"}},
      {"CONT", {"CONT", "JEU", "PRES", "COEFSURF", "PRESCOOR"}},
      {"INFC", {"CONT", "JEU",  "RN",   "RNX",  "RNY",  "RNZ",  "GLIX", "GLIY",   "GLI",    "RTAX",
                "RTAY", "RTAZ", "RTGX", "RTGY", "RTGZ", "RX",   "RY",   "RZ",     "R",      "HN",
                "I",    "IX",   "IY",   "IZ",   "PT_X", "PT_Y", "PT_Z", "PROJ_X", "PROJ_Y", "PROJ_Z"}},
  };
  return table;
}

bool is_numbered(std::string_view name, std::string_view word) {
  return name.size() > word.size() && name.starts_with(word) &&
         std::ranges::all_of(name.substr(word.size()), [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

FieldType field_type(const std::string& word) {
  static const std::map<std::string, FieldPlace, std::less<>> places = {{"NOEU", FieldPlace::node},
                                                                        {"CART", FieldPlace::zone},
                                                                        {"ELEM", FieldPlace::cell},
                                                                        {"ELNO", FieldPlace::element_node},
                                                                        {"ELGA", FieldPlace::gauss_point}};
  // Quantities of one kind that have a name of their own in one place: VARI_NOEU and CONT_ELEM (U4.72.04).
  static const std::map<std::string, std::string, std::less<>> elsewhere = {{"VAR2", "VARI"}, {"CLAC", "CONT"}};
  std::string quantity = word.substr(5, word.size() - 7);
  if (const auto found = elsewhere.find(quantity); found != elsewhere.end()) quantity = found->second;
  return {places.at(word.substr(0, 4)), std::move(quantity), word.back() == 'F', word.back() == 'I'};
}

namespace {

Names components_known(const FieldType& type) {
  const auto found = components_by_quantity().find(type.quantity);
  return found == components_by_quantity().end() ? Names{type.quantity == "NEUT" ? "X1" : "V1"} : found->second;
}

}  // namespace

bool has_component(const FieldType& type, const std::string& name) {
  // Neutral values are X1, X2 ... and internal variables V1, V2 ...
  // What varies over hexahedra with one point of integration is FSTAB1, FSTAB2 ...
  if ((type.quantity == "NEUT" && is_numbered(name, "X")) || (type.quantity == "VARI" && is_numbered(name, "V")) ||
      (type.quantity == "SIEF" && is_numbered(name, "FSTAB")))
    return true;
  const Names known = components_known(type);
  return std::ranges::find(known, name) != known.end();
}

void check_component(const interpreter::Keywords& keywords, const std::string& keyword, const FieldType& type,
                     const std::string& name) {
  if (has_component(type, name)) return;
  throw DiagnosticError("unknown-component",
                        fmt::format("{}: a field of {} has no component {}", keyword, type.quantity, name),
                        keywords.span_of(keyword), interpreter::did_you_mean(name, components_known(type)));
}

solver::Support support_of(FieldPlace place) {
  if (place == FieldPlace::element_node) return solver::Support::element_node;
  return place == FieldPlace::gauss_point ? solver::Support::gauss_point : solver::Support::cell;
}

FieldPlace place_of(const solver::Field& field) {
  const auto* element = std::get_if<solver::ElementField>(&field);
  if (element == nullptr) return FieldPlace::node;
  switch (element->support) {
    case solver::Support::element_node:
      return FieldPlace::element_node;
    case solver::Support::gauss_point:
      return FieldPlace::gauss_point;
    case solver::Support::cell:
      break;
  }
  return FieldPlace::cell;
}

bool lies_at(const solver::Field& field, FieldPlace place) {
  const FieldPlace own = place_of(field);
  return own == place || (own == FieldPlace::cell && place == FieldPlace::zone);
}

std::string describe(FieldPlace place) {
  switch (place) {
    case FieldPlace::node:
      return "at nodes";
    case FieldPlace::zone:
    case FieldPlace::cell:
      return "by cell";
    case FieldPlace::element_node:
      return "at the nodes of cells";
    case FieldPlace::gauss_point:
      break;
  }
  return "at Gauss points";
}

bool lives_on_skin(const FieldType& type) {
  return type.quantity != "SIEF" && type.quantity != "EPSI" && type.quantity != "VARI";
}

const FieldConcept& number_field(const interpreter::ConceptPtr& handle, const interpreter::Keywords& keywords,
                                 const char* keyword) {
  const auto& data = interpreter::data_of<FieldConcept>(handle, keyword);
  if (data.functions.empty()) return data;
  throw DiagnosticError("wrong-type",
                        fmt::format("{}: {} is a field of functions; numbers are needed", keyword, handle->name),
                        keywords.span_of(keyword), "evaluate it by CREA_CHAMP, OPERATION='EVAL'");
}

void require_finite(const solver::Field& field, const solver::Mesh& mesh, const std::string& maker,
                    const interpreter::Span& span) {
  const auto found = solver::first_infinite(field);
  if (!found) return;
  const std::string& component = solver::components_of(field)[static_cast<std::size_t>(found->component)];
  const bool nodal = std::holds_alternative<solver::NodalField>(field);
  const std::string where = nodal ? "node " + mesh.node_name(found->place)
                                  : fmt::format("point {} of cell {}", found->point + 1, mesh.cell_name(found->place));
  throw DiagnosticError("not-finite", fmt::format("{}: {} is no finite number at {}", maker, component, where), span,
                        "look for values beyond 1.8e308 among what it is made of");
}

std::vector<solver::ValueFunction> value_functions(const FieldConcept& data) {
  std::vector<solver::ValueFunction> functions;
  for (const auto& function : data.functions) {
    functions.push_back(
        {function->parameters(), [function](std::span<const double> at) { return function->evaluate(at); }});
  }
  return functions;
}

}  // namespace comma::commands
