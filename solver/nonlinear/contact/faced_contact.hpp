// Points of contact that face the other surface, and how they stand: what all ways to iterate work on.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/contact/definition.hpp"
#include "solver/contact/extent.hpp"
#include "solver/contact_law/condensed_problem.hpp"
#include "solver/contact_law/contact_rows.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Imposed displacements may overlap by this share of the face's size.
inline constexpr double overlap_tolerance = 1e-9;

/// Points come in the same order at every pairing, as many points and statuses as points of the law.
struct FacedContact {
  const ContactDefinition& definition;
  const Mesh& mesh;
  const DofMap& dofs;
  const Elimination& elimination;
  ContactRows rows;
  CondensedProblem problem = {};  ///< its points are those of the rows
  CondensedState state = {};
  Eigen::VectorXd forces = {};     ///< on the rows
  Eigen::VectorXd reference = {};  ///< displacements when the step began, from which slips are counted

  const std::vector<ContactPoint>& points() const { return rows.points(); }
  const ContactZone& zone_of(std::size_t p) const {
    return definition.zones[static_cast<std::size_t>(points()[p].zone)];
  }
  const MixedZone& mixed_zone_of(std::size_t p) const { return zone_of(p).mixed; }
  bool is_closed(std::size_t p) const { return state.statuses[p] != ContactStatus::open; }
  /// One a point.
  std::vector<char> closed_points() const;
  int closed_count() const;
  /// Of its slave face (a length).
  double size_at(std::size_t p) const { return extent(mesh, points()[p].cell); }
  /// See contact_rows.hpp.
  bool is_free_of_force(std::size_t p) const { return comma::solver::is_free_of_force(points()[p], problem.points[p]); }
  /// Of the rows at u (lengths).
  Eigen::VectorXd jumps(const Eigen::VectorXd& u) const { return rows.jumps(u); }
};

/// At displacements u.
struct SolvedContact {
  const FacedContact& faced;
  const Eigen::VectorXd& u;
  Eigen::VectorXd jumps;  ///< of the rows at u (lengths)
};

}  // namespace comma::solver
