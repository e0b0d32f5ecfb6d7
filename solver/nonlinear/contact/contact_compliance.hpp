// How forces on contact rows move the bodies there.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "solver/nonlinear/contact/faced_contact.hpp"
#include "solver/nonlinear/iterations/tangent_system.hpp"
#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// The Schur complement of the rows of the points, and after them of the springs that hold bodies which nothing but
/// contact does: these come off again on their rows.
class ContactCompliance {
 public:
  /// Keeps references to its first arguments. `support`: the reduced unknowns that contact can touch, rising.
  ContactCompliance(FacedContact& contact, TangentSystem& tangent, std::vector<int> support);

  /// Takes the rows and the springs at hand; numbers the springs of the problem. Whether all is to be computed anew.
  bool update();
  /// After a new factorisation.
  void forget();

  /// Whether it has ever been needed.
  bool is_known() const { return schur_ != nullptr; }
  /// Of a compliance that is known.
  SchurComplement& schur() { return *schur_; }
  const SchurComplement& schur() const { return *schur_; }

  /// How far forces on the rows of the points move the bodies there (lengths).
  Eigen::VectorXd pushed_by(const Eigen::VectorXd& forces);

 private:
  std::vector<int> row_keys() const;

  FacedContact& contact_;
  TangentSystem& tangent_;
  const std::vector<int> support_;
  std::unique_ptr<SchurComplement> schur_;
  std::size_t spring_count_ = 0;
};

}  // namespace comma::solver
