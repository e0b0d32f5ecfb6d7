#include "solver/materials/elasticity.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// The two directions behind each component of a strain.
template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

bool all_constant(const std::array<Property, 3>& properties) {
  return properties[0].is_constant() && properties[1].is_constant() && properties[2].is_constant();
}

bool is_zero(const Property& property) { return property.is_constant() && property(MaterialPoint()) == 0.0; }

bool is_zero(const Expansion& expansion) { return is_zero(expansion.coefficient); }

double positive(double modulus, const char* name) {
  if (modulus > 0.0) return modulus;
  throw Error(
      "invalid-material", fmt::format("an orthotropic material has {} = {}, but it must be positive", name, modulus),
      modulus == 0.0 ? fmt::format("give {}: only plane bodies do without E_N (C_PLAN), G_LN and G_TN", name) : "");
}

/// Compliance in the axes L, T, N. Where N does not count, moduli that are absent become those in the plane.
Matrix6d own_compliance(const OrthotropicElasticity& material, const MaterialPoint& at, AcrossPlane across) {
  constexpr std::array<const char*, 3> young_names = {"E_L", "E_T", "E_N"}, shear_names = {"G_LT", "G_LN", "G_TN"};
  Matrix6d compliance = Matrix6d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double young = material.young[i](at);
    const double shear = material.shear[i](at);
    const bool stands_free = i == 2 && across == AcrossPlane::free && young == 0.0;
    compliance(i, i) = stands_free ? 0.0 : 1.0 / positive(young, young_names[i]);
    compliance(3 + i, 3 + i) = i > 0 && across != AcrossPlane::solid && shear == 0.0
                                   ? compliance(3, 3)
                                   : 1.0 / positive(shear, shear_names[i]);
  }
  for (int pair = 0; pair < 3; ++pair) {
    const int i = tensor_row[3 + pair];
    const int j = tensor_column[3 + pair];
    compliance(i, j) = compliance(j, i) = -material.poisson[pair](at) * compliance(i, i);
  }
  if (compliance(2, 2) == 0.0) {
    const Eigen::Vector2d drawn = compliance.block<2, 1>(0, 2);
    compliance(2, 2) = compliance(0, 0) + 2.0 * drawn.dot(compliance.topLeftCorner<2, 2>().inverse() * drawn);
  }
  return compliance;
}

Matrix6d own_stiffness(const OrthotropicElasticity& material, const MaterialPoint& at, AcrossPlane across) {
  const Eigen::LLT<Matrix6d> factor(own_compliance(material, at, across));
  if (factor.info() != Eigen::Success) {
    throw Error("invalid-material", "the constants of an orthotropic material give negative strain energy",
                "the coefficients NU are too large beside the ratios of the moduli");
  }
  return factor.solve(Matrix6d::Identity());
}

Eigen::Vector3d own_expansion(const OrthotropicElasticity& material, const MaterialPoint& at) {
  Eigen::Vector3d strain;
  for (int i = 0; i < 3; ++i) strain[i] = thermal_strain(material.expansion[i], at);
  return strain;
}

/// The strain that is known beforehand, with shear angles; zero where none is given.
Vector6d given_strain(const MaterialPoint& at) {
  Vector6d strain = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    const double component = at[strain_parameters[static_cast<std::size_t>(i)]];
    if (!std::isnan(component)) strain[i] = i < 3 ? component : 2.0 * component;
  }
  return strain;
}

double shrinkage(const IsotropicElasticity& material, const MaterialPoint& at) {
  double strain = 0.0;
  const double drying = at[Parameter::drying];
  if (!is_zero(material.drying_shrinkage) && !std::isnan(drying)) {
    if (std::isnan(at.reference(Parameter::drying))) {
      throw Error("missing-reference", "a field of drying is given without its reference value");
    }
    strain += material.drying_shrinkage(at) * (drying - at.reference(Parameter::drying));
  }
  const double hydration = at[Parameter::hydration];
  if (!is_zero(material.hydration_shrinkage) && !std::isnan(hydration))
    strain -= material.hydration_shrinkage(at) * hydration;
  return strain;
}

/// The same along every direction.
double expansion(const IsotropicElasticity& material, const MaterialPoint& at) {
  return thermal_strain(material.expansion, at) + shrinkage(material, at);
}

}  // namespace

OrthotropicElasticity as_orthotropic(const TransverseElasticity& material) {
  const Property shear_in_plane([young = material.young, poisson = material.poisson](const MaterialPoint& at) {
    return young(at) / (2 * (1 + poisson(at)));
  });
  const bool constant = material.young.is_constant() && material.poisson.is_constant();
  OrthotropicElasticity result;
  result.young = {material.young, material.young, material.young_normal};
  result.poisson = {material.poisson, material.poisson_normal, material.poisson_normal};
  result.shear = {constant ? Property(shear_in_plane(MaterialPoint())) : shear_in_plane, material.shear_normal,
                  material.shear_normal};
  result.density = material.density;
  result.expansion = {material.expansion, material.expansion, material.expansion_normal};
  return result;
}

void check_elasticity(const IsotropicModuli& material) {
  if (!(material.young > 0.0) || !std::isfinite(material.young)) {
    throw Error("invalid-material", fmt::format("Young's modulus is {}, but it must be positive", material.young));
  }
  if (!(material.poisson > -1.0 && material.poisson <= 0.5))
    throw Error("invalid-material",
                fmt::format("Poisson's ratio is {}, but it must lie between -1 and 0.5", material.poisson));
}

void require_compressible(double poisson) {
  if (poisson < 0.5) return;
  throw Error("invalid-material",
              "Poisson's ratio is 0.5: such a body keeps its volume, and its stresses do not follow from strains alone",
              "0.499999999 with INCO_UP or INCO_UPG is that to nine digits (elements of displacements alone lock above "
              "0.49); 0.5 itself goes with elastic plane stress, plates, beams and bars");
}

Matrix6d solid_stiffness(const IsotropicModuli& material) {
  require_compressible(material.poisson);
  const double mu = material.young / (2 * (1 + material.poisson));
  const double lambda = material.young * material.poisson / ((1 + material.poisson) * (1 - 2 * material.poisson));
  Matrix6d stiffness = Matrix6d::Zero();
  stiffness.topLeftCorner<3, 3>().setConstant(lambda);
  stiffness.diagonal().head<3>().array() += 2 * mu;
  stiffness.diagonal().tail<3>().setConstant(mu);
  return stiffness;
}

Eigen::Matrix4d plane_strain_stiffness(const IsotropicModuli& material) {
  return solid_stiffness(material).topLeftCorner<4, 4>();
}

Eigen::Matrix4d plane_stress_stiffness(const IsotropicModuli& material) {
  const double direct = material.young / (1 - material.poisson * material.poisson);
  Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();
  stiffness(0, 0) = stiffness(1, 1) = direct;
  stiffness(0, 1) = stiffness(1, 0) = direct * material.poisson;
  stiffness(3, 3) = material.young / (2 * (1 + material.poisson));
  return stiffness;
}

bool is_constant(const Elasticity& elasticity) {
  return std::visit(
      Overloaded{[](const IsotropicElasticity& m) { return m.young.is_constant() && m.poisson.is_constant(); },
                 [](const OrthotropicElasticity& m) {
                   return all_constant(m.young) && all_constant(m.poisson) && all_constant(m.shear);
                 }},
      elasticity);
}

bool expands(const Elasticity& elasticity) {
  return std::visit(
      Overloaded{[](const IsotropicElasticity& m) {
                   return !is_zero(m.expansion) || !is_zero(m.drying_shrinkage) || !is_zero(m.hydration_shrinkage);
                 },
                 [](const OrthotropicElasticity& m) {
                   return !is_zero(m.expansion[0]) || !is_zero(m.expansion[1]) || !is_zero(m.expansion[2]);
                 }},
      elasticity);
}

double density(const Elasticity& elasticity, const MaterialPoint& at) {
  return std::visit([&](const auto& material) { return material.density(at); }, elasticity);
}

IsotropicModuli moduli(const IsotropicElasticity& elasticity, const MaterialPoint& at) {
  const IsotropicModuli result{elasticity.young(at), elasticity.poisson(at)};
  check_elasticity(result);
  return result;
}

Matrix6d solid_stiffness(const CellMaterial& material, const MaterialPoint& at) {
  if (const auto* isotropic = std::get_if<IsotropicElasticity>(material.elasticity))
    return solid_stiffness(moduli(*isotropic, at));
  const Matrix6d own = own_stiffness(std::get<OrthotropicElasticity>(*material.elasticity), at, material.across);
  if (material.axes == nullptr) return own;
  const Matrix6d turn = strain_rotation(*material.axes);
  const Matrix6d stiffness = turn.transpose() * own * turn;
  return 0.5 * (stiffness + stiffness.transpose());
}

Eigen::Matrix4d plane_strain_stiffness(const CellMaterial& material, const MaterialPoint& at) {
  return solid_stiffness(material, at).topLeftCorner<4, 4>();
}

Eigen::Matrix4d plane_stress_stiffness(const CellMaterial& material, const MaterialPoint& at) {
  if (const auto* isotropic = std::get_if<IsotropicElasticity>(material.elasticity)) {
    return plane_stress_stiffness(moduli(*isotropic, at));
  }
  const Eigen::Matrix4d solid = plane_strain_stiffness(material, at);
  Eigen::Matrix4d stiffness = solid - solid.col(2) * solid.row(2) / solid(2, 2);
  stiffness.row(2).setZero();
  stiffness.col(2).setZero();
  return stiffness;
}

Matrix6d solid_compliance(const CellMaterial& material, const MaterialPoint& at) {
  if (const auto* isotropic = std::get_if<IsotropicElasticity>(material.elasticity)) {
    const IsotropicModuli m = moduli(*isotropic, at);
    Matrix6d compliance = Matrix6d::Zero();
    compliance.topLeftCorner<3, 3>().setConstant(-m.poisson / m.young);
    compliance.diagonal().head<3>().setConstant(1 / m.young);
    compliance.diagonal().tail<3>().setConstant(2 * (1 + m.poisson) / m.young);
    return compliance;
  }
  const Matrix6d own = own_compliance(std::get<OrthotropicElasticity>(*material.elasticity), at, material.across);
  if (material.axes == nullptr) return own;
  const Matrix6d turn = strain_rotation(material.axes->transpose());
  return turn * own * turn.transpose();
}

Matrix6d strain_rotation(const Eigen::Matrix3d& axes) {
  Matrix6d rotation;
  for (int row = 0; row < 6; ++row) {
    const int i = tensor_row[row];
    const int j = tensor_column[row];
    for (int column = 0; column < 6; ++column) {
      const int a = tensor_row[column];
      const int b = tensor_column[column];
      const double share = a == b ? axes(i, a) * axes(j, a) : 0.5 * (axes(i, a) * axes(j, b) + axes(i, b) * axes(j, a));
      rotation(row, column) = i == j ? share : 2 * share;
    }
  }
  return rotation;
}

double thermal_strain(const Expansion& expansion, const MaterialPoint& at) {
  const double temperature = at[Parameter::temperature];
  if (std::isnan(temperature) || is_zero(expansion)) return 0.0;
  const double reference = at.reference(Parameter::temperature);
  if (std::isnan(reference)) throw Error("missing-reference", "a temperature is given without its reference value");
  const auto& [coefficient, measured_from] = expansion;
  if (std::isnan(measured_from)) return coefficient(at) * (temperature - reference);
  MaterialPoint at_reference = at;
  at_reference[Parameter::temperature] = reference;
  return coefficient(at) * (temperature - measured_from) - coefficient(at_reference) * (reference - measured_from);
}

double inelastic_axial_strain(const IsotropicElasticity& material, const MaterialPoint& at) {
  if (!given_strain(at).isZero(0.0)) {
    throw Error("unsupported",
                "a strain that is known beforehand (EPSA) is given to a bar, beam or plate, but only solids and plane "
                "bodies take it up",
                "give it to the cells of the continuum alone");
  }
  return expansion(material, at);
}

Vector6d inelastic_strain(const CellMaterial& material, const MaterialPoint& at) {
  Vector6d strain = Vector6d::Zero();
  if (const auto* isotropic = std::get_if<IsotropicElasticity>(material.elasticity)) {
    strain.head<3>().setConstant(expansion(*isotropic, at));
  } else {
    strain.head<3>() = own_expansion(std::get<OrthotropicElasticity>(*material.elasticity), at);
    if (material.axes != nullptr) strain = (strain_rotation(material.axes->transpose()) * strain).eval();
  }
  return strain + given_strain(at);
}

}  // namespace comma::solver
