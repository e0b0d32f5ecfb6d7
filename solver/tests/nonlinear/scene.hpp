// Small scenes built in code: meshes of rectangles, springs, imposed displacements.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver::testing {

class Scene {
 public:
  Scene();

  int node(const std::string& name, double x, double y);
  int cell(const std::string& name, CellType type, std::vector<int> nodes, Formulation formulation);
  /// Elastic plane-strain cell.
  int solid(const std::string& name, CellType type, std::vector<int> nodes, double young, double poisson);
  /// Edge that bounds a solid on its left: the outward normal is on its right.
  int skin(const std::string& name, int first, int second);
  /// Spring of stiffness k in x and y between two nodes.
  int spring(const std::string& name, int first, int second, double kx, double ky);
  /// Spring to the ground.
  int ground_spring(const std::string& name, int at, double kx, double ky);
  /// The same with any matrix from displacements to forces.
  int ground_spring(const std::string& name, int at, const Eigen::Matrix2d& stiffness);

  /// A rectangle of nx x ny QUAD4 cells of a material.
  struct Block {
    std::vector<std::vector<int>> nodes;  ///< [row][column], from the lower left
    std::vector<int> bottom, top;         ///< skin cells, outward normal below and above
  };
  Block block(const std::string& name, std::array<double, 2> corner, std::array<double, 2> size, int nx, int ny,
              double young, double poisson);

  /// Imposed displacement, value times t when `grows`.
  void impose(const std::vector<int>& nodes, Component component, double value, bool grows = false);
  void force(int node, Component component, double value);
  /// coefficient * u <= bound at the nodes.
  void bound(const std::vector<int>& nodes, Component component, double coefficient, FieldFunction limit);

  ContactZone& zone(std::vector<int> master, std::vector<int> slave);

  /// Solves at t = 0, 1, .., steps.
  const Result& solve(int steps, const NewtonOptions& options = {}, const IterationObserver& observer = {});
  double displacement(int node, Component component, int step = -1) const;
  /// Internal force (FORC_NODA).
  double internal_force(int node, Component component) const;
  double contact(int node, const std::string& component) const;

  StaticProblem problem;
  Result result;
  Counters counters;
  std::shared_ptr<Mesh> mesh;

 private:
  std::shared_ptr<Model> model_;
  std::shared_ptr<MaterialField> materials_;
  std::shared_ptr<ElementProperties> properties_;
  std::shared_ptr<Load> constant_;
  std::shared_ptr<Load> growing_;
};

}  // namespace comma::solver::testing
