#include "commands/commands.hpp"
#include "commands/load_building.hpp"

namespace comma::commands {

namespace {

Product load_concept(const Call& call, std::shared_ptr<const solver::Load> load) {
  auto product = std::make_shared<LoadConcept>();
  product->load = std::move(load);
  product->model = call.data<ModelConcept>("MODELE").model;
  return product;
}

}  // namespace

Product affe_char_meca(const Call& call, Context& context) {
  const LoadedModel target(*call.data<ModelConcept>("MODELE").model);
  auto load = std::make_shared<solver::Load>();
  if (call.text("DOUBLE_LAGRANGE") == "NON") load->multipliers_per_relation = 1;
  for (const Keywords& imposed : call.factors("DDL_IMPO")) add_imposed_displacements(imposed, "DDL_IMPO", target, *load);
  for (const Keywords& imposed : call.factors("FACE_IMPO")) add_face_displacements(imposed, target, *load, context.diagnostics);
  for (const Keywords& imposed : call.factors("ARETE_IMPO")) add_edge_displacements(imposed, target, *load);
  for (const Keywords& imposed : call.factors("CHAMNO_IMPO")) add_displacements_of_field(imposed, target, *load);
  for (const Keywords& imposed : call.factors("DDL_POUTRE")) add_beam_displacements(imposed, target, *load);
  for (const Keywords& imposed : call.factors("LIAISON_OBLIQUE")) add_oblique_displacements(imposed, target, *load);
  add_relations(call, target, *load);
  add_forces(call, target, *load);
  return load_concept(call, std::move(load));
}

Product affe_char_cine(const Call& call, Context& context) {
  const LoadedModel target(*call.data<ModelConcept>("MODELE").model);
  auto load = std::make_shared<solver::Load>();
  load->multipliers_per_relation = 0;
  for (const Keywords& imposed : call.factors("MECA_IMPO")) {
    add_imposed_displacements(imposed, "MECA_IMPO", target, *load, &context.diagnostics);
  }
  return load_concept(call, std::move(load));
}

// The same with functions in place of numbers.
Product affe_char_meca_f(const Call& call, Context& context) { return affe_char_meca(call, context); }

Product affe_char_cine_f(const Call& call, Context& context) { return affe_char_cine(call, context); }

}  // namespace comma::commands
