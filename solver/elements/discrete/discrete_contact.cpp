#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/discrete/discrete_elements.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr int variables_of_contact = 9;
constexpr int largest_size = 2 * component_count;
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, largest_size, 1>;
using ElementMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, largest_size, largest_size>;

class DiscreteContact final : public DiscreteElements {
 public:
  DiscreteContact(const BlockInput& input, std::vector<int> cells) : DiscreteElements(input, std::move(cells)) {
    for (const int cell : cells_) {
      members_.push_back(member(input, cell));
      past_.push_back({Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), members_.back().first_gap});
    }
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
      stiffness.bottomRightCorner<2, 2>() += at(element).across;
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
    for (int element = 0; element < map_.element_count(); ++element)
      map_.append_skew_half(element, tangent(element, answer(element, u).tangent), entries);
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
      const Eigen::Map<const ElementVector> own(reported.data() + begin_of(element, k), k);
      ElementVector rotations = ElementVector::Zero(node_count_ * k);
      rotations.segment((node_count_ - 1) * k + translations_, k - translations_) =
          rotation_axes(element).transpose() * own.tail(k - translations_);
      if (node_count_ == 2) rotations.segment(translations_, k - translations_) = -rotations.tail(k - translations_);
      add(element, end_forces(element, own.head(translations_), rotations), forces);
    }
  }

  /// At the last node, and as much at the first, in the element's own axes: N < 0 where the element is closed.
  void stresses(const Eigen::VectorXd& u, const VariableState&, std::span<double> out) const override {
    const int k = map_.components();
    for (int element = 0; element < map_.element_count(); ++element) {
      Eigen::Map<ElementVector> own(out.data() + begin_of(element, k), k);
      own.head(translations_) = answer(element, u).force.head(translations_);
      own.tail(k - translations_) = rotation_axes(element) * rotation_forces(element, u).tail(k - translations_);
      repeat_at_second_end(own.data(), k);
    }
  }

  bool is_linear() const override { return false; }
  bool is_constant() const override { return true; }
  bool has_memory() const override { return true; }

  int variable_count() const override { return variables_of_contact; }
  void variables(const Eigen::VectorXd& u, const VariableState&, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const auto own = out.subspan(begin_of(element, variables_of_contact), variables_of_contact);
      const Eigen::Vector2d friction = answer(element, u).force.tail<2>() - force_across(element, u);
      const Eigen::Vector2d slid = slid_by(element, u);
      std::ranges::fill(own, 0.0);
      std::ranges::copy(friction, own.begin());
      std::ranges::copy(slid, own.begin() + slid_variable);
      own[segment_variable] = node_count_ == 2 ? 1.0 : 0.0;
      own[segment_variable + 1] = 1.0;
      repeat_at_second_end(own.data(), variables_of_contact);
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
    for (int element = 0; element < map_.element_count(); ++element) {
      const Eigen::Vector2d slid = slid_by(element, u);
      past_[static_cast<std::size_t>(element)] = {answer(element, u).slip, slid, gap(element, u)};
    }
  }

  /// Without variables the force tells how far it had slipped.
  void resume(const Eigen::VectorXd& u, const VariableState&, std::span<const double> reported,
              std::span<const double> variables) override {
    for (int element = 0; element < map_.element_count(); ++element) {
      Past& past = past_[static_cast<std::size_t>(element)];
      past = {displacement(element, u).tail<2>(), Eigen::Vector2d::Zero(), gap(element, u)};
      Eigen::Vector2d friction = Eigen::Vector2d::Zero();
      if (!variables.empty()) {
        const double* own = variables.data() + begin_of(element, variables_of_contact);
        friction = Eigen::Map<const Eigen::Vector2d>(own);
        past.slid = Eigen::Map<const Eigen::Vector2d>(own + slid_variable);
      } else if (!reported.empty()) {
        for (int c = 1; c < translations_; ++c)
          friction[c - 1] = reported[begin_of(element, map_.components()) + static_cast<std::size_t>(c)];
        friction -= force_across(element, u);
      }
      const double stiffness = at(element).spring->tangential;
      if (stiffness > 0.0 && past.gap <= 0.0) past.slip -= friction / stiffness;
    }
  }

 private:
  struct Member {
    const ContactSpring* spring;
    Eigen::Matrix3d axes;
    double first_gap;         ///< undisplaced
    ElementMatrix rotations;  ///< the element's stiffness without its translations
    Eigen::Matrix2d across;   ///< that across the first own axis
  };
  /// Where the step began.
  struct Past {
    Eigen::Vector2d slip;  ///< the part of the sideways displacement that friction does not come from
    Eigen::Vector2d slid;  ///< how far it has slid while closed
    double gap;
  };
  static constexpr int slid_variable = 2, segment_variable = 7;

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
    return {&spring, stiffness.axes, first_gap(spring, cell, stiffness.axes), rotation_stiffness(stiffness, cell),
            stiffness_across(stiffness)};
  }

  Eigen::Matrix2d stiffness_across(const DiscreteStiffness& stiffness) const {
    Eigen::Matrix3d translations = Eigen::Matrix3d::Zero();
    translations.topLeftCorner(translations_, translations_) =
        stiffness.matrix.topLeftCorner(translations_, translations_);
    return (stiffness.axes * translations * stiffness.axes.transpose()).bottomRightCorner<2, 2>();
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

  Eigen::Vector2d force_across(int element, const Eigen::VectorXd& u) const {
    return at(element).across * displacement(element, u).tail<2>();
  }

  /// Which share of the step's displacement goes by before an open gap closes; 0 where it was closed, or stays open.
  double open_share(int element, double gap) const {
    const double before = past_[static_cast<std::size_t>(element)].gap;
    return before > 0.0 && gap < 0.0 ? before / (before - gap) : 0.0;
  }
  /// The slip where friction begins to grow in the step: of an open gap that of where it closes.
  Eigen::Vector2d first_slip(int element, const Eigen::Vector3d& moved) const {
    const Eigen::Vector2d& slip = past_[static_cast<std::size_t>(element)].slip;
    return slip + open_share(element, at(element).first_gap + moved[0]) * (moved.tail<2>() - slip);
  }

  ContactSpringResponse answer(int element, const Eigen::VectorXd& u) const {
    const Eigen::Vector3d moved = displacement(element, u);
    const double now = at(element).first_gap + moved[0];
    ContactSpringResponse response = respond(*at(element).spring, now, moved.tail<2>(), first_slip(element, moved));
    if (const double open = open_share(element, now); open > 0.0) {
      // The first slip follows the displacements.
      const Past& past = past_[static_cast<std::size_t>(element)];
      const Eigen::Matrix2d sideways = response.tangent.bottomRightCorner<2, 2>();
      const double rate = past.gap / ((past.gap - now) * (past.gap - now));
      response.tangent.bottomLeftCorner<2, 1>() -= rate * sideways * (moved.tail<2>() - past.slip);
      response.tangent.bottomRightCorner<2, 2>() *= 1.0 - open;
    }
    response.force.tail<2>() += at(element).across * moved.tail<2>();
    response.tangent.bottomRightCorner<2, 2>() += at(element).across;
    return response;
  }

  /// How far it has slid while closed, at the end of the step.
  Eigen::Vector2d slid_by(int element, const Eigen::VectorXd& u) const {
    const ContactSpringResponse reached = answer(element, u);
    const Eigen::Vector2d& before = past_[static_cast<std::size_t>(element)].slid;
    if (reached.status == ContactSpringStatus::open) return before;
    return before + reached.slip - first_slip(element, displacement(element, u));
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
  std::vector<Past> past_;
};

}  // namespace

std::unique_ptr<ElementBlock> make_discrete_contact_block(const BlockInput& input, std::vector<int> cells) {
  require_small_displacements(input, cells.front(), "contact inside discrete elements knows");
  return std::make_unique<DiscreteContact>(input, std::move(cells));
}

}  // namespace comma::solver
