#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands/alarms/load_alarms.hpp"
#include "commands/commands.hpp"
#include "commands/loads/load_building.hpp"
#include "solver/model/component.hpp"

namespace comma::commands {

namespace {

// Fields that hold forces and displacements may change after the command.
Product load_concept(const Call& call, std::shared_ptr<const solver::Load> load) {
  auto product = std::make_shared<LoadConcept>();
  product->model = call.data<ModelConcept>("MODELE").model;
  std::vector<interpreter::ConceptPtr> sources;
  for (const char* keyword : {"VECT_ASSE", "EVOL_CHAR", "EVOL_IMPO"})
    if (call.has(keyword)) sources.push_back(call.concept_of(keyword));
  if (sources.empty()) {
    product->load = {{}, [load = std::move(load)] { return load; }};
    return product;
  }
  // Of the call its keywords alone: the product would keep itself alive.
  product->load = {std::move(sources),
                   [load = std::move(load), keywords = static_cast<const Keywords&>(call), model = product->model] {
                     auto whole = std::make_shared<solver::Load>(*load);
                     add_forces_of_fields(keywords, LoadedModel(*model), *whole);
                     add_evolving_displacements(keywords, LoadedModel(*model), *whole);
                     return whole;
                   }};
  return product;
}

bool imposes_the_same(const solver::LinearRelation& one, const solver::LinearRelation& other) {
  return !one.function && !other.function &&
         one.value * other.terms.front().coefficient == other.value * one.terms.front().coefficient;
}

/// What equal values of several occurrences leave: relations that agree, or one, where values of loads add up.
enum class Repeated : std::uint8_t { kept, dropped };

/// Of those from `first` on. The rule of overloading: see Overriding.
void keep_last(const Call& call, const char* keyword, std::size_t first, const LoadedModel& target, solver::Load& load,
               Context& context, Repeated repeated = Repeated::kept) {
  std::map<std::pair<int, solver::Component>, std::size_t> last;
  std::vector<char> overridden(load.relations.size(), 0);
  Overriding found{keyword};
  for (std::size_t k = first; k < load.relations.size(); ++k) {
    const solver::LinearRelation& relation = load.relations[k];
    if (relation.terms.size() != 1) continue;
    const auto [known, is_first] = last.try_emplace({relation.terms.front().node, relation.terms.front().component}, k);
    if (is_first) continue;
    const std::size_t before = std::exchange(known->second, k);
    const bool same = imposes_the_same(load.relations[before], relation);
    if (!same || repeated == Repeated::dropped) overridden[before] = 1;
    if (same) continue;
    ++found.count;
    if (found.example.empty())
      found.example = fmt::format("{} at {}", solver::name_of(relation.terms.front().component),
                                  target.mesh.node_name(relation.terms.front().node));
  }
  warn_of(found, call.span,
          repeated == Repeated::dropped ? "leave one of them out; what two loads impose there adds up"
                                        : "where both are meant to hold, put them into two loads",
          context);
  std::size_t k = 0;
  std::erase_if(load.relations, [&](const solver::LinearRelation&) { return overridden[k++] != 0; });
}

}  // namespace

Product affe_char_meca(const Call& call, Context& context) {
  const LoadedModel target(*call.data<ModelConcept>("MODELE").model);
  auto load = std::make_shared<solver::Load>();
  if (call.text("DOUBLE_LAGRANGE") == "NON") load->multipliers_per_relation = 1;
  for (const Keywords& imposed : call.factors("DDL_IMPO"))
    add_imposed_displacements(imposed, "DDL_IMPO", target, *load);
  keep_last(call, "DDL_IMPO", 0, target, *load, context);
  const std::size_t of_faces = load->relations.size();
  for (const Keywords& imposed : call.factors("FACE_IMPO"))
    add_face_displacements(imposed, target, *load, context.diagnostics);
  keep_last(call, "FACE_IMPO", of_faces, target, *load, context);
  for (const Keywords& imposed : call.factors("ARETE_IMPO")) add_edge_displacements(imposed, target, *load);
  for (const Keywords& imposed : call.factors("CHAMNO_IMPO")) add_displacements_of_field(imposed, target, *load);
  for (const Keywords& imposed : call.factors("DDL_POUTRE")) add_beam_displacements(imposed, target, *load);
  for (const Keywords& imposed : call.factors("LIAISON_OBLIQUE")) add_oblique_displacements(imposed, target, *load);
  add_relations(call, target, *load);
  add_forces(call, target, *load);
  warn_of_loads(call, target, context);
  return load_concept(call, std::move(load));
}

Product affe_char_cine(const Call& call, Context& context) {
  const LoadedModel target(*call.data<ModelConcept>("MODELE").model);
  auto load = std::make_shared<solver::Load>();
  load->multipliers_per_relation = 0;
  for (const Keywords& imposed : call.factors("MECA_IMPO")) {
    add_imposed_displacements(imposed, "MECA_IMPO", target, *load, &context.diagnostics);
  }
  keep_last(call, "MECA_IMPO", 0, target, *load, context, Repeated::dropped);
  return load_concept(call, std::move(load));
}

// The same with functions in place of numbers.
Product affe_char_meca_f(const Call& call, Context& context) { return affe_char_meca(call, context); }

Product affe_char_cine_f(const Call& call, Context& context) { return affe_char_cine(call, context); }

}  // namespace comma::commands
