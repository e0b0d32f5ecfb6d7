// What the tests of the conditions share: nodes that carry DX and DY (or six components), and relations between them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver::test {

struct Term {
  int node;
  Component component;
  double coefficient = 1.0;
};

/// Nodes at the given points, each with a spring to the ground.
inline Model nodes_with_springs(const std::vector<Point>& points, Formulation formulation = Formulation::spring_2d) {
  Model model;
  model.mesh = std::make_shared<Mesh>();
  model.mesh->dimension = formulation == Formulation::spring_2d ? 2 : 3;
  model.mesh->nodes = points;
  for (int node = 0; node < static_cast<int>(points.size()); ++node)
    model.mesh->add_cell(CellType::poi1, std::vector<int>{node});
  model.formulations.assign(points.size(), formulation);
  return model;
}

/// Nodes along the X axis, one unit apart.
inline Model nodes_in_a_row(int count, Formulation formulation = Formulation::spring_2d) {
  std::vector<Point> points;
  for (int node = 0; node < count; ++node) points.push_back({static_cast<double>(node), 0.0, 0.0});
  return nodes_with_springs(points, formulation);
}

inline LinearRelation relation(const std::vector<Term>& terms, double value, const std::string& origin = "test") {
  LinearRelation result;
  for (const Term& term : terms) result.terms.push_back({term.node, term.component, term.coefficient});
  result.value = value;
  result.origin = std::make_shared<const std::string>(origin);
  return result;
}

inline std::vector<AppliedLoad> applied(const std::vector<LinearRelation>& relations, TimeFunction multiplier = {}) {
  auto load = std::make_shared<Load>();
  load->relations = relations;
  return {AppliedLoad{load, std::move(multiplier)}};
}

}  // namespace comma::solver::test
