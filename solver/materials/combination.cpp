#include "solver/materials/combination.hpp"

namespace comma::solver {

namespace {

template <class Law>
void take_missing(std::optional<Law>& law, const std::optional<Law>& from) {
  if (!law) law = from;
}

void take_missing(Plasticity& plasticity, const Plasticity& from) {
  take_missing(plasticity.linear, from.linear);
  take_missing(plasticity.asymmetric, from.asymmetric);
  take_missing(plasticity.traction, from.traction);
  take_missing(plasticity.power, from.power);
  take_missing(plasticity.nonlinear, from.nonlinear);
  take_missing(plasticity.hyperelasticity, from.hyperelasticity);
  take_missing(plasticity.prager, from.prager);
}

void take_missing_springs(Material& material, const Material& from) {
  take_missing(material.contact_spring, from.contact_spring);
  if (!material.knows_bilinear_springs) material.springs.bilinear = from.springs.bilinear;
  if (!material.knows_hardening_springs) material.springs.hardening = from.springs.hardening;
  material.knows_bilinear_springs |= from.knows_bilinear_springs;
  material.knows_hardening_springs |= from.knows_hardening_springs;
}

}  // namespace

Material combined(const Material& first, const Material& second) {
  Material both = first;
  const bool is_rubber = first.plasticity.hyperelasticity && !second.plasticity.hyperelasticity;
  if (is_rubber && second.elasticity) both.elasticity = second.elasticity;
  take_missing(both.elasticity, second.elasticity);
  take_missing(both.plasticity, second.plasticity);
  take_missing_springs(both, second);
  return both;
}

}  // namespace comma::solver
