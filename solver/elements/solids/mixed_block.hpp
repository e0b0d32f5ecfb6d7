// Continua that hardly change their volume: the pressure, or the pressure and the swelling, are unknowns at the
// corners.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/elements/solids/corner_unknowns.hpp"
#include "solver/elements/solids/inelastic_block.hpp"
#include "solver/elements/solids/mixed_point.hpp"

namespace comma::solver {

inline constexpr std::array<std::string_view, 5> plane_mixed_names = {"SIXX", "SIYY", "SIZZ", "SIXY", "SIP"};
inline constexpr std::array<std::string_view, 7> solid_mixed_names = {"SIXX", "SIYY", "SIZZ", "SIXY",
                                                                      "SIXZ", "SIYZ", "SIP"};

/// Displacements are quadratic, the pressure p and the swelling linear (R3.06.08, Taylor and Hood's interpolation). The
/// law is given a strain with the swelling as its trace; the stress that works is the law's deviator and p. With two
/// fields the three balances are those of mixed_response(); with p alone the swelling at a point is p / K and the
/// strain of the command variables.
///
/// stresses() are Cauchy's, on the volume as the displacements have it, and SIP, the part of a mean that the balance of
/// the swelling or of p is about, as Code_Aster 17.3 shows them: with two fields the law's stress, and by how much p
/// exceeds its mean; with the multiplicative split the law's deviator and p, and by how much the law's mean exceeds p;
/// with p alone the deviator and p, and by how much the mean of the law at the volume of the displacements exceeds it,
/// which of logarithmic strains sees their deviator alone (so that T among the variables has no trace either).
template <int Dim, int Nodes, bool Axisymmetric>
class MixedBlock final : public InelasticBlock<Dim, Nodes, Axisymmetric> {
  using Base = InelasticBlock<Dim, Nodes, Axisymmetric>;
  using Base::size;
  using Base::strains;
  using typename Base::Constants;
  using typename Base::Coordinates;
  using typename Base::Displacements;
  using typename Base::Point;
  using typename Base::Respond;
  using typename Base::Stiffness;
  using typename Base::Strain;
  using typename Base::StrainRow;

  static constexpr int most_corners = 8;
  static constexpr int most_unknowns = 2 * most_corners;
  static constexpr int stress_count = strains + 1;
  using Corners = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_corners, 1>;
  using Unknowns = Eigen::Matrix<double, most_unknowns, 1>;

  struct Tangent {
    Stiffness displacements;
    Eigen::Matrix<double, size, most_unknowns> coupling;
    Eigen::Matrix<double, most_unknowns, most_unknowns> own;
  };
  struct Forces {
    Coordinates displacements;
    Unknowns own;
  };

 public:
  MixedBlock(const BlockInput& input, std::vector<int> cells)
      : Base(input, std::move(cells)),
        behaviour_(input.behaviour_of(this->cells_.front())),
        measure_(volume_measure(behaviour_.kinematics)),
        corners_(corner_count(this->mesh_.cell_types[this->cells_.front()])),
        unknowns_(input.pattern, input.dofs, mixed_field_count(this->formulation_), corners_) {
    check_behaviour();
    const CellType type = this->mesh_.cell_types[this->cells_.front()];
    const CellType linear = linear_cell(input.model, this->cells_.front());
    for (const auto& point : quadrature(type, stiffness_family(type, this->formulation_)))
      at_corners_.push_back(shape_functions(linear, point.at));
  }

  bool has_memory() const override { return solver::has_memory(behaviour_); }
  std::span<const std::string_view> stress_names() const override {
    if constexpr (Dim == 3) return solid_mixed_names;
    return plane_mixed_names;
  }

  void add_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                     double* values) const override {
    assemble(u, state, column_starts, values, &PointLaw::respond);
  }
  void add_skew_stiffness(const Eigen::VectorXd& u, const VariableState& state,
                          std::vector<Eigen::Triplet<double>>& entries) const override {
    for_each_in_batches<Tangent>(
        this->map_.element_count(), this->may_be_concurrent(state),
        [&](int element, Tangent& tangent) { skew_tangent_of(element, u, state, tangent); },
        [&](int element, const Tangent& tangent) { append_skew_tangent(element, tangent, entries); });
  }
  void add_elastic_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    assemble(u, state, column_starts, values, &PointLaw::respond_elastically);
  }
  void add_initial_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                             double* values) const override {
    if (!is_large()) return add_elastic_stiffness(u, state, column_starts, values);
    const auto at_rest = [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d&, const Fields&) {
      const Constants constants(*this, element, g, x, state);
      MixedResponse response = elastic_mixed_response(constants.plastic->bulk, constants.plastic->shear);
      if (!two_fields()) eliminate_swelling(constants.plastic->bulk, response);
      return response;
    };
    assemble_tangents(Eigen::VectorXd::Zero(u.size()), state, column_starts, values, at_rest);
  }

  void add_internal_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    add_law_forces(u, state, forces, &PointLaw::respond);
  }

  void add_starting_stiffness(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                              double* values) const override {
    assemble(u, state, column_starts, values, &PointLaw::begin);
  }
  void add_starting_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const override {
    add_law_forces(u, state, forces, &PointLaw::begin);
  }

  void weigh_rows(const VariableState& state, std::span<double> weights) const override {
    std::array<int, most_unknowns> dofs;
    for (int element = 0; element < this->map_.element_count(); ++element) {
      const Coordinates x = this->coordinates(element);
      const double length = (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
      const Constants constants(*this, element, 0, x, state);
      const double bulk = constants.plastic->bulk, shear = constants.plastic->shear;
      const double young = 9.0 * bulk * shear / (3.0 * bulk + shear);
      unknowns_.dofs(this->map_.nodes(element), dofs.data());
      for (int k = 0; k < unknowns_.count(); ++k) {
        double& weight = weights[static_cast<std::size_t>(dofs[static_cast<std::size_t>(k)])];
        weight = std::max(weight, (k < corners_ ? young : 1.0) / length);
      }
    }
  }

  void add_forces_of_stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> reported,
                              ForceSum forces) const override {
    if (!has_memory()) return add_internal_forces(u, state, forces);
    add_forces(u, state, forces,
               [&](int element, int g, const Coordinates&, const Eigen::Matrix3d& gradient, const Fields& fields) {
                 const double* shown =
                     reported.data() + static_cast<std::ptrdiff_t>(this->point_index(element, g)) * stress_count;
                 Vector6d stress = Base::padded(shown);
                 const double shown_mean = stress.head<3>().mean(), volume = volume_ratio(gradient);
                 const double mean = measure_ == VolumeMeasure::ratio ? shown_mean + shown[strains] : shown_mean;
                 stress.head<3>().array() +=
                     (measure_ == VolumeMeasure::logarithm ? fields.pressure / volume : fields.pressure) - shown_mean;
                 MixedResponse response;
                 response.stress = is_large() ? second_stress_of(gradient, stress) : stress;
                 response.swelling = two_fields() ? law_pressure(mean, volume, fields) - fields.pressure : 0.0;
                 response.pressure = volume_of(gradient, measure_) - fields.swelling;
                 return response;
               });
  }

  /// The law sees strains less the imposed ones: by Hooke's law these would push as hard as the material resists
  /// changes of its volume, of which the pressure is an unknown.
  void impose(const ImposedStrains* strains) override { this->imposed_ = strains; }
  bool shows_imposed_strains() const override { return false; }
  void add_imposed_strain_forces(const ImposedStrains& imposed, const VariableState&, ForceSum) const override {
    for (const int cell : this->cells_) {
      if (!imposed.acts_on(cell)) continue;
      if (is_large())
        throw Error("unsupported",
                    fmt::format("cell {}: with the pressure as an unknown, initial strains are known in small strains "
                                "only",
                                this->mesh_.cell_name(cell)),
                    "take DEFORMATION='PETIT', or a modelisation without INCO");
      check_known_to_law(this->imposed_, this->mesh_, cell);
    }
  }

  /// The pressure as an unknown has no part in them.
  void add_initial_stress_forces(std::span<const double> stresses, ForceSum forces) const override {
    Base::add_initial_stress_forces(law_stresses(stresses), forces);
  }

  void stresses(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    double* target = out.data();
    each_mixed_point(
        u, state, [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient, const Fields& fields) {
          const PointResponse law =
              this->respond(element, g, x, with_volume(gradient, fields.swelling, measure_), state, &PointLaw::respond);
          const double volume = volume_ratio(gradient);
          Vector6d stress = law.reported * (ratio_of(fields.swelling) / volume);
          const double mean = stress.template head<3>().mean();
          if (two_fields() && measure_ != VolumeMeasure::ratio) {
            target[strains] = fields.pressure - law_pressure(mean, volume, fields);
          } else {
            const double shown = measure_ == VolumeMeasure::logarithm ? fields.pressure / volume : fields.pressure;
            stress.template head<3>().array() += shown - mean;
            target[strains] = law_mean(gradient, fields, mean) - shown;
          }
          Eigen::Map<Strain> written(target);
          written = stress.template head<strains>();
          target += stress_count;
        });
  }

  void variables(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    Base::variables(u, state, out);
    if (!keeps_deviator()) return;
    each_stress_of_strain(out, [](auto stress, std::size_t) { stress.array() -= stress.mean(); });
  }

  void energies(const Eigen::VectorXd& u, const VariableState& state, std::span<double> out) const override {
    if (has_memory()) return Base::energies(u, state, out);
    std::ranges::fill(out, 0.0);
    each_mixed_point(
        u, state, [&](int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient, const Fields& fields) {
          const Constants constants(*this, element, g, x, state);
          PointPast at;
          at.gradient = with_volume(gradient, fields.swelling, measure_);
          at.stress = this->respond(element, g, x, at.gradient, state, &PointLaw::respond).own;
          out[static_cast<std::size_t>(element)] +=
              Base::locate(x, this->samples_[g]).weight * this->law_.elastic_energy(at, *constants.plastic);
        });
  }

  void energy_densities(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> reported,
                        std::span<const double> variables, std::span<double> out) const override {
    if (!keeps_deviator() || variables.empty())
      return Base::energy_densities(u, state, law_stresses(reported), variables, out);
    std::vector<double> whole(variables.begin(), variables.end());
    std::vector<double> pressures;
    each_mixed_point(u, state, [&](int, int, const Coordinates&, const Eigen::Matrix3d&, const Fields& fields) {
      pressures.push_back(fields.pressure);
    });
    each_stress_of_strain(whole, [&](auto stress, std::size_t point) { stress.array() += pressures[point]; });
    Base::energy_densities(u, state, law_stresses(reported), whole, out);
  }

  void accept(const Eigen::VectorXd& u, const VariableState& state) override {
    if (has_memory()) Base::accept(u, state);
  }

  void resume(const Eigen::VectorXd& u, const VariableState& state, std::span<const double> reported,
              std::span<const double> variables) override {
    Base::resume(u, state, law_stresses(reported), variables);
  }

 protected:
  Eigen::Matrix3d law_gradient(const Eigen::VectorXd& u, const VariableState& state, int element, int g,
                               const Coordinates& x, const Eigen::Matrix3d& gradient) const override {
    return with_volume(gradient, fields_at(values_of(u, element), element, g, x, state).swelling, measure_);
  }

 private:
  /// The fields at a point.
  struct Fields {
    double pressure;
    double swelling;
    double bulk;  ///< where the swelling follows from the pressure
  };

  bool is_large() const { return this->law_.is_large(); }
  bool two_fields() const { return unknowns_.fields() == 2; }
  double volume_ratio(const Eigen::Matrix3d& gradient) const {
    return is_large() ? 1.0 + volume_of(gradient, VolumeMeasure::ratio) : 1.0;
  }
  double ratio_of(double swelling) const {
    if (!is_large()) return 1.0;
    return measure_ == VolumeMeasure::ratio ? 1.0 + swelling : std::exp(swelling);
  }
  /// Whether the T of logarithmic strains that results show has no trace.
  bool keeps_deviator() const { return !two_fields() && measure_ == VolumeMeasure::logarithm; }
  /// Calls visitor(the three components along the axes of T, number of the point) for each point of variables().
  template <class Visitor>
  void each_stress_of_strain(std::span<double> variables, Visitor&& visitor) const {
    const auto count = static_cast<std::size_t>(this->variable_count());
    constexpr std::size_t tensor = 6;  // behind all others
    for (std::size_t point = 0; (point + 1) * count <= variables.size(); ++point)
      visitor(Eigen::Map<Eigen::Vector3d>(variables.data() + (point + 1) * count - tensor), point);
  }
  /// The mean of Cauchy's stresses that the law has, `mean` being that at the swelling.
  double law_mean(const Eigen::Matrix3d& gradient, const Fields& fields, double mean) const {
    if (two_fields()) return mean;
    if (measure_ == VolumeMeasure::logarithm) return 0.0;
    return fields.pressure + fields.bulk * (volume_of(gradient, measure_) - fields.swelling);
  }

  /// The mean of Cauchy's stresses as the balance of the swelling has it.
  double law_pressure(double mean, double volume, const Fields& fields) const {
    return mean * volume * logarithm_slope(fields.swelling, measure_);
  }

  void check_behaviour() const {
    const Kinematics kinematics = behaviour_.kinematics;
    if (kinematics == Kinematics::small || kinematics == Kinematics::logarithmic ||
        (kinematics == Kinematics::multiplicative && two_fields()))
      return;
    throw Error("unsupported",
                fmt::format("cell {}: an element with the pressure as an unknown has small or logarithmic strains, "
                            "with the swelling besides also the multiplicative split",
                            this->mesh_.cell_name(this->cells_.front())),
                "take DEFORMATION='PETIT' or 'GDEF_LOG', or 'SIMO_MIEHE' with an INCO_UPG modelisation");
  }

  Unknowns values_of(const Eigen::VectorXd& u, int element) const {
    std::array<int, most_unknowns> dofs;
    unknowns_.dofs(this->map_.nodes(element), dofs.data());
    Unknowns values = Unknowns::Zero();
    for (int k = 0; k < unknowns_.count(); ++k) values[k] = u[dofs[static_cast<std::size_t>(k)]];
    return values;
  }

  Fields fields_at(const Unknowns& values, int element, int g, const Coordinates& x, const VariableState& state) const {
    Fields fields{values.head(corners_).dot(at_corners_[g]), 0.0, 0.0};
    if (two_fields()) {
      fields.swelling = values.segment(corners_, corners_).dot(at_corners_[g]);
      return fields;
    }
    const Constants constants(*this, element, g, x, state);
    fields.bulk = constants.plastic->bulk;
    fields.swelling = fields.pressure / fields.bulk + constants.inelastic.template head<3>().sum();
    return fields;
  }

  MixedResponse response_at(int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient,
                            const Fields& fields, const VariableState& state, Respond how) const {
    const PointResponse law =
        this->respond(element, g, x, with_volume(gradient, fields.swelling, measure_), state, how);
    MixedResponse response = mixed_response(gradient, fields.swelling, fields.pressure, law, measure_);
    if (two_fields()) return response;
    eliminate_swelling(fields.bulk, response);
    if (how == &PointLaw::begin && behaviour_.kinematics == Kinematics::logarithmic)
      response.tangent.template topLeftCorner<6, 6>() += beginning_stiffness(gradient, fields.pressure);
    return response;
  }

  /// The stresses without SIP.
  std::vector<double> law_stresses(std::span<const double> reported) const {
    std::vector<double> result;
    result.reserve(reported.size());
    for (std::size_t k = 0; k < reported.size(); ++k)
      if (k % stress_count != strains) result.push_back(reported[k]);
    return result;
  }

  /// Calls visitor(element, g, coordinates, H, fields) for each point.
  template <class Visitor>
  void each_mixed_point(const Eigen::VectorXd& u, const VariableState& state, Visitor&& visitor) const {
    for (int element = 0; element < this->map_.element_count(); ++element) {
      const Displacements displacements = Base::relative_displacements(u, this->dofs_of(element));
      const Coordinates x = this->coordinates(element);
      const Unknowns values = values_of(u, element);
      for (int g = 0; g < this->point_count(); ++g)
        visitor(element, g, x,
                this->gradient_of_displacement(displacements, this->samples_[g], Base::locate(x, this->samples_[g])),
                fields_at(values, element, g, x, state));
    }
  }

  /// `response_at`(element, g, coordinates, H, fields): what works on strain, swelling and pressure.
  template <class ResponseAt>
  void add_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum sums,
                  const ResponseAt& response_at) const {
    for_each_in_batches<Forces>(
        this->map_.element_count(), this->may_be_concurrent(state),
        [&](int element, Forces& forces) { forces_of(element, u, state, response_at, forces); },
        [&](int element, const Forces& forces) {
          Base::scatter_forces(forces.displacements, this->dofs_of(element), sums);
          std::array<int, most_unknowns> dofs;
          unknowns_.dofs(this->map_.nodes(element), dofs.data());
          for (int k = 0; k < unknowns_.count(); ++k)
            sums[static_cast<std::size_t>(dofs[static_cast<std::size_t>(k)])] += forces.own[k];
        });
  }

  /// Calls visitor(g, point, H, response).
  template <class ResponseAt, class Visitor>
  void each_point_of(int element, const Eigen::VectorXd& u, const VariableState& state, const ResponseAt& response_at,
                     Visitor&& visitor) const {
    const Displacements displacements = Base::relative_displacements(u, this->dofs_of(element));
    const Coordinates x = this->coordinates(element);
    const Unknowns values = values_of(u, element);
    for (int g = 0; g < this->point_count(); ++g) {
      const Point point = Base::locate(x, this->samples_[g]);
      const Eigen::Matrix3d gradient = this->gradient_of_displacement(displacements, this->samples_[g], point);
      visitor(g, point, gradient, response_at(element, g, x, gradient, fields_at(values, element, g, x, state)));
    }
  }

  template <class ResponseAt>
  void forces_of(int element, const Eigen::VectorXd& u, const VariableState& state, const ResponseAt& response_at,
                 Forces& forces) const {
    forces.displacements.setZero();
    forces.own.setZero();
    each_point_of(element, u, state, response_at,
                  [&](int g, const Point& point, const Eigen::Matrix3d& gradient, const MixedResponse& response) {
                    const Strain stress = point.weight * response.stress.template head<strains>();
                    for (int a = 0; a < Nodes; ++a)
                      forces.displacements.row(a) +=
                          (this->row(gradient, g, point, a).transpose() * stress).transpose();
                    forces.own.head(corners_) += point.weight * response.pressure * at_corners_[g];
                    if (two_fields())
                      forces.own.segment(corners_, corners_) += point.weight * response.swelling * at_corners_[g];
                  });
  }

  void add_law_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces, Respond how) const {
    add_forces(u, state, forces, law_response(state, how));
  }
  auto law_response(const VariableState& state, Respond how) const {
    return
        [this, &state, how](int element, int g, const Coordinates& x, const Eigen::Matrix3d& gradient,
                            const Fields& fields) { return response_at(element, g, x, gradient, fields, state, how); };
  }

  void assemble(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                double* values, Respond how) const {
    assemble_tangents(u, state, column_starts, values, law_response(state, how));
  }

  template <class ResponseAt>
  void assemble_tangents(const Eigen::VectorXd& u, const VariableState& state, std::span<const int> column_starts,
                         double* values, const ResponseAt& response_at) const {
    for_each_in_batches<Tangent>(
        this->map_.element_count(), this->may_be_concurrent(state),
        [&](int element, Tangent& tangent) { tangent_of(element, u, state, response_at, tangent); },
        [&](int element, const Tangent& tangent) {
          this->map_.add(element, tangent.displacements.data(), column_starts, values);
          unknowns_.add(this->map_.nodes(element), this->dofs_of(element), tangent.coupling.data(), tangent.own.data(),
                        most_unknowns, column_starts, values);
        });
  }

  template <class ResponseAt>
  void tangent_of(int element, const Eigen::VectorXd& u, const VariableState& state, const ResponseAt& response_at,
                  Tangent& tangent) const {
    tangent.displacements.setZero();
    tangent.coupling.setZero();
    tangent.own.setZero();
    each_point_of(element, u, state, response_at,
                  [&](int g, const Point& point, const Eigen::Matrix3d& gradient, const MixedResponse& response) {
                    add_point(0.5 * (response.tangent + response.tangent.transpose()), g, point, gradient, tangent);
                    if (!this->law_.has_geometric_part()) return;
                    const typename Base::Strain stress = response.stress.template head<strains>();
                    this->add_geometric(point, stress, tangent.displacements);
                    this->add_hoops(this->samples_[g], point, stress, tangent.displacements);
                  });
    tangent.displacements.template triangularView<Eigen::StrictlyUpper>() = tangent.displacements.transpose();
    make_translation_exact<Nodes, Dim>(tangent.displacements, Base::invariant_directions());
  }

  /// The skew-symmetric half, with the strict lower triangle of the displacements.
  void skew_tangent_of(int element, const Eigen::VectorXd& u, const VariableState& state, Tangent& tangent) const {
    tangent.displacements.setZero();
    tangent.coupling.setZero();
    tangent.own.setZero();
    each_point_of(element, u, state, law_response(state, &PointLaw::respond),
                  [&](int g, const Point& point, const Eigen::Matrix3d& gradient, const MixedResponse& response) {
                    add_point(0.5 * (response.tangent - response.tangent.transpose()), g, point, gradient, tangent);
                  });
    tangent.displacements.template triangularView<Eigen::StrictlyUpper>() = -tangent.displacements.transpose();
  }

  void append_skew_tangent(int element, const Tangent& tangent, std::vector<Eigen::Triplet<double>>& entries) const {
    const int count = unknowns_.count();
    std::array<int, size + most_unknowns> dofs;
    this->map_.dofs(element, dofs.data());
    unknowns_.dofs(this->map_.nodes(element), dofs.data() + size);
    Eigen::MatrixXd whole(size + count, size + count);
    whole << tangent.displacements, tangent.coupling.leftCols(count), -tangent.coupling.leftCols(count).transpose(),
        tangent.own.topLeftCorner(count, count);
    append_skew_half(std::span(dofs).first(static_cast<std::size_t>(size + count)), whole, entries);
  }

  /// Half of a point's tangent, symmetric or skew: of the displacements the lower triangle.
  void add_point(const Eigen::Matrix<double, 8, 8>& half, int g, const Point& point, const Eigen::Matrix3d& gradient,
                 Tangent& tangent) const {
    std::array<StrainRow, Nodes> rows;
    for (int a = 0; a < Nodes; ++a) rows[a] = this->row(gradient, g, point, a);
    this->add_material(half.template topLeftCorner<strains, strains>(), point.weight, rows, tangent.displacements);
    const std::array<int, 2> of_law = {pressure_row, swelling_row};
    for (int i = 0; i < unknowns_.fields(); ++i) {
      const Strain pull = point.weight * half.col(of_law[i]).template head<strains>();
      for (int a = 0; a < Nodes; ++a)
        tangent.coupling.template middleRows<Dim>(a * Dim).middleCols(i * corners_, corners_) +=
            rows[a].transpose() * pull * at_corners_[g].transpose();
      for (int j = 0; j < unknowns_.fields(); ++j)
        tangent.own.block(i * corners_, j * corners_, corners_, corners_) +=
            point.weight * half(of_law[i], of_law[j]) * at_corners_[g] * at_corners_[g].transpose();
    }
  }

  CellBehaviour behaviour_;
  VolumeMeasure measure_;
  int corners_;
  CornerUnknowns unknowns_;
  std::vector<Corners> at_corners_;  ///< shape functions of the corners at each point
};

}  // namespace comma::solver
