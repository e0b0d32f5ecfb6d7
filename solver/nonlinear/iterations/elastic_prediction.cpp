#include "solver/nonlinear/iterations/elastic_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/points/continuum_points.hpp"
#include "solver/fields/stresses/tensor_reader.hpp"

namespace comma::solver {
namespace {

using Eigen::VectorXd;

/// The plastic strain that a unit of the measure stands for under VMIS_ISOT_NL.
constexpr double strain_for_unit = 0.05;

bool hardens_isotropically(Relation relation) {
  return relation == Relation::isotropic_linear || relation == Relation::isotropic_traction ||
         relation == Relation::isotropic_power || relation == Relation::isotropic_nonlinear;
}

/// 3/2 of the product of the deviators of two stresses.
double deviatoric_product(const Vector6d& a, const Vector6d& b) {
  const double mean_a = a.head<3>().mean(), mean_b = b.head<3>().mean();
  return 1.5 * ((a.head<3>().array() - mean_a).matrix().dot((b.head<3>().array() - mean_b).matrix()) +
                2.0 * a.tail<3>().dot(b.tail<3>()));
}

}  // namespace

ElasticPrediction::ElasticPrediction(const StaticProblem& problem, const DofMap& dofs, const Assembler& assembler,
                                     const std::vector<int>& cells, const VectorXd& u)
    : dofs_(dofs),
      elastic_(*problem.model, *problem.materials, *problem.properties, dofs),
      rest_(VectorXd::Zero(dofs.size())) {
  elastic_.set_time(assembler.state().time());
  const ElementField stresses = assembler.stresses(u);
  const ElementField variables = assembler.internal_variables(u);
  const ContinuumPoints continuum(*problem.model);
  if (cells.empty()) {
    for (int cell = 0; cell < problem.model->mesh->cell_count(); ++cell)
      if (continuum.covers(cell)) add_cell(problem, cell, stresses, variables);
  } else {
    for (const int cell : cells)
      if (continuum.covers(cell)) add_cell(problem, cell, stresses, variables);
  }
  if (points_.empty())
    throw Error("missing-cells", "no cell that the path is to control has plasticity",
                "name cells of a body that flows");
}

void ElasticPrediction::add_cell(const StaticProblem& problem, int cell, const ElementField& stresses,
                                 const ElementField& variables) {
  const Mesh& mesh = *problem.model->mesh;
  const CellBehaviour behaviour =
      problem.behaviours ? (*problem.behaviours)[static_cast<std::size_t>(cell)] : CellBehaviour();
  if (!hardens_isotropically(behaviour.relation) || behaviour.kinematics != Kinematics::small ||
      behaviour.restores_hardening) {
    throw Error("unsupported",
                fmt::format("cell {}: an elastic prediction controls von Mises plasticity with isotropic hardening in "
                            "small strains alone, without POST_INCR='REST_ECRO'",
                            mesh.cell_name(cell)),
                "name cells with such a law, or control a displacement (DDL_IMPO, LONG_ARC)");
  }
  const Material& material = *problem.materials->by_cell[static_cast<std::size_t>(cell)];
  const auto& elasticity = std::get<IsotropicElasticity>(*material.elasticity);
  ContinuumPoints continuum(*problem.model);
  const auto& samples = continuum.samples(cell);
  const int cumulated = variables.component("V1");
  const TensorReader stress(stresses, stress_components);
  for (int point = 0; point < stresses.points(cell); ++point) {
    const ContinuumSample& sample = samples[static_cast<std::size_t>(point)];
    const MaterialPoint at =
        continuum.material_point(cell, elastic_.state(), sample, continuum.locate(cell, sample).at, point);
    points_.push_back({static_cast<std::size_t>(cell), point,
                       plastic_point(elasticity, material.plasticity, behaviour.relation, at),
                       behaviour.relation == Relation::isotropic_nonlinear, variables.at(cell, point, cumulated),
                       stress.at(cell, point)});
  }
}

/// The von Mises stress of a prediction with the excess that is wanted.
double ElasticPrediction::limit(const Point& point, double wanted) const {
  if (!point.by_strain) return (1.0 + wanted) * hardening(point.law.curve, point.cumulated).first;
  const double flow = strain_for_unit * wanted;
  return hardening(point.law.curve, point.cumulated + flow).first + 3.0 * point.law.shear * flow;
}

/// Each point admits an interval, in which its prediction stays below the limit: all together admit what these share,
/// and the largest excess is the wanted one at the ends.
std::vector<double> ElasticPrediction::intensities(double wanted, const VectorXd& constant,
                                                   const VectorXd& linear) const {
  const ElementField at_rest = elastic_.stresses(rest_);
  const ElementField by_constant = elastic_.stresses(constant);
  const ElementField by_linear = elastic_.stresses(linear);
  const TensorReader resting(at_rest, stress_components), constant_part(by_constant, stress_components),
      linear_part(by_linear, stress_components);
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  for (const Point& point : points_) {
    const int cell = static_cast<int>(point.cell);
    const Vector6d none = resting.at(cell, point.point);
    const Vector6d a = point.stress + constant_part.at(cell, point.point) - none;
    const Vector6d b = linear_part.at(cell, point.point) - none;
    const double most = limit(point, wanted);
    const double square = deviatoric_product(b, b);
    const double own = deviatoric_product(a, a) - most * most;
    if (!(square > 0.0)) {
      if (own > 0.0) return {};
      continue;
    }
    const double middle = -deviatoric_product(a, b) / square;
    const double apart = middle * middle - own / square;
    if (apart < 0.0) return {};
    low = std::max(low, middle - std::sqrt(apart));
    high = std::min(high, middle + std::sqrt(apart));
  }
  if (!(low <= high) || !std::isfinite(low)) return {};
  return {low, high};
}

}  // namespace comma::solver
