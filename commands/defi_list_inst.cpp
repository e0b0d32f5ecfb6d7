#include <fmt/format.h>

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

void check_rising(const std::vector<double>& values, const Keywords& list) {
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (values[k] > values[k - 1]) continue;
    throw DiagnosticError("wrong-order", fmt::format("DEFI_LIST_INST: {} does not lie beyond {}", values[k], values[k - 1]), list.span,
                          "instants must rise");
  }
}

std::optional<solver::StepCutting> cutting(const Call& call) {
  std::optional<solver::StepCutting> result;
  for (const Keywords& failure : call.factors("ECHEC")) {
    if (failure.text("ACTION") != "DECOUPE") continue;
    result = solver::StepCutting{static_cast<int>(failure.integer("SUBD_PAS")), static_cast<int>(failure.integer("SUBD_NIVEAU")),
                                 failure.real("SUBD_PAS_MINI")};
  }
  return result;
}

solver::WatchedIncrement watched_increment(const Call& call, const Keywords& given) {
  solver::WatchedIncrement watched;
  watched.field = given.text("NOM_CHAM");
  watched.component = given.text("NOM_CMP");
  watched.wanted = given.real("VALE_REF");
  const char* place = given.given("GROUP_NO") ? "GROUP_NO" : given.given("GROUP_MA") ? "GROUP_MA" : nullptr;
  if (place == nullptr) return watched;
  if (!call.given("MODELE")) throw DiagnosticError("missing-keyword", std::string("DEFI_LIST_INST: ") + place + " needs to know of which mesh", given.span_of(place), "give MODELE");
  const solver::Mesh& mesh = *call.data<ModelConcept>("MODELE").model->mesh;
  watched.nodes = selected_nodes(given, mesh);
  watched.cells = selected_cells(given, mesh);
  return watched;
}

// Of several ADAPTATION the last one counts; with EVENEMENT='AUCUN' steps keep the length of the first.
solver::StepAdaptation adaptation(const Call& call, const Keywords& list) {
  solver::StepAdaptation rule;
  if (list.has("PAS_MINI")) rule.shortest = list.real("PAS_MINI");
  if (list.has("PAS_MAXI")) rule.longest = list.real("PAS_MAXI");
  rule.most_steps = static_cast<long>(list.integer("NB_PAS_MAXI"));
  for (const Keywords& given : call.factors("ADAPTATION")) {
    const std::string event = given.text("EVENEMENT");
    rule.wanted_iterations.reset();
    rule.increment.reset();
    rule.growth = 0.0;
    if (event == "AUCUN") continue;
    if (event == "SEUIL") {
      rule.in_a_row = static_cast<int>(given.integer("NB_INCR_SEUIL"));
      rule.few_iterations = static_cast<int>(given.integer("VALE_I")) - (given.text("CRIT_COMP") == "LT" ? 1 : 0);
    } else {
      rule.in_a_row = 1;
      rule.few_iterations = std::numeric_limits<int>::max();
    }
    if (given.text("MODE_CALCUL_TPLUS") == "DELTA_GRANDEUR")
      rule.increment = watched_increment(call, given);
    else if (given.text("MODE_CALCUL_TPLUS") == "ITER_NEWTON")
      rule.wanted_iterations = static_cast<int>(given.integer("NB_ITER_NEWTON_REF"));
    else
      rule.growth = given.real("PCENT_AUGM") / 100.0;
  }
  return rule;
}

}  // namespace

Product defi_list_inst(const Call& call, Context&) {
  const Keywords& list = call.factor("DEFI_LIST");
  auto product = std::make_shared<StepPlanConcept>();
  product->plan.instants = instants(list);
  check_rising(product->plan.instants, list);
  product->plan.cutting = cutting(call);
  if (call.text("METHODE") == "AUTO") product->plan.adaptation = adaptation(call, list);
  return product;
}

}  // namespace comma::commands
