// From points that face each other to the rows on which the law of contact is solved.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/contact/contact_points.hpp"
#include "solver/contact/row_entries.hpp"
#include "solver/contact_law/condensed_problem.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Jumps at the points are base + R u: the gap along the normal, then the slips since the step began along the tangents
/// (lengths). Multipliers live at the slave nodes of each zone, under local average contact on its patches.
class ContactRows {
 public:
  using Key = std::pair<int, int>;  ///< zone, node
  /// Normal, then the tangents along which friction acts.
  using Directions = std::array<Eigen::Vector3d, 3>;

  /// Keeps references to its arguments.
  ContactRows(const ContactDefinition& definition, const Model& model, const DofMap& dofs,
              const Elimination& elimination);

  /// Which multiplier belongs to a node of a zone.
  const std::map<Key, int>& multiplier_numbers() const { return multiplier_numbers_; }
  /// One a multiplier: whether its shear vanishes by itself.
  const std::vector<char>& smooth() const { return smooth_; }
  /// Of the space in which the surfaces move: 2 or 3.
  int dimension() const { return dimension_; }
  /// Calls visit(index of the pressure, index of the shear, coefficient of friction) for each shear among multipliers,
  /// `components` a number.
  template <typename Visit>
  void visit_shears(int components, const Visit& visit) const {
    for (const auto& [key, number] : multiplier_numbers_) {
      const Eigen::Index first = Eigen::Index{number} * components;
      const double friction = definition_.zones[static_cast<std::size_t>(key.first)].mixed.friction;
      for (int c = 1; c < components; ++c) visit(first, first + c, friction);
    }
  }
  /// Multipliers whose shears are shares of the limit of friction at the pressures of their nodes, 0 where that
  /// vanishes.
  Eigen::VectorXd with_shares(Eigen::VectorXd multipliers, int components) const;
  /// Whether nodes of SANS_GROUP_NO_FR have no multiplier of friction at all: DIRE_EXCL_FROT is not given, or the plane
  /// has no other direction along a surface.
  bool leaves_out_all_directions(const MixedZone& zone) const;

  /// Faces the points anew. `positions`: where the nodes are now; `margin`: see FacedFacets.
  void face(Positions positions, double time, double margin);
  const std::vector<ContactPoint>& points() const { return points_; }

  /// The points for the law, with rows, penalties as the user gives them; slips are counted from `reference`. Those
  /// that the conditions on displacements settle have no row that counts, and are `blocked` then. Throws Error
  /// `unknown-dof`, `degenerate-facet`.
  std::vector<CondensedPoint> build(const Eigen::VectorXd& reference);
  const std::vector<std::size_t>& blocked() const { return blocked_; }
  /// Counts slips from other displacements on.
  void count_slips(const std::vector<CondensedPoint>& points, const Eigen::VectorXd& reference);

  const RowMatrix& full() const { return full_; }         ///< R, over all degrees of freedom
  const RowMatrix& reduced() const { return reduced_; }   ///< A = R T
  Eigen::VectorXd jumps(const Eigen::VectorXd& u) const;  ///< none before points are faced
  Directions directions(const ContactPoint& point) const;

 private:
  void number_multipliers();
  void number_patches(int zone);
  CondensedPoint condensed(const ContactPoint& point) const;
  void let_slide(const ContactPoint& point, const Directions& along, CondensedPoint& condensed) const;
  double initial_gap(const ContactPoint& point) const;
  void add_row(int row, const ContactPoint& point, const Eigen::Vector3d& direction, RowEntries& entries) const;
  void settle_blocked(std::vector<CondensedPoint>& points);

  const ContactDefinition& definition_;
  const Model& model_;
  const Mesh& mesh_;
  const DofMap& dofs_;
  const Elimination& elimination_;

  std::map<Key, int> multiplier_numbers_;
  std::vector<char> smooth_;
  int dimension_ = 3;
  std::vector<ContactPoint> points_;
  std::vector<std::size_t> blocked_;
  RowMatrix full_;
  RowMatrix reduced_;
  Eigen::VectorXd base_;
};

/// Whether the overlap of a point says nothing of its penalty: next to no force belongs to it.
inline bool is_free_of_force(const ContactPoint& point, const CondensedPoint& condensed) {
  return point.bears_nothing && condensed.law.penalised;
}

}  // namespace comma::solver
