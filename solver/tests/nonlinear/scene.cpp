#include "scene.hpp"

#include <utility>

#include "solver/elements/assembler.hpp"

namespace comma::solver::testing {

Scene::Scene()
    : mesh(std::make_shared<Mesh>()),
      model_(std::make_shared<Model>()),
      materials_(std::make_shared<MaterialField>()),
      properties_(std::make_shared<ElementProperties>()),
      constant_(std::make_shared<Load>()),
      growing_(std::make_shared<Load>()) {
  mesh->dimension = 2;
  model_->mesh = mesh;
  problem.model = model_;
  problem.materials = materials_;
  problem.properties = properties_;
  problem.loads = {{constant_, {}}, {growing_, [](double t) { return t; }}};
}

int Scene::node(const std::string& name, double x, double y) {
  mesh->nodes.push_back({x, y, 0.0});
  mesh->node_names.push_back(name);
  return mesh->node_count() - 1;
}

int Scene::cell(const std::string& name, CellType type, std::vector<int> nodes, Formulation formulation) {
  const int index = mesh->add_cell(type, nodes);
  mesh->cell_names.resize(static_cast<std::size_t>(index));
  mesh->cell_names.push_back(name);
  model_->formulations.push_back(formulation);
  materials_->by_cell.push_back(nullptr);
  return index;
}

int Scene::solid(const std::string& name, CellType type, std::vector<int> nodes, double young, double poisson) {
  const int index = cell(name, type, std::move(nodes), Formulation::plane_strain);
  Material material;
  material.elasticity = IsotropicElasticity{.young = young, .poisson = poisson};
  materials_->by_cell[index] = std::make_shared<const Material>(material);
  return index;
}

int Scene::skin(const std::string& name, int first, int second) {
  return cell(name, CellType::seg2, {first, second}, Formulation::plane_strain);
}

int Scene::spring(const std::string& name, int first, int second, double kx, double ky) {
  const int index = cell(name, CellType::seg2, {first, second}, Formulation::spring_2d);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(4, 4);
  const Eigen::Matrix2d own = Eigen::Vector2d(kx, ky).asDiagonal();
  k << own, -own, -own, own;
  properties_->discrete[index] = DiscreteStiffness{k};
  return index;
}

int Scene::ground_spring(const std::string& name, int at, double kx, double ky) {
  return ground_spring(name, at, Eigen::Vector2d(kx, ky).asDiagonal().toDenseMatrix());
}

int Scene::ground_spring(const std::string& name, int at, const Eigen::Matrix2d& stiffness) {
  const int index = cell(name, CellType::poi1, {at}, Formulation::spring_2d);
  properties_->discrete[index] = DiscreteStiffness{stiffness};
  return index;
}

Scene::Block Scene::block(const std::string& name, std::array<double, 2> corner, std::array<double, 2> size, int nx,
                          int ny, double young, double poisson) {
  Block made;
  for (int j = 0; j <= ny; ++j) {
    std::vector<int> row;
    for (int i = 0; i <= nx; ++i)
      row.push_back(node(name + std::to_string(i) + "_" + std::to_string(j), corner[0] + size[0] * i / nx,
                         corner[1] + size[1] * j / ny));
    made.nodes.push_back(std::move(row));
  }
  const auto& n = made.nodes;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      solid(name + "q" + std::to_string(i) + "_" + std::to_string(j), CellType::quad4,
            {n[j][i], n[j][i + 1], n[j + 1][i + 1], n[j + 1][i]}, young, poisson);
  for (int i = 0; i < nx; ++i) {
    made.bottom.push_back(skin(name + "b" + std::to_string(i), n[0][i], n[0][i + 1]));
    made.top.push_back(skin(name + "t" + std::to_string(i), n[ny][i + 1], n[ny][i]));
  }
  return made;
}

void Scene::impose(const std::vector<int>& nodes, Component component, double value, bool grows) {
  for (const int at : nodes) {
    LinearRelation relation;
    relation.terms = {{at, component, 1.0}};
    relation.value = value;
    relation.origin = std::make_shared<const std::string>("imposed in the scene");
    (grows ? growing_ : constant_)->relations.push_back(relation);
  }
}

void Scene::force(int at, Component component, double value) {
  NodalForce load;
  load.node = at;
  load.component = component;
  load.value = value;
  constant_->nodal_forces.push_back(load);
}

void Scene::bound(const std::vector<int>& nodes, Component component, double coefficient, FieldFunction limit) {
  UnilateralCondition condition;
  condition.nodes = nodes;
  condition.components = {component};
  condition.coefficients = {[coefficient](const Point&, double) { return coefficient; }};
  condition.bound = std::move(limit);
  problem.unilateral.push_back(condition);
}

ContactZone& Scene::zone(std::vector<int> master, std::vector<int> slave) {
  if (!problem.contact) problem.contact.emplace();
  ContactZone zone;
  zone.master_cells = std::move(master);
  zone.slave_cells = std::move(slave);
  problem.contact->zones.push_back(std::move(zone));
  return problem.contact->zones.back();
}

const Result& Scene::solve(int steps, const NewtonOptions& options, const IterationObserver& observer) {
  std::vector<double> instants;
  for (int t = 0; t <= steps; ++t) instants.push_back(t);
  solve_static(problem, instants, options, result, counters, observer);
  return result;
}

double Scene::displacement(int at, Component component, int step) const {
  const ResultStep& chosen = step < 0 ? result.steps.back() : result.steps[static_cast<std::size_t>(step)];
  const auto& field = std::get<NodalField>(chosen.fields.at("DEPL"));
  return field.at(at, field.component(name_of(component)));
}

double Scene::internal_force(int at, Component component) const {
  const DofMap dofs(*model_);
  const Assembler assembler(*model_, *materials_, *properties_, dofs);
  Eigen::VectorXd u(dofs.size());
  for (int dof = 0; dof < dofs.size(); ++dof) u[dof] = displacement(dofs.node_of(dof), dofs.component_of(dof));
  return assembler.internal_forces(u)[dofs.dof(at, component)];
}

double Scene::contact(int at, const std::string& component) const {
  const auto& field = std::get<NodalField>(result.steps.back().fields.at("CONT_NOEU"));
  return field.at(at, field.component(component));
}

}  // namespace comma::solver::testing
