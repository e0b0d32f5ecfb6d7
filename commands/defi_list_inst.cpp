#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "commands/bounds.hpp"
#include "commands/commands.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// The instants that a result went through, each step cut into equal parts.
std::vector<double> instants_of_result(const ResultConcept& source, std::int64_t parts) {
  std::vector<double> instants;
  for (const solver::ResultStep& step : source.result.steps) {
    const double last = instants.empty() ? step.instant : instants.back();
    for (std::int64_t k = 1; k < parts && !instants.empty(); ++k)
      instants.push_back(last + static_cast<double>(k) / static_cast<double>(parts) * (step.instant - last));
    instants.push_back(step.instant);
  }
  return instants;
}

std::vector<double> instants(const Keywords& list) {
  if (list.has("LIST_INST")) return list.data<ListConcept>("LIST_INST").values;
  if (list.has("RESULTAT")) return instants_of_result(list.data<ResultConcept>("RESULTAT"), list.integer("SUBD_PAS"));
  return list.reals("VALE");
}

void require_rising(const std::vector<double>& values, const Keywords& list) {
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (values[k] > values[k - 1]) continue;
    throw DiagnosticError("wrong-order",
                          fmt::format("DEFI_LIST_INST: {} does not lie beyond {}", values[k], values[k - 1]), list.span,
                          "instants must rise");
  }
}

// DECOUPE; ITER_SUPPL and AUTRE_PILOTAGE cut where more iterations, or the other solution, do not help.
std::optional<solver::StepCutting> cutting(const Keywords& failure) {
  if (failure.text("ACTION") == "ARRET") return std::nullopt;
  solver::StepCutting rule;
  rule.automatic = failure.text("SUBD_METHODE") == "AUTO";
  rule.shortest = failure.real("SUBD_PAS_MINI");
  if (rule.automatic) return rule;
  rule.parts = static_cast<int>(failure.integer("SUBD_PAS"));
  rule.depth = static_cast<int>(failure.integer("SUBD_NIVEAU"));
  return rule;
}

solver::WatchedIncrement watched_increment(const Call& call, const Keywords& given) {
  solver::WatchedIncrement watched;
  watched.field = given.text("NOM_CHAM");
  watched.component = given.text("NOM_CMP");
  watched.wanted = given.real("VALE_REF");
  static constexpr const char* places[] = {"GROUP_NO", "NOEUD", "GROUP_MA", "MAILLE"};
  const auto named = std::ranges::find_if(places, [&](const char* keyword) { return given.given(keyword); });
  if (named == std::end(places)) return watched;
  const char* place = *named;
  if ((place == places[0] || place == places[1]) && watched.field != "DEPL") {
    throw DiagnosticError("excluded-keyword", fmt::format("DEFI_LIST_INST: {} has its values on cells", watched.field),
                          given.span_of(place), "name cells by GROUP_MA or MAILLE");
  }
  if (!call.given("MODELE"))
    throw DiagnosticError("missing-keyword", std::string("DEFI_LIST_INST: ") + place + " needs to know of which mesh",
                          given.span_of(place), "give MODELE");
  const solver::Mesh& mesh = *call.data<ModelConcept>("MODELE").model->mesh;
  watched.nodes = selected_nodes(given, mesh);
  watched.cells = selected_cells(given, mesh);
  return watched;
}

// Without VALE_I it is half of ITER_GLOB_MAXI, which STAT_NON_LINE knows.
void read_threshold(const Keywords& given, solver::AdaptationRule& rule) {
  const std::string comparison = given.text("CRIT_COMP");
  rule.needed = static_cast<int>(given.integer("NB_INCR_SEUIL"));
  rule.strict = comparison == "LT" || comparison == "GE";
  rule.beyond = comparison == "GT" || comparison == "GE";
  if (given.has("VALE_I")) rule.few_iterations = static_cast<int>(given.integer("VALE_I"));
}

// The plastic strain that a step adds, as Code_Aster 17.3 has it.
void read_extrapolation(solver::AdaptationRule& rule) {
  solver::WatchedIncrement plastic_strain;
  plastic_strain.field = "VARI_ELGA";
  plastic_strain.component = "V1";
  plastic_strain.wanted = 1e-3;
  rule.increment = plastic_strain;
  rule.least_factor = 0.5;
  rule.most_factor = 1.2;
}

solver::AdaptationRule adaptation_rule(const Call& call, const Keywords& given) {
  solver::AdaptationRule rule;
  rule.always = given.text("EVENEMENT") == "TOUT_INST";
  if (!rule.always) read_threshold(given, rule);
  const std::string mode = given.text("MODE_CALCUL_TPLUS");
  if (mode == "DELTA_GRANDEUR")
    rule.increment = watched_increment(call, given);
  else if (mode == "IMPLEX")
    read_extrapolation(rule);
  else if (mode == "ITER_NEWTON")
    rule.wanted_iterations = static_cast<int>(given.integer("NB_ITER_NEWTON_REF"));
  else
    rule.growth = given.real("PCENT_AUGM") / 100.0;
  return rule;
}

// With EVENEMENT='AUCUN' steps keep the length that they have.
solver::StepAdaptation adaptation(const Call& call, const Keywords& list) {
  require_order(list, "PAS_MINI", "PAS_MAXI");
  solver::StepAdaptation steps;
  if (list.has("PAS_MINI")) steps.shortest = list.real("PAS_MINI");
  if (list.has("PAS_MAXI")) steps.longest = list.real("PAS_MAXI");
  steps.most_steps = static_cast<long>(list.integer("NB_PAS_MAXI"));
  steps.rules.clear();
  for (const Keywords& given : call.factors("ADAPTATION"))
    if (given.text("EVENEMENT") != "AUCUN") steps.rules.push_back(adaptation_rule(call, given));
  return steps;
}

constexpr std::pair<std::string_view, solver::StepEventKind> event_kinds[] = {
    {"DIVE_RESI", solver::StepEventKind::divergence},     {"RESI_MAXI", solver::StepEventKind::residual},
    {"DELTA_GRANDEUR", solver::StepEventKind::increment}, {"COLLISION", solver::StepEventKind::collision},
    {"INTERPENETRATION", solver::StepEventKind::depth},
};

// Steps around a collision have a length of their own where the user gives one.
void read_collision(const Keywords& given, solver::StepEvent& event) {
  if (given.text("ACTION") != "DECOUPE" || given.text("SUBD_METHODE") != "AUTO") {
    event.cutting = cutting(given);
    return;
  }
  event.around = solver::CollisionSteps{given.real("SUBD_INST"), given.real("SUBD_DUREE")};
}

void read_depth(const Keywords& given, solver::StepEvent& event) {
  event.limit = given.real("PENE_MAXI");
  if (given.text("ACTION") == "ADAPT_COEF_PENA") event.most_stiffening = given.real("COEF_MAXI");
}

solver::StepEvent event_of(const Call& call, const Keywords& given, solver::StepEventKind kind) {
  solver::StepEvent event;
  event.kind = kind;
  if (kind == solver::StepEventKind::collision) {
    read_collision(given, event);
    return event;
  }
  if (kind == solver::StepEventKind::depth) {
    read_depth(given, event);
    return event;
  }
  if (kind == solver::StepEventKind::residual) event.limit = given.real("RESI_GLOB_MAXI");
  if (kind == solver::StepEventKind::increment) event.increment = watched_increment(call, given);
  event.cutting = cutting(given);
  return event;
}

// The last one counts (U4.34.03).
void warn_of_repeated_events(const Call& call, Context& context) {
  std::map<std::string, int> occurrences;
  for (const Keywords& given : call.factors("ECHEC")) ++occurrences[given.text("EVENEMENT")];
  for (const Keywords& given : call.factors("ECHEC")) {
    int& left = occurrences[given.text("EVENEMENT")];
    if (--left == 0) continue;
    context.diagnostics.alarm("repeated-event",
                              fmt::format("DEFI_LIST_INST: what this occurrence says of EVENEMENT='{}' counts for "
                                          "nothing: a later one takes its place",
                                          given.text("EVENEMENT")),
                              given.span, "write one occurrence for each event");
  }
}

// The largest SUBD_NIVEAU bounds how often steps are cut, whichever event does it (Code_Aster 17.3).
void share_depth(solver::StepPlan& plan) {
  std::vector<solver::StepCutting*> rules;
  if (plan.cutting) rules.push_back(&*plan.cutting);
  for (solver::StepEvent& event : plan.events)
    if (event.cutting) rules.push_back(&*event.cutting);
  std::erase_if(rules, [](const solver::StepCutting* rule) { return rule->automatic; });
  int deepest = 0;
  for (const solver::StepCutting* rule : rules) deepest = std::max(deepest, rule->depth);
  for (solver::StepCutting* rule : rules) rule->depth = deepest;
}

// Of several occurrences for an event the last one counts; without one for ERREUR steps that fail are cut all the same
// (U4.34.03).
void read_failures(const Call& call, solver::StepPlan& plan) {
  plan.cutting = solver::StepCutting{};
  for (const Keywords& given : call.factors("ECHEC")) {
    if (given.text("EVENEMENT") == "INSTABILITE") {
      plan.stops_when_unstable = given.text("ACTION") == "ARRET";
      continue;
    }
    const auto kind = std::ranges::find(event_kinds, given.text("EVENEMENT"),
                                        &std::pair<std::string_view, solver::StepEventKind>::first);
    if (kind != std::end(event_kinds)) {
      std::erase_if(plan.events, [&](const solver::StepEvent& known) { return known.kind == kind->second; });
      plan.events.push_back(event_of(call, given, kind->second));
      continue;
    }
    plan.cutting = cutting(given);
    plan.tries_other_solution = given.text("ACTION") == "AUTRE_PILOTAGE";
    plan.further_iterations =
        given.text("ACTION") == "ITER_SUPPL" ? static_cast<double>(given.integer("PCENT_ITER_PLUS")) / 100.0 : 0.0;
  }
  share_depth(plan);
}

}  // namespace

Product defi_list_inst(const Call& call, Context& context) {
  const Keywords& list = call.factor("DEFI_LIST");
  auto product = std::make_shared<StepPlanConcept>();
  product->plan.instants = instants(list);
  require_rising(product->plan.instants, list);
  warn_of_repeated_events(call, context);
  read_failures(call, product->plan);
  if (call.text("METHODE") == "AUTO") product->plan.adaptation = adaptation(call, list);
  return product;
}

}  // namespace comma::commands
