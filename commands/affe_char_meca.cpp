#include "commands/commands.hpp"
#include "commands/load_building.hpp"

namespace comma::commands {

Product affe_char_meca(const Call& call, Context&) {
  const LoadedModel target(*call.data<ModelConcept>("MODELE").model);
  auto load = std::make_shared<solver::Load>();
  for (const Keywords& imposed : call.factors("DDL_IMPO")) add_imposed_displacements(imposed, "DDL_IMPO", target, *load);
  for (const Keywords& force : call.factors("FORCE_NODALE")) add_nodal_forces(force, target, *load);
  for (const Keywords& pressure : call.factors("PRES_REP")) add_pressures(pressure, target, *load);
  auto product = std::make_shared<LoadConcept>();
  product->load = std::move(load);
  return product;
}

Product affe_char_cine(const Call& call, Context&) {
  const LoadedModel target(*call.data<ModelConcept>("MODELE").model);
  auto load = std::make_shared<solver::Load>();
  for (const Keywords& imposed : call.factors("MECA_IMPO")) add_imposed_displacements(imposed, "MECA_IMPO", target, *load);
  auto product = std::make_shared<LoadConcept>();
  product->load = std::move(load);
  return product;
}

// The same with functions in place of numbers.
Product affe_char_meca_f(const Call& call, Context& context) { return affe_char_meca(call, context); }

Product affe_char_cine_f(const Call& call, Context& context) { return affe_char_cine(call, context); }

}  // namespace comma::commands
