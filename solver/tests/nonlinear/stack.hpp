// Two blocks in contact, and what the mixed formulation gives at their nodes.
#pragma once

#include "scene.hpp"

namespace comma::solver::testing {

inline double pressure(const Scene& scene, int node, int step = -1) {
  const ResultStep& chosen = step < 0 ? scene.result.steps.back() : scene.result.steps[static_cast<std::size_t>(step)];
  const auto& field = std::get<NodalField>(chosen.fields.at("DEPL"));
  return -field.at(node, field.component("LAGS_C"));
}

inline double shear_share(const Scene& scene, int node) {
  const auto& field = std::get<NodalField>(scene.result.steps.back().fields.at("DEPL"));
  return field.at(node, field.component("LAGS_F1"));
}

/// Two blocks one above the other, `above` and `below` cells along the contact.
struct Stack {
  Scene scene;
  Scene::Block lower, upper;

  Stack(int below, int above, double gap = 0.0)
      : lower(scene.block("l", {0, 0}, {3, 1}, below, 2, 2e5, 0.0)),
        upper(scene.block("u", {0, 1 + gap}, {3, 1}, above, 2, 2e5, 0.0)) {
    for (const int node : lower.nodes.front()) scene.impose({node}, Component::dy, 0);
    scene.impose({lower.nodes[0][0]}, Component::dx, 0);
    scene.zone(lower.top, upper.bottom);
    scene.problem.contact->formulation = ContactFormulation::mixed;
  }
};

}  // namespace comma::solver::testing
