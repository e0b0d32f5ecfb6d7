#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/materials/behaviour/hyperelastic.hpp"
#include "solver/materials/mean_expansion.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using solver::MaterialPoint;
using solver::Parameter;
using solver::Property;

// What a property may depend on (U4.43.01), in the solver's words.
constexpr std::pair<const char*, Parameter> parameter_names[] = {{"TEMP", Parameter::temperature},
                                                                 {"SECH", Parameter::drying},
                                                                 {"HYDR", Parameter::hydration},
                                                                 {"NEUT1", Parameter::neutral_1},
                                                                 {"NEUT2", Parameter::neutral_2},
                                                                 {"NEUT3", Parameter::neutral_3},
                                                                 {"INST", Parameter::time},
                                                                 {"X", Parameter::x},
                                                                 {"Y", Parameter::y},
                                                                 {"Z", Parameter::z}};

Parameter parameter_named(const std::string& name, const Keywords& law, const std::string& keyword) {
  const auto found = std::ranges::find_if(parameter_names, [&](const auto& known) { return name == known.first; });
  if (found != std::end(parameter_names)) return found->second;
  throw DiagnosticError("unknown-parameter", keyword + " depends on " + name + ", which a material does not know",
                        law.span_of(keyword),
                        "here a function may depend on TEMP, SECH, HYDR, NEUT1, NEUT2, NEUT3, INST, X, Y, Z");
}

Property varying(const Keywords& law, const std::string& keyword) {
  const auto& handle = law.concept_of(keyword);
  interpreter::data_of<FunctionConcept>(handle, keyword);
  auto function = std::dynamic_pointer_cast<const FunctionConcept>(handle->data);
  std::vector<Parameter> order;
  for (const std::string& name : function->parameters()) order.push_back(parameter_named(name, law, keyword));
  if (const auto* table = function->table()) return solver::tabulated_property(*table, order.front());
  return Property([function, order, keyword](const MaterialPoint& at) {
    std::vector<double> arguments;
    for (const Parameter parameter : order) {
      if (std::isnan(at[parameter])) {
        throw solver::Error(
            "missing-variable",
            keyword + " depends on the " + std::string(solver::name_of(parameter)) + ", which is not given",
            "give it by AFFE_MATERIAU/AFFE_VARC");
      }
      arguments.push_back(at[parameter]);
    }
    return function->evaluate(arguments);
  });
}

/// A number, or a function; `otherwise` where the keyword is absent.
Property property(const Keywords& law, const std::string& keyword, double otherwise = 0.0) {
  if (!law.has(keyword)) return otherwise;
  return law.at(keyword).value.is_concept() ? varying(law, keyword) : Property(law.real(keyword));
}

// E and NU of bulk and shear modulus, which the speeds of waves may give.
void take_bulk_and_shear(const Keywords& law, solver::IsotropicElasticity& elasticity) {
  const double density = law.has("CELE_P") ? law.real("RHO") : 0.0;
  const double shear = law.has("K") ? law.real("MU") : density * std::pow(law.real("CELE_S"), 2);
  const double bulk = law.has("K") ? law.real("K") : density * std::pow(law.real("CELE_P"), 2) - 4.0 / 3.0 * shear;
  if (!(shear > 0.0 && bulk > 0.0))
    throw DiagnosticError("out-of-bounds", "DEFI_MATERIAU/ELAS: such waves have no elastic material",
                          law.span_of("CELE_P"),
                          "RHO is positive, and CELE_P larger than CELE_S times the square root of 4/3");
  elasticity.young = 9.0 * bulk * shear / (3.0 * bulk + shear);
  elasticity.poisson = (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear);
}

/// The expansion of ELAS_FO and its like is measured from a temperature, which must be known. Tables over the
/// temperature are converted at their points.
solver::Expansion varying_expansion(const Keywords& law, const std::string& keyword) {
  if (!law.has("TEMP_DEF_ALPHA")) {
    throw DiagnosticError("missing-keyword",
                          "DEFI_MATERIAU: " + keyword + ", which varies, needs TEMP_DEF_ALPHA beside it", law.span,
                          "TEMP_DEF_ALPHA is the temperature from which " + keyword + " was measured");
  }
  const double measured_from = law.real("TEMP_DEF_ALPHA");
  const auto& function = interpreter::data_of<FunctionConcept>(law.concept_of(keyword), keyword);
  const auto* table = function.table();
  if (table == nullptr || function.parameters().front() != "TEMP") return {property(law, keyword), measured_from};
  return solver::mean_expansion(*table, measured_from, law.real("PRECISION"));
}

/// A number, or a function; nothing where the keyword is absent.
solver::Expansion expansion(const Keywords& law, const std::string& keyword) {
  if (!law.has(keyword)) return {};
  return law.at(keyword).value.is_concept() ? varying_expansion(law, keyword) : solver::Expansion(law.real(keyword));
}

solver::IsotropicElasticity isotropic(const Keywords& law) {
  solver::IsotropicElasticity elasticity;
  elasticity.young = property(law, "E");
  elasticity.poisson = property(law, "NU");
  if (law.has("K") || law.has("CELE_P")) take_bulk_and_shear(law, elasticity);
  elasticity.density = property(law, "RHO");
  elasticity.expansion = expansion(law, "ALPHA");
  elasticity.drying_shrinkage = property(law, "K_DESSIC");
  elasticity.hydration_shrinkage = property(law, "B_ENDOGE");
  return elasticity;
}

solver::OrthotropicElasticity orthotropic(const Keywords& law) {
  solver::OrthotropicElasticity elasticity;
  elasticity.young = {property(law, "E_L"), property(law, "E_T"), property(law, "E_N")};
  elasticity.poisson = {property(law, "NU_LT"), property(law, "NU_LN"), property(law, "NU_TN")};
  elasticity.shear = {property(law, "G_LT"), property(law, "G_LN"), property(law, "G_TN")};
  elasticity.density = property(law, "RHO");
  elasticity.expansion = {expansion(law, "ALPHA_L"), expansion(law, "ALPHA_T"), expansion(law, "ALPHA_N")};
  return elasticity;
}

solver::OrthotropicElasticity transverse(const Keywords& law) {
  solver::TransverseElasticity elasticity;
  elasticity.young = property(law, "E_L");
  elasticity.young_normal = property(law, "E_N");
  elasticity.poisson = property(law, "NU_LT");
  elasticity.poisson_normal = property(law, "NU_LN");
  elasticity.shear_normal = property(law, "G_LN");
  elasticity.density = property(law, "RHO");
  elasticity.expansion = expansion(law, "ALPHA_L");
  elasticity.expansion_normal = expansion(law, "ALPHA_N");
  return solver::as_orthotropic(elasticity);
}

solver::LinearHardening linear_hardening(const Keywords& law) {
  return {property(law, "D_SIGM_EPSI"), property(law, "SY")};
}

// A curve, or one for each temperature of a surface.
solver::TractionHardening traction_hardening(const Keywords& law) {
  const auto& function = interpreter::data_of<FunctionConcept>(law.concept_of("SIGM"), "SIGM");
  solver::TractionHardening hardening;
  if (const auto* table = function.table()) {
    hardening.curves = {*table};
  } else if (const auto* surface = dynamic_cast<const SurfaceConcept*>(&function)) {
    if (surface->parameters().front() != "TEMP") {
      throw DiagnosticError("wrong-parameter",
                            "DEFI_MATERIAU/TRACTION: SIGM depends on " + surface->parameters().front() + " before EPSI",
                            law.span_of("SIGM"), "the first parameter of the surface is TEMP");
    }
    hardening.temperatures = surface->edges().x;
    hardening.left = surface->edges().left;
    hardening.right = surface->edges().right;
    for (const auto& row : surface->rows()) hardening.curves.push_back(*row);
  } else {
    throw DiagnosticError("wrong-function", "DEFI_MATERIAU/TRACTION: SIGM is not given by points", law.span_of("SIGM"),
                          "give the curve by DEFI_FONCTION, or one for each temperature by DEFI_NAPPE");
  }
  for (const auto& curve : hardening.curves) {
    if (curve.parameter == "EPSI" && curve.x.front() > 0.0) continue;
    throw DiagnosticError(
        "wrong-function",
        "DEFI_MATERIAU/TRACTION: SIGM must be the stress over the strain EPSI, from the yield point on",
        law.span_of("SIGM"), "its first point has a strain above zero");
  }
  return hardening;
}

// Young's modulus is taken from the curve: another one would be ignored.
void check_first_slope(const Call& call, const solver::TractionHardening& hardening) {
  constexpr double as_good_as_equal = 0.01;  // figures are written with few digits (Code_Aster 17.3 allows as much)
  if (!call.has("ELAS") || !call.factor("ELAS").has("E") || hardening.curves.size() != 1) return;
  const double young = call.factor("ELAS").real("E");
  const double slope = hardening.curves.front().y.front() / hardening.curves.front().x.front();
  if (std::abs(young - slope) <= as_good_as_equal * young) return;
  throw DiagnosticError(
      "wrong-function",
      fmt::format("DEFI_MATERIAU/TRACTION: the curve begins with the slope {:g}, which is not E of ELAS, {:g}", slope,
                  young),
      call.factor("TRACTION").span_of("SIGM"), "the first point of the curve is the end of elasticity: SIGM = E EPSI");
}

solver::PowerHardening power_hardening(const Keywords& law) {
  return {property(law, "SY"), property(law, "A_PUIS"), property(law, "N_PUIS")};
}

solver::NonlinearHardeningOf<Property> nonlinear_hardening(const Keywords& law) {
  const auto value = [&](const char* keyword, double otherwise = 0.0) { return property(law, keyword, otherwise); };
  return {value("R0"),      value("RH"), value("R1"), value("GAMMA_1"),      value("R2"),
          value("GAMMA_2"), value("RK"), value("P0"), value("GAMMA_M", 1.0), value("EPSP_LUDERS")};
}

// Without K, that of the Poisson ratio and the shear modulus 2 (C10 + C01), exactly: U4.43.01 has 2 for 4/3 (1 + NU),
// which is that near 0.5 (ssnv187a tells).
solver::Hyperelasticity hyperelasticity(const Keywords& law) {
  solver::Hyperelasticity rubber{law.real("C10"), law.real("C01"), law.real("C20"), 0.0};
  if (law.has("K")) {
    rubber.bulk = law.real("K");
  } else {
    const double poisson = law.real("NU");
    rubber.bulk = 4.0 * (1.0 + poisson) * (rubber.c10 + rubber.c01) / (3.0 * (1.0 - 2.0 * poisson));
  }
  return rubber;
}

// Rubber at rest, for what looks at the elasticity: weight, energies, contact.
solver::IsotropicElasticity small_strain_elasticity(const Keywords& law) {
  const solver::IsotropicModuli moduli = solver::small_strain_moduli(hyperelasticity(law));
  solver::IsotropicElasticity elasticity{moduli.young, moduli.poisson};
  elasticity.density = property(law, "RHO");
  return elasticity;
}

solver::HardeningRestoration restoration(const Keywords& law) {
  const solver::HardeningRestoration result{property(law, "COEF_ECRO"), property(law, "TAU_INF"), law.real("TEMP_MINI"),
                                            law.real("TEMP_MAXI")};
  if (result.to > result.from) return result;
  throw DiagnosticError("out-of-bounds", "DEFI_MATERIAU/REST_ECRO: TEMP_MAXI is not above TEMP_MINI",
                        law.span_of("TEMP_MAXI"), "hardening is restored at temperatures between the two");
}

void add_plasticity(const Call& call, solver::Plasticity& plasticity) {
  for (const char* keyword : {"ECRO_LINE", "ECRO_LINE_FO"})
    if (call.has(keyword)) plasticity.linear = linear_hardening(call.factor(keyword));
  if (call.has("ECRO_ASYM_LINE")) {
    const Keywords& law = call.factor("ECRO_ASYM_LINE");
    plasticity.asymmetric = solver::AsymmetricHardening{{property(law, "DT_SIGM_EPSI"), property(law, "SY_T")},
                                                        {property(law, "DC_SIGM_EPSI"), property(law, "SY_C")}};
  }
  if (call.has("TRACTION")) {
    plasticity.traction = traction_hardening(call.factor("TRACTION"));
    check_first_slope(call, *plasticity.traction);
  }
  for (const char* keyword : {"ECRO_PUIS", "ECRO_PUIS_FO"})
    if (call.has(keyword)) plasticity.power = power_hardening(call.factor(keyword));
  for (const char* keyword : {"ECRO_NL", "ECRO_NL_FO"})
    if (call.has(keyword)) plasticity.nonlinear = nonlinear_hardening(call.factor(keyword));
  if (call.has("ELAS_HYPER")) plasticity.hyperelasticity = hyperelasticity(call.factor("ELAS_HYPER"));
  for (const char* keyword : {"PRAGER", "PRAGER_FO"})
    if (call.has(keyword)) plasticity.prager = property(call.factor(keyword), "C");
  if (call.has("REST_ECRO")) plasticity.restoration = restoration(call.factor("REST_ECRO"));
}

solver::ContactSpring contact_spring(const Keywords& law) {
  return {law.real("RIGI_NOR"), law.real("RIGI_TAN"), law.real("COULOMB"),
          law.real("DIST_1"),   law.real("DIST_2"),   law.real("JEU")};
}

void add_bilinear_springs(const Keywords& law, solver::Material& material) {
  static constexpr std::array<const char*, 3> axes = {"DX", "DY", "DZ"};
  material.knows_bilinear_springs = true;
  material.springs.bilinear = {};
  for (std::size_t c = 0; c < axes.size(); ++c) {
    const std::string axis = axes[c];
    if (law.has("FPRE_" + axis))
      material.springs.bilinear[c] = solver::BilinearSpring{property(law, "KDEB_" + axis),
                                                            property(law, "KFIN_" + axis), law.real("FPRE_" + axis)};
  }
}

void add_hardening_springs(const Keywords& law, solver::Material& material) {
  static constexpr std::array<const char*, 6> axes = {"DX", "DY", "DZ", "RX", "RY", "RZ"};
  material.knows_hardening_springs = true;
  material.springs.hardening = {};
  for (std::size_t c = 0; c < axes.size(); ++c) {
    const std::string axis = axes[c];
    if (!law.has("LIMY_" + axis)) continue;
    solver::HardeningSpring spring{law.real("LIMY_" + axis), law.real("KCIN_" + axis), 0.0, 0.0};
    if (law.has("PUIS_" + axis)) {
      spring.power = law.real("PUIS_" + axis);
      spring.limit = law.real("LIMU_" + axis);
    }
    material.springs.hardening[c] = spring;
  }
}

std::vector<std::string> laws_given(const Call& call) {
  std::vector<std::string> names;
  for (const interpreter::Keyword& item : call.items)
    if (item.given && !item.factors.empty()) names.push_back(item.name);
  return names;
}

}  // namespace

Product defi_materiau(const Call& call, Context&) {
  const std::vector<std::string> laws = laws_given(call);
  if (laws.empty()) {
    throw DiagnosticError("missing-one-of", "DEFI_MATERIAU gives the material nothing", call.span,
                          "give it a law, such as ELAS=_F(E=..., NU=...)");
  }
  auto material = call.has("MATER") ? std::make_shared<solver::Material>(*call.data<MaterialConcept>("MATER").material)
                                    : std::make_shared<solver::Material>();
  for (const char* keyword : {"ELAS", "ELAS_FO"})
    if (call.has(keyword)) material->elasticity = isotropic(call.factor(keyword));
  for (const char* keyword : {"ELAS_ORTH", "ELAS_ORTH_FO"})
    if (call.has(keyword)) material->elasticity = orthotropic(call.factor(keyword));
  for (const char* keyword : {"ELAS_ISTR", "ELAS_ISTR_FO"})
    if (call.has(keyword)) material->elasticity = transverse(call.factor(keyword));
  if (call.has("ELAS_HYPER") && !material->elasticity)
    material->elasticity = small_strain_elasticity(call.factor("ELAS_HYPER"));
  add_plasticity(call, material->plasticity);
  if (call.has("DIS_CONTACT")) material->contact_spring = contact_spring(call.factor("DIS_CONTACT"));
  if (call.has("DIS_BILI_ELAS")) add_bilinear_springs(call.factor("DIS_BILI_ELAS"), *material);
  if (call.has("DIS_ECRO_CINE")) add_hardening_springs(call.factor("DIS_ECRO_CINE"), *material);
  auto product = std::make_shared<MaterialConcept>();
  product->material = std::move(material);
  if (call.has("MATER")) product->laws = call.data<MaterialConcept>("MATER").laws;
  for (const std::string& law : laws)
    if (std::ranges::find(product->laws, law) == product->laws.end()) product->laws.push_back(law);
  if (!call.reuse) return product;
  call.result->data = product;
  return nullptr;
}

}  // namespace comma::commands
