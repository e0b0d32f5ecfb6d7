#include "solver/loads/plate_moments.hpp"

#include "solver/elements/cell_quadrature.hpp"

namespace comma::solver {

namespace {

/// Where a function is taken and with which weight.
struct Share {
  Point at;
  double weight;
};

FieldFunction summed(const FieldFunction& function, std::vector<Share> shares) {
  return [function, shares = std::move(shares)](const Point&, double time) {
    double sum = 0.0;
    for (const Share& share : shares) sum += share.weight * function(share.at, time);
    return sum;
  };
}

}  // namespace

std::vector<NodalForce> plate_moment_forces(const Mesh& mesh, const PlateMoment& load) {
  constexpr std::array<Component, 3> rotations = {Component::drx, Component::dry, Component::drz};
  const auto nodes = mesh.cell(load.cell);
  CellSamples samples;
  std::vector<std::vector<Share>> shares(nodes.size());
  for (const CellSample& sample : samples.of(mesh.cell_types[static_cast<std::size_t>(load.cell)], CellRole::skin)) {
    const CellPoint point = locate(mesh, load.cell, sample);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      shares[a].push_back(
          {{point.at[0], point.at[1], point.at[2]},
           sample.weight * point.measure(dimension(mesh.cell_types[static_cast<std::size_t>(load.cell)])) *
               sample.values[static_cast<Eigen::Index>(a)]});
  }
  std::vector<NodalForce> forces;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    double area = 0.0;
    for (const Share& share : shares[a]) area += share.weight;
    for (std::size_t c = 0; c < rotations.size(); ++c) {
      if (load.functions[c]) {
        forces.push_back({nodes[a], rotations[c], 0.0, summed(load.functions[c], shares[a])});
      } else if (load.moment[c] != 0.0) {
        forces.push_back({nodes[a], rotations[c], area * load.moment[c], {}});
      }
    }
  }
  return forces;
}

}  // namespace comma::solver
