#include "solver/constraints/rigid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solver/constraints/rigid_modes.hpp"
#include "solver/linear/equilibration.hpp"
#include "solver/mesh/disjoint_sets.hpp"

namespace comma::solver {

namespace {

constexpr int default_digits = 8;
constexpr std::size_t most_nodes_shown = 6;
constexpr std::size_t most_dofs_shown = 4;
/// Entries of a null vector below this part of its largest belong to nodes that follow rather than move.
constexpr double moving = 1e-3;
/// A motion is held by something if it takes more energy than rounding makes: this for each unknown, relative to the
/// stiffness.
constexpr double rounding = 1e-14;

/// The connected parts of the reduced unknowns: coupled by stiffness, or moving the same node (directly or by
/// conditions).
std::vector<std::vector<int>> parts_of(const DofMap& dofs, const Elimination& elimination,
                                       const SymmetricMatrix& stiffness) {
  const int n = static_cast<int>(stiffness.rows());
  DisjointSets sets(n);
  std::vector<int> unknown_of_node(dofs.node_count(), -1);
  for (int column = 0; column < n; ++column) {
    for (SymmetricMatrix::InnerIterator entry(stiffness, column); entry; ++entry) {
      if (entry.value() != 0.0) sets.join(static_cast<int>(entry.row()), column);
    }
    for (Eigen::SparseMatrix<double>::InnerIterator entry(elimination.transformation(), column); entry; ++entry) {
      int& first = unknown_of_node[dofs.node_of(static_cast<int>(entry.row()))];
      if (first < 0) first = column;
      sets.join(first, column);
    }
  }
  std::vector<std::vector<int>> parts(n);
  for (int i = 0; i < n; ++i) parts[sets.root(i)].push_back(i);
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  return parts;
}

std::string remedy_for(const std::vector<RigidMotion>& motions) {
  std::vector<std::string> components;
  bool oblique = false;
  int rotations = 0;
  for (const RigidMotion& motion : motions) {
    if (motion.is_rotation()) {
      ++rotations;
      continue;
    }
    const std::string text = motion.text(3);
    const char axis = text.back();
    if (axis >= 'X' && axis <= 'Z')
      components.push_back(std::string("D") + axis);
    else
      oblique = true;
  }
  std::vector<std::string> wanted;
  if (!components.empty())
    wanted.push_back(fmt::format("impose {} on one of its nodes", fmt::join(components, " and ")));
  if (oblique) wanted.push_back("impose a displacement along its direction of motion on one of its nodes");
  if (rotations > 0) {
    wanted.push_back(fmt::format("impose {} on nodes away from the {} of rotation",
                                 rotations == 1 ? "a displacement" : fmt::format("{} displacements", rotations),
                                 rotations == 1 ? "axis" : "axes"));
  }
  return fmt::format("{}, or add {}", fmt::join(wanted, " and "), motions.size() == 1 ? "a spring" : "springs");
}

std::string weakness_remedy(double tolerance) {
  return fmt::format(
      "; or, if the supports are that weak or the body that slender on purpose, let pivots lose more than {:.0f} "
      "digits",
      1.0 - std::log10(tolerance));
}

/// The null vector of a part by inverse iteration on the equilibrated matrix, as a displacement of all degrees of
/// freedom.
Eigen::VectorXd null_vector(const Elimination& elimination, const SymmetricMatrix& stiffness,
                            std::span<const int> unknowns) {
  constexpr double shift = 1e-12;  // keeps the factors finite; far below any eigenvalue that is not null
  constexpr int iterations = 4;
  const Eigen::VectorXd factors = equilibration_factors(stiffness);
  Eigen::SimplicialLDLT<SymmetricMatrix, Eigen::Lower> factorisation;
  factorisation.setShift(shift);
  factorisation.compute(scaled(stiffness, factors));
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(stiffness.rows());
  // Irregular, so that it is orthogonal to no motion; zero on other parts, which it therefore never reaches.
  for (const int unknown : unknowns) vector[unknown] = 1.0 + std::sin(1.7 * unknown);
  for (int k = 0; k < iterations; ++k) vector = factorisation.solve(vector).normalized();
  return elimination.transformation() * vector.cwiseProduct(factors);
}

FreePart mechanism(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& motion) {
  FreePart part;
  part.rigid = false;
  std::vector<int> order(motion.size());
  std::iota(order.begin(), order.end(), 0);
  const double largest = motion.lpNorm<Eigen::Infinity>();
  // Mirror images differ by rounding; the numbering decides then.
  const auto size = [&](int dof) { return std::llround(std::abs(motion[dof]) / (moving * largest)); };
  if (largest > 0.0) std::ranges::stable_sort(order, std::ranges::greater(), size);
  std::set<int> nodes;
  std::vector<std::string> names;
  for (const int dof : order) {
    if (!(std::abs(motion[dof]) > moving * largest)) continue;
    nodes.insert(dofs.node_of(dof));
    if (names.size() < most_dofs_shown) {
      names.push_back(fmt::format("{} at {}", name_of(dofs.component_of(dof)), mesh.node_name(dofs.node_of(dof))));
    }
  }
  part.nodes.assign(nodes.begin(), nodes.end());
  part.motions.push_back(fmt::format("a motion without resistance that is largest in {}", fmt::join(names, ", ")));
  part.remedy = names.empty() ? "add a spring" : fmt::format("hold {}, or add a spring there", names.front());
  return part;
}

std::string describe(const FreePart& part, const Mesh& mesh) {
  std::vector<std::string> names;
  for (const int node : part.nodes) {
    if (names.size() == most_nodes_shown) break;
    names.push_back(mesh.node_name(node));
  }
  if (part.nodes.size() > names.size()) names.push_back("...");
  const std::string count = part.nodes.size() == 1 ? "1 node" : fmt::format("{} nodes", part.nodes.size());
  return fmt::format("{} holds {} ({}): {}", part.held_weakly ? "hardly anything" : "nothing", fmt::join(names, ", "),
                     count, fmt::join(part.motions, ", "));
}

/// The stiffness (its lower triangle) with one as large as the largest of the translations against each of the rows, as
/// far as these move the unknowns: what else they move stays where it is.
SymmetricMatrix held_by(const RowMatrix& rows, std::span<const int> unknowns, const SymmetricMatrix& stiffness,
                        const DofMap& dofs, const Elimination& elimination) {
  std::vector<char> moves(static_cast<std::size_t>(stiffness.rows()), 0);
  for (const int unknown : unknowns) moves[static_cast<std::size_t>(unknown)] = 1;
  const Eigen::VectorXd diagonal = stiffness.diagonal();
  double largest = 0.0;
  for (const int unknown : unknowns)
    if (!is_rotation(dofs.component_of(elimination.kept()[static_cast<std::size_t>(unknown)])))
      largest = std::max(largest, diagonal[unknown]);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row < rows.outerSize(); ++row)
    for (RowMatrix::InnerIterator it(rows, row); it; ++it)
      if (moves[static_cast<std::size_t>(it.col())])
        entries.emplace_back(static_cast<int>(row), static_cast<int>(it.col()), it.value());
  SymmetricMatrix own(rows.rows(), stiffness.rows());
  own.setFromTriplets(entries.begin(), entries.end());
  const SymmetricMatrix products = SymmetricMatrix(own.transpose()) * own;
  const SymmetricMatrix lower = products.triangularView<Eigen::Lower>();
  return stiffness + largest * lower;
}

}  // namespace

std::vector<FreePart> find_free_parts(const Mesh& mesh, const DofMap& dofs, const Elimination& elimination,
                                      const SymmetricMatrix& reduced_stiffness, std::span<const int> null_rows,
                                      int singular_digits, const RowMatrix* held) {
  // One digit of leave: the energy weighs a support differently than a pivot does.
  const double tolerance = std::pow(10.0, 1 - (singular_digits < 0 ? default_digits : singular_digits));
  const std::set<int> suspects(null_rows.begin(), null_rows.end());
  std::vector<FreePart> result;
  for (const std::vector<int>& unknowns : parts_of(dofs, elimination, reduced_stiffness)) {
    const bool suspect = std::any_of(unknowns.begin(), unknowns.end(), [&](int row) { return suspects.contains(row); });
    if (!suspect && !suspects.empty()) continue;
    if (result.size() == most_free_parts) break;
    auto motions = free_rigid_motions(mesh, dofs, elimination, reduced_stiffness, unknowns, tolerance);
    if (held != nullptr && !motions.empty())
      motions = free_rigid_motions(mesh, dofs, elimination,
                                   held_by(*held, unknowns, reduced_stiffness, dofs, elimination), unknowns, tolerance);
    if (motions.empty()) {
      if (suspect && held == nullptr)
        result.push_back(mechanism(mesh, dofs, null_vector(elimination, reduced_stiffness, unknowns)));
      continue;
    }
    FreePart part;
    part.nodes = nodes_moved(dofs, elimination, unknowns);
    for (const RigidMotion& motion : motions) part.motions.push_back(motion.text(mesh.dimension));
    part.remedy = remedy_for(motions);
    const double noise = rounding * static_cast<double>(unknowns.size());
    part.held_weakly =
        free_rigid_motions(mesh, dofs, elimination, reduced_stiffness, unknowns, noise).size() < motions.size();
    if (part.held_weakly) part.remedy += weakness_remedy(tolerance);
    result.push_back(std::move(part));
  }
  return result;
}

std::string describe(std::span<const FreePart> parts, const Mesh& mesh) {
  std::vector<std::string> texts;
  for (const FreePart& part : parts) texts.push_back(describe(part, mesh));
  return fmt::format("{}", fmt::join(texts, "; "));
}

Error singular_matrix_error(const Mesh& mesh, const DofMap& dofs, const Elimination& elimination,
                            const SymmetricMatrix& reduced_stiffness, const FactorReport& report, int singular_digits) {
  const std::vector<FreePart> parts =
      find_free_parts(mesh, dofs, elimination, reduced_stiffness, report.null_rows, singular_digits);
  if (parts.empty()) {
    return Error("singular-matrix",
                 fmt::format("the stiffness is singular: {} unknowns have no stiffness", report.null_rows.size()),
                 "look for nodes that no element and no condition holds");
  }
  return Error("singular-matrix", "the stiffness is singular: " + describe(parts, mesh), parts.front().remedy);
}

}  // namespace comma::solver
