// Springs on points and segments.
#include <array>
#include <utility>

#include <fmt/format.h>

#include "solver/elements/discrete/discrete_elements.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

class DiscreteBlock final : public DiscreteElements {
 public:
  DiscreteBlock(const BlockInput& input, std::vector<int> cells) : DiscreteElements(input, std::move(cells)) {
    for (const int cell : cells_) {
      const DiscreteStiffness& stiffness = discrete_stiffness(input, cell);
      stiffnesses_.push_back(&stiffness);
      symmetric_ = symmetric_ && stiffness.matrix == stiffness.matrix.transpose();
    }
  }

  void add_stiffness(const Eigen::VectorXd&, const VariableState&, std::span<const int> column_starts,
                     double* values) const override {
    ElementMatrix symmetric;
    for (int element = 0; element < map_.element_count(); ++element) {
      const Eigen::MatrixXd& k = stiffnesses_[element]->matrix;
      symmetric = 0.5 * (k + k.transpose());
      map_.add(element, symmetric.data(), column_starts, values);
    }
  }

  bool is_symmetric() const override { return symmetric_; }

  void add_skew_stiffness(const Eigen::VectorXd&, const VariableState&,
                          std::vector<Eigen::Triplet<double>>& entries) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      map_.append_skew_half(element, stiffnesses_[element]->matrix, entries);
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState&, ForceSum forces) const override {
    std::array<int, max_size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const Eigen::MatrixXd& k = stiffnesses_[element]->matrix;
      for (int i = 0; i < k.rows(); ++i) {
        for (int j = 0; j < k.cols(); ++j) forces[dofs[i]] += static_cast<long double>(k(i, j)) * u[dofs[j]];
      }
    }
  }

  bool takes_initial_stresses() const override { return true; }
  /// Forces at the ends: see stresses().
  void add_forces_of_stresses(const Eigen::VectorXd&, const VariableState&, std::span<const double> stresses,
                              ForceSum forces) const override {
    const int k = map_.components();
    std::array<int, max_size> dofs;
    const double* own = stresses.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const Eigen::Matrix3d back = stiffnesses_[element]->axes.transpose();
      for (int end = 0; end < node_count_; ++end) {
        const double sign = end == node_count_ - 1 ? 1.0 : -1.0;
        std::array<double, component_count> force{};
        turn(own, back, force.data());
        for (int i = 0; i < k; ++i) {
          forces[dofs[end * k + i]] += sign * force[i];
        }
        own += k;
      }
    }
  }

  /// At each end the force of the part beyond upon the part before, in the element's own axes: N > 0 in tension. Ends
  /// differ where the matrix is full, such as that of a beam.
  void stresses(const Eigen::VectorXd& u, const VariableState&, std::span<double> out) const override {
    const int k = map_.components();
    std::array<int, max_size> dofs;
    double* target = out.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const DiscreteStiffness& stiffness = *stiffnesses_[element];
      for (int end = 0; end < node_count_; ++end) {
        const double sign = end == node_count_ - 1 ? 1.0 : -1.0;
        std::array<double, component_count> force{};
        for (int i = 0; i < k; ++i) {
          for (int j = 0; j < stiffness.matrix.cols(); ++j)
            force[i] += sign * stiffness.matrix(end * k + i, j) * u[dofs[j]];
        }
        turn(force.data(), stiffness.axes, target);
        target += k;
      }
    }
  }

  void energies(const Eigen::VectorXd& u, const VariableState&, std::span<double> out) const override {
    std::array<int, max_size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const Eigen::MatrixXd& k = stiffnesses_[element]->matrix;
      double sum = 0.0;
      for (int i = 0; i < k.rows(); ++i) {
        for (int j = 0; j < k.cols(); ++j) sum += u[dofs[i]] * k(i, j) * u[dofs[j]];
      }
      out[element] = 0.5 * sum;
    }
  }

  bool is_linear() const override { return true; }
  bool is_constant() const override { return true; }

 private:
  static constexpr int max_size = 2 * component_count;
  using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_size, max_size>;

  /// The components at a node in other axes, the rows of `axes`.
  void turn(const double* from, const Eigen::Matrix3d& axes, double* to) const {
    turn(from, axes, translations_, to);
    if (formulation_ == Formulation::spring_rotation_2d) to[2] = from[2];
    if (map_.components() == 6) turn(from + 3, axes, 3, to + 3);
  }
  static void turn(const double* from, const Eigen::Matrix3d& axes, int dimension, double* to) {
    for (int i = 0; i < dimension; ++i) {
      to[i] = 0.0;
      for (int j = 0; j < dimension; ++j) to[i] += axes(i, j) * from[j];
    }
  }

  std::vector<const DiscreteStiffness*> stiffnesses_;
  bool symmetric_ = true;
};

}  // namespace

std::unique_ptr<ElementBlock> make_discrete_block(const BlockInput& input, std::vector<int> cells) {
  return std::make_unique<DiscreteBlock>(input, std::move(cells));
}

}  // namespace comma::solver
