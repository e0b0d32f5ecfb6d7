#include "solver/nonlinear/contact/contact_compliance.hpp"

#include <set>
#include <utility>

namespace comma::solver {

ContactCompliance::ContactCompliance(FacedContact& contact, TangentSystem& tangent, std::vector<int> support)
    : contact_(contact), tangent_(tangent), support_(std::move(support)) {}

/// Points come in the same order at every pairing.
std::vector<int> ContactCompliance::row_keys() const {
  std::vector<int> keys(static_cast<std::size_t>(contact_.rows.full().rows()));
  for (std::size_t p = 0; p < contact_.problem.points.size(); ++p) {
    const CondensedPoint& point = contact_.problem.points[p];
    for (int c = 0; c < point.components && point.first_row >= 0; ++c)
      keys[static_cast<std::size_t>(point.first_row + c)] = 3 * static_cast<int>(p) + c;
  }
  return keys;
}

bool ContactCompliance::update() {
  const auto& springs = tangent_.springs();
  const RowMatrix& of_points = contact_.rows.reduced();
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < of_points.outerSize(); ++row)
    for (RowMatrix::InnerIterator it(of_points, row); it; ++it)
      entries.emplace_back(row, static_cast<int>(it.col()), it.value());
  int next = static_cast<int>(of_points.rows());
  std::vector<int> keys = row_keys();
  contact_.problem.springs.clear();
  for (const auto& [unknown, stiffness] : springs) {
    keys.push_back(-1 - unknown);
    entries.emplace_back(next, unknown, 1.0);
    contact_.problem.springs.push_back({next++, stiffness});
  }
  RowMatrix rows(next, contact_.elimination.reduced_size());
  rows.setFromTriplets(entries.begin(), entries.end());
  if (schur_ && spring_count_ == springs.size()) {
    schur_->replace_rows(std::move(rows), std::move(keys));
    return false;
  }
  std::set<int> support(support_.begin(), support_.end());
  for (const auto& spring : springs) support.insert(spring.first);
  schur_ = std::make_unique<SchurComplement>(
      std::move(rows), [this](Eigen::Ref<Eigen::MatrixXd> columns) { tangent_.solve_once(columns); },
      std::vector<int>(support.begin(), support.end()), std::move(keys));
  schur_->use_whole([this](const RowMatrix& all) { return tangent_.compliance(all); });
  spring_count_ = springs.size();
  return true;
}

void ContactCompliance::forget() {
  if (schur_) schur_->forget();
}

Eigen::VectorXd ContactCompliance::pushed_by(const Eigen::VectorXd& forces) {
  if (!schur_) {
    Eigen::MatrixXd push = contact_.rows.reduced().transpose() * forces;
    tangent_.solve_once(push);
    return contact_.rows.reduced() * push;
  }
  Eigen::VectorXd all = Eigen::VectorXd::Zero(schur_->size());
  all.head(forces.size()) = forces;
  return schur_->times(all).head(forces.size());
}

}  // namespace comma::solver
