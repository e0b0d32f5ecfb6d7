#include "commands/commands.hpp"

namespace comma::commands {

namespace {

solver::IsotropicElasticity elasticity(const Keywords& law) {
  solver::IsotropicElasticity elasticity;
  elasticity.young = law.real("E");
  elasticity.poisson = law.real("NU");
  if (law.has("RHO")) elasticity.density = law.real("RHO");
  if (law.has("ALPHA")) elasticity.expansion = law.real("ALPHA");
  return elasticity;
}

}  // namespace

Product defi_materiau(const Call& call, Context&) {
  auto material = std::make_shared<solver::Material>();
  if (call.has("ELAS")) material->elasticity = elasticity(call.factor("ELAS"));
  auto product = std::make_shared<MaterialConcept>();
  product->material = std::move(material);
  return product;
}

}  // namespace comma::commands
