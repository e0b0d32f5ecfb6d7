#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/discrete_elements.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr int variables_of_contact = 4;
constexpr int largest_size = 2 * component_count;
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, largest_size, 1>;
using ElementMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, largest_size, largest_size>;

class DiscreteContact final : public DiscreteElements {
 public:
  DiscreteContact(const BlockInput& input, std::vector<int> cells)
      : DiscreteElements(input, std::move(cells)), slips_(cells_.size(), Eigen::Vector2d::Zero()) {
    for (const int cell : cells_) members_.push_back(member(input, cell));
  }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState&, std::span<const int> column_starts,
                     double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const ElementMatrix k = tangent(element, answer(element, u).tangent);
      const ElementMatrix symmetric = 0.5 * (k + k.transpose());
      map_.add(element, symmetric.data(), column_starts, values);
    }
  }

  /// As if it stuck where it is closed.
  void add_elastic_stiffness(const Eigen::VectorXd& u, const VariableState&, std::span<const int> column_starts,
                             double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const ContactSpring& spring = *at(element).spring;
      Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
      if (answer(element, u).status != ContactSpringStatus::open)
        stiffness.diagonal() << spring.normal, spring.tangential, spring.tangential;
      const ElementMatrix k = tangent(element, stiffness);
      map_.add(element, k.data(), column_starts, values);
    }
  }

  /// What the pressure does to friction is left to iterations.
  void add_symmetric_stiffness(const Eigen::VectorXd& u, const VariableState&, std::span<const int> column_starts,
                               double* values) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      Eigen::Matrix3d stiffness = answer(element, u).tangent;
      stiffness.bottomLeftCorner<2, 1>().setZero();
      const ElementMatrix k = tangent(element, stiffness);
      map_.add(element, k.data(), column_starts, values);
    }
  }

  bool is_symmetric() const override {
    return std::ranges::none_of(
        members_, [](const Member& each) { return each.spring->friction > 0.0 && each.spring->tangential > 0.0; });
  }
  void add_skew_stiffness(const Eigen::VectorXd& u, const VariableState&,
                          std::vector<Eigen::Triplet<double>>& entries) const override {
    if (is_symmetric()) return;
    std::array<int, largest_size> dofs;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const ElementMatrix k = tangent(element, answer(element, u).tangent);
      for (int i = 0; i < k.rows(); ++i) {
        for (int j = 0; j < k.cols(); ++j) {
          const double skew = 0.5 * (k(i, j) - k(j, i));
          const int row = dofs[static_cast<std::size_t>(i)], column = dofs[static_cast<std::size_t>(j)];
          if (row > column && skew != 0.0) entries.emplace_back(row, column, skew);
        }
      }
    }
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState&, ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element)
      add(element, end_forces(element, answer(element, u).force.head(translations_), rotation_forces(element, u)),
          forces);
  }

  void add_forces_of_stresses(const Eigen::VectorXd&, const VariableState&, std::span<const double> reported,
                              ForceSum forces) const override {
    const int k = map_.components();
    for (int element = 0; element < map_.element_count(); ++element) {
      const Eigen::Map<const ElementVector> own(reported.data() + element * k, k);
      ElementVector rotations = ElementVector::Zero(node_count_ * k);
      rotations.segment((node_count_ - 1) * k + translations_, k - translations_) =
          rotation_axes(element).transpose() * own.tail(k - translations_);
      if (node_count_ == 2) rotations.segment(translations_, k - translations_) = -rotations.tail(k - translations_);
      add(element, end_forces(element, own.head(translations_), rotations), forces);
    }
  }

  /// At the last node, in the element's own axes: N < 0 where the element is closed.
  void stresses(const Eigen::VectorXd& u, const VariableState&, std::span<double> out) const override {
    const int k = map_.components();
    for (int element = 0; element < map_.element_count(); ++element) {
      Eigen::Map<ElementVector> own(out.data() + element * k, k);
      own.head(translations_) = answer(element, u).force.head(translations_);
      own.tail(k - translations_) = rotation_axes(element) * rotation_forces(element, u).tail(k - translations_);
    }
  }

  bool is_linear() const override { return false; }
  bool is_constant() const override { return true; }
  bool has_memory() const override { return true; }

  int variable_count() const override { return variables_of_contact; }
  void variables(const Eigen::VectorXd& u, const VariableState&, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const ContactSpringResponse reached = answer(element, u);
      const auto own = out.subspan(static_cast<std::size_t>(element * variables_of_contact));
      own[0] = reached.slip[0];
      own[1] = reached.slip[1];
      own[2] = static_cast<double>(reached.status);
      own[3] = gap(element, u);
    }
  }

  void energies(const Eigen::VectorXd&, const VariableState&, std::span<double>) const override {
    throw_no_energies("discrete elements with contact", mesh_.cell_name(cells_.front()));
  }
  void energy_densities(const Eigen::VectorXd&, const VariableState&, std::span<const double>, std::span<const double>,
                        std::span<double> out) const override {
    std::ranges::fill(out, absent);
  }

  void accept(const Eigen::VectorXd& u, const VariableState&) override {
    for (int element = 0; element < map_.element_count(); ++element)
      slips_[static_cast<std::size_t>(element)] = answer(element, u).slip;
  }

  /// Without variables the force tells how far it had slipped.
  void resume(const Eigen::VectorXd& u, const VariableState&, std::span<const double> reported,
              std::span<const double> variables) override {
    for (int element = 0; element < map_.element_count(); ++element) {
      Eigen::Vector2d& slip = slips_[static_cast<std::size_t>(element)];
      if (!variables.empty()) {
        slip = Eigen::Map<const Eigen::Vector2d>(variables.data() + element * variables_of_contact);
        continue;
      }
      slip = displacement(element, u).tail<2>();
      const double stiffness = at(element).spring->tangential;
      if (reported.empty() || stiffness == 0.0) continue;
      for (int c = 1; c < translations_; ++c)
        slip[c - 1] -= reported[static_cast<std::size_t>(element * map_.components() + c)] / stiffness;
    }
  }

 private:
  struct Member {
    const ContactSpring* spring;
    Eigen::Matrix3d axes;
    double first_gap;         ///< undisplaced
    ElementMatrix rotations;  ///< the element's stiffness without its translations
  };

  const Member& at(int element) const { return members_[static_cast<std::size_t>(element)]; }

  Member member(const BlockInput& input, int cell) const {
    const DiscreteStiffness& stiffness = discrete_stiffness(input, cell);
    const Material* material =
        input.materials.by_cell.empty() ? nullptr : input.materials.by_cell[static_cast<std::size_t>(cell)].get();
    if (material == nullptr || !material->contact_spring) {
      throw Error(
          "missing-material",
          fmt::format("the discrete element on cell {} is to have contact, and its material has no contact spring",
                      mesh_.cell_name(cell)),
          "give it DIS_CONTACT in DEFI_MATERIAU");
    }
    const ContactSpring& spring = *material->contact_spring;
    if (!(spring.normal > 0.0))
      throw Error("invalid-material",
                  fmt::format("the contact of the discrete element on cell {} needs a normal stiffness above zero",
                              mesh_.cell_name(cell)));
    return {&spring, stiffness.axes, first_gap(spring, cell, stiffness.axes), rotation_stiffness(stiffness, cell)};
  }

  double first_gap(const ContactSpring& spring, int cell, const Eigen::Matrix3d& axes) const {
    if (node_count_ == 1) return spring.clearance - spring.first_distance;
    const auto nodes = mesh_.cell(cell);
    const Eigen::Map<const Eigen::Vector3d> first(mesh_.nodes[static_cast<std::size_t>(nodes[0])].data());
    const Eigen::Map<const Eigen::Vector3d> second(mesh_.nodes[static_cast<std::size_t>(nodes[1])].data());
    return axes.row(0).dot(second - first) - spring.first_distance - spring.second_distance;
  }

  ElementMatrix rotation_stiffness(const DiscreteStiffness& stiffness, int cell) const {
    ElementMatrix rotations = stiffness.matrix;
    Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(rotations.rows(), rotations.cols());
    for (int i = 0; i < rotations.rows(); ++i) {
      for (int j = 0; j < rotations.cols(); ++j) {
        if (is_turn(i) != is_turn(j)) coupling(i, j) = stiffness.matrix(i, j);
        if (!is_turn(i) || !is_turn(j)) rotations(i, j) = 0.0;
      }
    }
    if (!is_rounding(coupling, stiffness.matrix) ||
        !is_rounding(stiffness.matrix - stiffness.matrix.transpose(), stiffness.matrix))
      throw Error("unsupported",
                  fmt::format("the discrete element on cell {} has contact, and a stiffness that couples translations "
                              "and rotations, or is not symmetric",
                              mesh_.cell_name(cell)),
                  "give it a diagonal stiffness");
    return rotations;
  }

  /// From the rotations in global axes to those in own ones; about Z in the plane.
  Eigen::MatrixXd rotation_axes(int element) const {
    const int count = map_.components() - translations_;
    if (count < 3) return Eigen::MatrixXd::Identity(count, count);
    return at(element).axes;
  }

  ElementVector unknowns(int element, const Eigen::VectorXd& u) const {
    std::array<int, largest_size> dofs;
    map_.dofs(element, dofs.data());
    ElementVector own(node_count_ * map_.components());
    for (Eigen::Index i = 0; i < own.size(); ++i) own[i] = u[dofs[static_cast<std::size_t>(i)]];
    return own;
  }

  /// Of the last node against the first, or against the ground, in own axes.
  Eigen::Vector3d displacement(int element, const Eigen::VectorXd& u) const {
    const ElementVector all = unknowns(element, u);
    Eigen::Vector3d relative = Eigen::Vector3d::Zero();
    relative.head(translations_) = all.segment((node_count_ - 1) * map_.components(), translations_);
    if (node_count_ == 2) relative.head(translations_) -= all.head(translations_);
    return at(element).axes * relative;
  }

  double gap(int element, const Eigen::VectorXd& u) const {
    return at(element).first_gap + displacement(element, u)[0];
  }

  ContactSpringResponse answer(int element, const Eigen::VectorXd& u) const {
    const Eigen::Vector3d moved = displacement(element, u);
    return respond(*at(element).spring, at(element).first_gap + moved[0], moved.tail<2>(),
                   slips_[static_cast<std::size_t>(element)]);
  }

  ElementVector rotation_forces(int element, const Eigen::VectorXd& u) const {
    return at(element).rotations * unknowns(element, u);
  }

  /// `own`: the translational force in own axes.
  ElementVector end_forces(int element, const Eigen::Ref<const Eigen::VectorXd>& own,
                           const ElementVector& rotations) const {
    const Eigen::VectorXd global = at(element).axes.topLeftCorner(translations_, translations_).transpose() * own;
    ElementVector ends = rotations;
    ends.segment((node_count_ - 1) * map_.components(), translations_) += global;
    if (node_count_ == 2) ends.head(translations_) -= global;
    return ends;
  }

  void add(int element, const ElementVector& ends, ForceSum forces) const {
    std::array<int, largest_size> dofs;
    map_.dofs(element, dofs.data());
    for (Eigen::Index i = 0; i < ends.size(); ++i)
      forces[static_cast<std::size_t>(dofs[static_cast<std::size_t>(i)])] += ends[i];
  }

  /// From that of the spring in own axes to that of the element in global ones.
  ElementMatrix tangent(int element, const Eigen::Matrix3d& own) const {
    const int k = map_.components(), t = translations_;
    const Eigen::Matrix3d global = at(element).axes.transpose() * own * at(element).axes;
    ElementMatrix matrix = at(element).rotations;
    for (int i = 0; i < node_count_; ++i)
      for (int j = 0; j < node_count_; ++j)
        matrix.block(i * k, j * k, t, t) += (i == j ? 1.0 : -1.0) * global.topLeftCorner(t, t);
    return matrix;
  }

  std::vector<Member> members_;
  std::vector<Eigen::Vector2d> slips_;  ///< where the step began
};

}  // namespace

std::unique_ptr<ElementBlock> make_discrete_contact_block(const BlockInput& input, std::vector<int> cells) {
  require_small_displacements(input, cells.front(), "contact inside discrete elements knows");
  return std::make_unique<DiscreteContact>(input, std::move(cells));
}

}  // namespace comma::solver
