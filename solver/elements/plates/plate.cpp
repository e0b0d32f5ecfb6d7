// Flat plates on three or four nodes, thin (DKT, DKQ) or with shear (DST, DSQ): see flat_plate.hpp for one of them,
// plate_kinematics.hpp for its strains.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "solver/elements/element_block.hpp"
#include "solver/elements/energy_parts.hpp"
#include "solver/elements/plates/flat_plate.hpp"
#include "solver/elements/translation.hpp"
#include "solver/error.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

/// All plates of a model on cells of one type. Materials count by their constants at the middle of a cell.
template <int Nodes>
class PlateBlock final : public ElementBlock {
  static constexpr int size = 6 * Nodes;
  static constexpr CellType type = Nodes == 3 ? CellType::tria3 : CellType::quad4;
  using Matrix = Eigen::Matrix<double, size, size>;
  using Vector = Eigen::Matrix<double, size, 1>;

 public:
  PlateBlock(const BlockInput& input, std::vector<int> cells)
      : mesh_(*input.model.mesh),
        shears_(input.model.formulations[cells.front()] == Formulation::shear_plate),
        cells_(std::move(cells)),
        map_(input.pattern, input.dofs, input.model.components_of(cells_.front()), Nodes, gather_nodes(mesh_, cells_)),
        points_(quadrature(type, plate_family(type))) {
    for (const int cell : cells_) {
      plates_.push_back(flat_plate<Nodes>(input, cell));
      const bool constant = is_constant_material(plates_.back());
      constant_ = constant_ && constant;
      matrices_.push_back(constant ? matrix(plates_.back(), MaterialPoint()) : Matrix::Zero().eval());
    }
  }

  void add_stiffness(const Eigen::VectorXd&, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    Matrix own;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.add(element, matrix_at(element, state, own).data(), column_starts, values);
    }
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    std::array<int, size> dofs;
    Matrix own;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const Matrix& k = matrix_at(element, state, own);
      const auto moved = relative(u, dofs);
      if (!state.empty()) {
        const Vector push = forces_of_variables(element, state);
        for (int i = 0; i < size; ++i) forces[dofs[i]] -= push[i];
      }
      std::array<long double, 3> balance{};
      for (int i = 0; i < size; ++i) {
        const bool balances = i >= size - 6 && i < size - 3;
        long double force = 0.0L;
        for (int j = 0; !balances && j < size; ++j) force += k(i, j) * moved[j];
        if (balances)
          force = -balance[i - (size - 6)];
        else if (i % 6 < 3)
          balance[i % 6] += force;
        forces[dofs[i]] += force;
      }
    }
  }

  std::span<const int> cells() const override { return cells_; }
  int point_count() const override { return 0; }
  std::span<const std::string_view> stress_names() const override { return {}; }
  void stresses(const Eigen::VectorXd&, const VariableState&, std::span<double>) const override {}

  int force_point_count(PlatePlaces places) const override {
    return places == PlatePlaces::corners ? Nodes : static_cast<int>(points_.size());
  }

  /// Forces and moments per length about the surface of the mesh, in the plate's own axes.
  void forces(PlatePlaces places, const Eigen::VectorXd& u, const ImposedStrains* imposed, const VariableState& state,
              std::span<double> out) const override {
    std::vector<ReferencePoint> at;
    if (places == PlatePlaces::corners)
      at.assign(reference_nodes(type).begin(), reference_nodes(type).end());
    else
      std::ranges::transform(points_, std::back_inserter(at), &QuadraturePoint::at);
    forces_at(at, u, state, out);
    if (imposed != nullptr) subtract_imposed(at, *imposed, state, out);
  }

  void impose(const ImposedStrains* strains) override { imposed_ = strains; }
  void energies(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    for (const int cell : cells_)
      if (imposed_ != nullptr && imposed_->acts_on(cell))
        throw Error("unsupported",
                    fmt::format("cell {}: the energy of plates is not known beside initial strains (PRE_EPSI)",
                                mesh_.cell_name(cell)));
    std::array<int, size> dofs;
    Matrix own;
    for (int element = 0; element < map_.element_count(); ++element) {
      map_.dofs(element, dofs.data());
      const Matrix& k = matrix_at(element, state, own);
      const auto moved = relative(u, dofs);
      long double work = 0.0L;
      for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) work += moved[i] * k(i, j) * moved[j];
      }
      out[element] = static_cast<double>(0.5L * work);
      if (state.empty()) continue;
      const Vector push = forces_of_variables(element, state);
      for (int i = 0; i < size; ++i) out[element] -= static_cast<double>(moved[i]) * push[i];
      out[element] += energy_of_variables(element, state);
    }
  }

  std::span<const std::string_view> energy_names() const override { return plate_energy_names; }

  /// About the surface of the mesh; what holds the rotation about the normal is in none.
  void energy_parts(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      const FlatPlate<Nodes>& plate = plates_[element];
      const PlateRigidity rigidity = this->rigidity(element, state);
      const PlateKinematics<Nodes> kinematics(plate.corners, rigidity);
      const Vector own = own_displacements(u, element);
      const double offset = plate.section->offset;
      Eigen::Vector4d parts = Eigen::Vector4d::Zero();
      for (const QuadraturePoint& point : points_) {
        const PlateRows<Nodes> rows = kinematics.at(point.at);
        const Eigen::Vector3d curvature = rows.curvature * own;
        const double known = inelastic_strain(element, state, point.at);
        const Eigen::Vector3d strain = rows.membrane * own - Eigen::Vector3d(known, known, 0.0);
        const Eigen::Vector2d shear = rows.shear_force * own;
        const Eigen::Matrix3d membrane = plane_law(rigidity.membrane, rigidity.poisson);
        const Eigen::Matrix3d bending = plane_law(rigidity.bending, rigidity.poisson) + offset * offset * membrane;
        parts += 0.5 * point.weight * rows.measure *
                 Eigen::Vector4d(strain.dot(membrane * strain), curvature.dot(bending * curvature),
                                 rigidity.shear_compliance * shear.squaredNorm(),
                                 2.0 * offset * strain.dot(membrane * curvature));
      }
      std::ranges::copy(parts, out.begin() + 4 * element);
    }
  }

  bool is_linear() const override { return true; }
  bool is_constant() const override { return constant_; }

  void add_imposed_strain_forces(const ImposedStrains& imposed, const VariableState& state,
                                 ForceSum forces) const override {
    for (int element = 0; element < map_.element_count(); ++element) {
      if (!imposed.acts_on(cells_[element])) continue;
      const PlateRigidity rigidity = this->rigidity(element, state);
      const PlateKinematics<Nodes> kinematics(plates_[element].corners, rigidity);
      Vector push = Vector::Zero();
      for (const QuadraturePoint& point : points_) {
        const PlateRows<Nodes> rows = kinematics.at(point.at);
        const Resultants resultants = imposed_resultants(imposed, element, rigidity, point.at);
        push += point.weight * rows.measure *
                (rows.membrane.transpose() * resultants.normal + rows.curvature.transpose() * resultants.moment);
      }
      add_own_forces(element, push, forces);
    }
  }

  bool takes_initial_stresses() const override { return true; }
  void add_forces_of_stresses(const Eigen::VectorXd&, const VariableState& state, std::span<const double> stresses,
                              ForceSum forces) const override {
    const double* own = stresses.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      const PlateRigidity rigidity = this->rigidity(element, state);
      const PlateKinematics<Nodes> kinematics(plates_[element].corners, rigidity);
      Vector pull = Vector::Zero();
      for (const QuadraturePoint& point : points_) {
        const PlateRows<Nodes> rows = kinematics.at(point.at);
        const Eigen::Map<const Eigen::Matrix<double, 8, 1>> given(own);
        pull += point.weight * rows.measure *
                (rows.membrane.transpose() * given.head<3>() + rows.curvature.transpose() * given.segment<3>(3) +
                 rigidity.shear_compliance * rows.shear_force.transpose() * given.tail<2>());
        own += given.size();
      }
      add_own_forces(element, pull, forces);
    }
  }

 private:
  /// Forces on the nodes, given in the plate's own axes.
  void add_own_forces(int element, const Vector& own, ForceSum forces) const {
    std::array<int, size> dofs;
    map_.dofs(element, dofs.data());
    for (int i = 0; i < size; i += 3) {
      const Eigen::Vector3d global = plates_[element].axes.transpose() * own.template segment<3>(i);
      for (int j = 0; j < 3; ++j) forces[dofs[i + j]] += global[j];
    }
  }

  /// Forces and moments per length at places of the reference cell, about the surface of the mesh, in the plate's own
  /// axes.
  void forces_at(std::span<const ReferencePoint> places, const Eigen::VectorXd& u, const VariableState& state,
                 std::span<double> out) const {
    double* target = out.data();
    for (int element = 0; element < map_.element_count(); ++element) {
      const Vector own = own_displacements(u, element);
      const PlateRigidity rigidity = this->rigidity(element, state);
      const PlateKinematics<Nodes> kinematics(plates_[element].corners, rigidity);
      for (const ReferencePoint& place : places) {
        const PlateRows<Nodes> rows = kinematics.at(place);
        const double offset = plates_[element].section->offset;
        const Eigen::Vector3d curvature = rows.curvature * own;
        const Eigen::Vector3d normal =
            plane_law(rigidity.membrane, rigidity.poisson) * (rows.membrane * own + offset * curvature) -
            membrane_forces(rigidity, inelastic_strain(element, state, place));
        const Eigen::Vector3d moment = plane_law(rigidity.bending, rigidity.poisson) * curvature + offset * normal;
        const Eigen::Vector2d shear = rows.shear_force * own;
        target = std::copy(normal.begin(), normal.end(), target);
        target = std::copy(moment.begin(), moment.end(), target);
        target = std::copy(shear.begin(), shear.end(), target);
      }
    }
  }

  void subtract_imposed(std::span<const ReferencePoint> places, const ImposedStrains& imposed,
                        const VariableState& state, std::span<double> out) const {
    const std::size_t names = plate_force_names.size();
    for (int element = 0; element < map_.element_count(); ++element) {
      if (!imposed.acts_on(cells_[element])) continue;
      double* target = out.data() + static_cast<std::size_t>(element) * places.size() * names;
      for (const ReferencePoint& place : places) {
        const Resultants resultants = imposed_resultants(imposed, element, rigidity(element, state), place);
        for (int c = 0; c < 3; ++c) {
          target[c] -= resultants.normal[c];
          target[3 + c] -= resultants.moment[c];
        }
        target += names;
      }
    }
  }

  /// Forces and moments per length about the surface of the mesh.
  struct Resultants {
    Eigen::Vector3d normal;
    Eigen::Vector3d moment;
  };

  /// Those of an imposed strain at a place of the reference cell.
  Resultants imposed_resultants(const ImposedStrains& imposed, int element, const PlateRigidity& rigidity,
                                const ReferencePoint& place) const {
    const auto nodes = map_.nodes(element);
    const Eigen::VectorXd shares = shape_functions(type, place);
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (int i = 0; i < Nodes; ++i) at += shares[i] * Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[nodes[i]].data());
    Eigen::Matrix<double, 6, 1> strain = imposed.plate(cells_[element], at);
    // Code_Aster has them along the first direction of the cell, whatever axes AFFE_CARA_ELEM asks for.
    const Eigen::Matrix3d turn = turned_strain(first_direction(plates_[element]));
    strain << turn * strain.head<3>(), turn * strain.tail<3>();
    const double offset = plates_[element].section->offset;
    const Eigen::Vector3d normal =
        plane_law(rigidity.membrane, rigidity.poisson) * (strain.head<3>() + offset * strain.tail<3>());
    return {normal, plane_law(rigidity.bending, rigidity.poisson) * strain.tail<3>() + offset * normal};
  }

  static bool is_constant_material(const FlatPlate<Nodes>& plate) {
    return plate.material->young.is_constant() && plate.material->poisson.is_constant();
  }

  /// In the middle of the cell.
  MaterialPoint material_point(int element, const VariableState& state) const {
    std::array<double, Nodes> shares;
    shares.fill(1.0 / Nodes);
    return material_point(element, state, shares);
  }

  /// Where the nodes have these shares.
  MaterialPoint material_point(int element, const VariableState& state, std::span<const double> shares) const {
    const auto nodes = map_.nodes(element);
    MaterialPoint at;
    state.sample(cells_[element], nodes, shares, VariableState::all_points, at);
    std::array<double, 3> place{};
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int j = 0; j < 3; ++j) place[j] += shares[i] * mesh_.nodes[nodes[i]][j];
    at.place(place);
    return at;
  }

  PlateRigidity rigidity(int element, const VariableState& state) const {
    const FlatPlate<Nodes>& plate = plates_[element];
    return rigidity_of(*plate.section, moduli(*plate.material, material_point(element, state)), shears_);
  }

  /// What the command variables at a place strain the plate by, the same in all directions and through the thickness.
  double inelastic_strain(int element, const VariableState& state, const ReferencePoint& place) const {
    if (state.empty()) return 0.0;
    const Eigen::VectorXd shares = shape_functions(type, place);
    return inelastic_axial_strain(*plates_[element].material,
                                  material_point(element, state, {shares.data(), static_cast<std::size_t>(Nodes)}));
  }

  /// The membrane forces that undo such a strain, about the middle of the plate.
  static Eigen::Vector3d membrane_forces(const PlateRigidity& rigidity, double strain) {
    return plane_law(rigidity.membrane, rigidity.poisson) * Eigen::Vector3d(strain, strain, 0.0);
  }

  /// The energy of such a strain that is held back.
  double energy_of_variables(int element, const VariableState& state) const {
    const PlateRigidity rigidity = this->rigidity(element, state);
    const PlateKinematics<Nodes> kinematics(plates_[element].corners, rigidity);
    double energy = 0.0;
    for (const QuadraturePoint& point : points_) {
      const double strain = inelastic_strain(element, state, point.at);
      energy += 0.5 * point.weight * kinematics.at(point.at).measure * strain *
                membrane_forces(rigidity, strain).template head<2>().sum();
    }
    return energy;
  }

  /// The forces (in the axes of the mesh) with which such a strain pushes the nodes apart.
  Vector forces_of_variables(int element, const VariableState& state) const {
    const FlatPlate<Nodes>& plate = plates_[element];
    const PlateRigidity rigidity = this->rigidity(element, state);
    const PlateKinematics<Nodes> kinematics(plate.corners, rigidity);
    Vector forces = Vector::Zero();
    for (const QuadraturePoint& point : points_) {
      const PlateRows<Nodes> rows = kinematics.at(point.at);
      const Eigen::Vector3d pushing = membrane_forces(rigidity, inelastic_strain(element, state, point.at));
      forces +=
          point.weight * rows.measure * (rows.membrane + plate.section->offset * rows.curvature).transpose() * pushing;
    }
    for (int i = 0; i < size; i += 3)
      forces.template segment<3>(i) = (plate.axes.transpose() * forces.template segment<3>(i)).eval();
    return forces;
  }

  const Matrix& matrix_at(int element, const VariableState& state, Matrix& own) const {
    if (is_constant_material(plates_[element])) return matrices_[element];
    own = matrix(plates_[element], material_point(element, state));
    return own;
  }

  /// Displacements relative to the last corner: a translation strains nothing, to the last bit (translation.hpp).
  static std::array<long double, size> relative(const Eigen::VectorXd& u, const std::array<int, size>& dofs) {
    std::array<long double, size> moved;
    for (int i = 0; i < size; ++i) {
      moved[i] = u[dofs[i]];
      if (i % 6 < 3) moved[i] -= u[dofs[size - 6 + i % 6]];
    }
    return moved;
  }

  /// The same in the plate's own axes.
  Vector own_displacements(const Eigen::VectorXd& u, int element) const {
    std::array<int, size> dofs;
    map_.dofs(element, dofs.data());
    const auto moved = relative(u, dofs);
    Vector own;
    for (int i = 0; i < size; ++i) own[i] = static_cast<double>(moved[i]);
    for (int i = 0; i < size; i += 3)
      own.template segment<3>(i) = (plates_[element].axes * own.template segment<3>(i)).eval();
    return own;
  }

  Matrix matrix(const FlatPlate<Nodes>& plate, const MaterialPoint& at) const {
    const IsotropicModuli constants = moduli(*plate.material, at);
    Matrix k = plate_stiffness(plate, rigidity_of(*plate.section, constants, shears_), constants.young, points_);
    Matrix turn = Matrix::Zero();
    for (int i = 0; i < size; i += 3) turn.template block<3, 3>(i, i) = plate.axes;
    k = (turn.transpose() * k * turn).eval();
    k = (0.5 * (k + k.transpose())).eval();
    make_translation_exact<Nodes, 6>(k, {true, true, true, false, false, false});
    return k;
  }

  /// What a strain xx, yy, 2 xy along a direction and across it is along x and y.
  static Eigen::Matrix3d turned_strain(const Eigen::Vector2d& direction) {
    const double c = direction[0], s = direction[1];
    Eigen::Matrix3d turn;
    turn << c * c, s * s, -c * s, s * s, c * c, c * s, 2 * c * s, -2 * c * s, c * c - s * s;
    return turn;
  }

  const Mesh& mesh_;
  bool shears_;
  bool constant_ = true;
  std::vector<int> cells_;
  ElementMap map_;
  Quadrature points_;
  const ImposedStrains* imposed_ = nullptr;
  std::vector<FlatPlate<Nodes>> plates_;
  std::vector<Matrix> matrices_;  ///< where the material is constant
};

}  // namespace

std::unique_ptr<ElementBlock> make_plate_block(const BlockInput& input, std::vector<int> cells) {
  switch (input.model.mesh->cell_types[cells.front()]) {
    case CellType::tria3:
      return std::make_unique<PlateBlock<3>>(input, std::move(cells));
    case CellType::quad4:
      return std::make_unique<PlateBlock<4>>(input, std::move(cells));
    default:
      throw_unsupported_element(input.model, cells.front());
  }
}

}  // namespace comma::solver
