// The law of contact as it has been solved, for those who read it alone.
#pragma once

#include <Eigen/Dense>

#include "solver/contact_law/contact_rows.hpp"

namespace comma::solver {

/// Imposed displacements may overlap by this share of the face's size.
inline constexpr double overlap_tolerance = 1e-9;

/// References to what MixedContact holds, at displacements u.
struct SolvedContact {
  const ContactDefinition& definition;
  const Mesh& mesh;
  const DofMap& dofs;
  const ContactRows& rows;
  const CondensedProblem& problem;
  const CondensedState& state;
  const Eigen::VectorXd& forces;  ///< on the rows
  const Eigen::VectorXd& u;
  Eigen::VectorXd jumps;  ///< of the rows at u (lengths)

  const std::vector<ContactPoint>& points() const { return rows.points(); }
  const ContactZone& zone_of(std::size_t point) const {
    return definition.zones[static_cast<std::size_t>(points()[point].zone)];
  }
  bool is_closed(std::size_t point) const { return state.statuses[point] != ContactStatus::open; }
  bool is_free_of_force(std::size_t point) const {
    return comma::solver::is_free_of_force(points()[point], problem.points[point]);
  }
};

}  // namespace comma::solver
