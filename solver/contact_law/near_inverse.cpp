#include "solver/contact_law/near_inverse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Blocks that differ by less than this share are as good as those before.
constexpr double much = 0.5;

bool differs(const Matrix3d& now, const Matrix3d& before) { return (now - before).norm() > much * before.norm(); }

bool differs(const ForceBlock& now, const ForceBlock& before) {
  return differs(now.by_force, before.by_force) || differs(now.by_jump, before.by_jump);
}

bool have_same_rows(const std::vector<ForceBlock>& a, const std::vector<ForceBlock>& b) {
  return std::ranges::equal(a, b, [](const ForceBlock& one, const ForceBlock& other) {
    return one.row == other.row && one.size == other.size;
  });
}

}  // namespace

void NearInverse::update(const SchurComplement& schur, std::vector<ForceBlock> blocks) {
  const bool same_rows = version_ == schur.version() && have_same_rows(blocks, blocks_);
  std::vector<char> changed(blocks.size(), 1);
  for (std::size_t i = 0; i < blocks.size() && same_rows; ++i) {
    changed[i] = differs(blocks[i], blocks_[i]);
    if (!changed[i]) blocks[i] = blocks_[i];  // so that small changes add up
  }
  blocks_ = std::move(blocks);
  rows_.resize(blocks_.size());
  version_ = schur.version();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!same_rows) rows_[i].near = nearest(schur, static_cast<int>(i));
    if (std::ranges::any_of(rows_[i].near, [&](int near) { return changed[static_cast<std::size_t>(near)] != 0; }))
      rows_[i].values = inverse_rows(schur, static_cast<int>(i));
  }
}

/// The block itself among them.
std::vector<int> NearInverse::nearest(const SchurComplement& schur, int block) const {
  const SchurComplement::Column column = schur.column(blocks_[static_cast<std::size_t>(block)].row);
  std::vector<std::pair<double, int>> couplings(blocks_.size());
  for (int other = 0; other < static_cast<int>(blocks_.size()); ++other)
    couplings[static_cast<std::size_t>(other)] = {other == block
                                                      ? -std::numeric_limits<double>::infinity()
                                                      : -std::abs(column[blocks_[static_cast<std::size_t>(other)].row]),
                                                  other};
  const auto count = static_cast<std::ptrdiff_t>(std::min<std::size_t>(blocks_.size(), neighbours + 1));
  std::nth_element(couplings.begin(), couplings.begin() + count - 1, couplings.end());
  std::vector<int> result;
  for (auto each = couplings.begin(); each != couplings.begin() + count; ++each) result.push_back(each->second);
  std::ranges::sort(result);
  return result;
}

/// P M = 1 on the blocks near this one, whose rows alone are solved for.
MatrixXd NearInverse::inverse_rows(const SchurComplement& schur, int block) const {
  const std::vector<int>& near = rows_[static_cast<std::size_t>(block)].near;
  std::vector<Index> firsts;
  Index count = 0;
  for (const int each : near) {
    firsts.push_back(count);
    count += blocks_[static_cast<std::size_t>(each)].size;
  }
  MatrixXd piece(count, count);
  MatrixXd unit;
  for (std::size_t b = 0; b < near.size(); ++b) {
    const ForceBlock& from = blocks_[static_cast<std::size_t>(near[b])];
    for (int c = 0; c < from.size; ++c) {
      const SchurComplement::Column column = schur.column(from.row + c);
      for (std::size_t a = 0; a < near.size(); ++a) {
        const ForceBlock& at = blocks_[static_cast<std::size_t>(near[a])];
        auto entries = piece.col(firsts[b] + c).segment(firsts[a], at.size);
        entries.noalias() = at.by_jump.topLeftCorner(at.size, at.size) * column.segment(at.row, at.size);
        if (a == b) entries += at.by_force.col(c).head(at.size);
      }
    }
    if (near[b] == block) unit = MatrixXd::Identity(count, count).middleCols(firsts[b], from.size);
  }
  return piece.transpose().partialPivLu().solve(unit).transpose();
}

VectorXd NearInverse::operator()(const VectorXd& b) const {
  VectorXd x(b.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const Rows& rows = rows_[i];
    Index column = 0;
    for (const int near : rows.near) {
      const ForceBlock& from = blocks_[static_cast<std::size_t>(near)];
      sum.head(rows.values.rows()) += rows.values.middleCols(column, from.size) * b.segment(from.place, from.size);
      column += from.size;
    }
    x.segment(blocks_[i].place, blocks_[i].size) = sum.head(blocks_[i].size);
  }
  return x;
}

}  // namespace comma::solver
