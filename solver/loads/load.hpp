// Loads and kinematic conditions as data. The commands layer fills them; nonlinear/ assembles them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/functions/function.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Where a condition was written, for messages: "beam.comm:12, DDL_IMPO".
using Origin = std::shared_ptr<const std::string>;

/// sum of coefficient * u(node, component) = value (multiplied by the load's time function).
struct LinearRelation {
  struct Term {
    int node;
    Component component;
    double coefficient;
  };
  std::vector<Term> terms;
  double value = 0.0;
  FieldFunction function;  ///< when set, replaces `value`: evaluated at the first term's node
  Origin origin;
};

/// A force (or moment) on one component of a node.
struct NodalForce {
  int node;
  Component component;
  double value = 0.0;
  FieldFunction function;  ///< when set, replaces `value`
};

/// A pressure on a skin cell, positive against the outward normal; `shear` along the tangent of a plane edge.
struct PressureLoad {
  int cell;
  double pressure = 0.0;
  double shear = 0.0;
  FieldFunction pressure_function;  ///< when set, replaces `pressure`
  FieldFunction shear_function;
};

struct Load {
  std::vector<LinearRelation> relations;
  std::vector<NodalForce> nodal_forces;
  std::vector<PressureLoad> pressures;
};

/// A load as a computation applies it.
struct AppliedLoad {
  std::shared_ptr<const Load> load;
  TimeFunction multiplier;  ///< empty: 1
};

}  // namespace comma::solver
