// Making groups of nodes and cells: from each other, by set operations, by where they lie, and in order along a line
// (DEFI_GROUP, U4.22.01). A group is a list of indices, each once.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Their names, in the order of the groups.
std::vector<std::string> names_of(const Groups& groups);

/// All members, in the order in which they first occur.
std::vector<int> union_of(std::span<const std::vector<int>> groups);
/// The members of the first group that are in all others, in the first's order; empty without groups.
std::vector<int> intersection_of(std::span<const std::vector<int>> groups);
/// The members of the first group that are in none of the others, in the first's order; empty without groups.
std::vector<int> difference_of(std::span<const std::vector<int>> groups);

/// Gives each cell group's nodes, rising, as a node group of the same name. A node group that exists already is left as
/// it is; returns the names of those whose members differ from what they would have become.
std::vector<std::string> add_node_groups_of_all_cell_groups(Mesh& mesh);

/// What a node is to its cells.
enum class NodeRole { corner, mid_edge, centre };
/// The nodes of the cells, rising, that play the role in at least one of them; `centre` is the middle of a face or a
/// solid.
std::vector<int> nodes_of_cells(const Mesh& mesh, std::span<const int> cells, NodeRole role);

/// How many of its nodes must be chosen for a cell to be.
enum class NodeCriterion { all, any, majority, corners };
/// The cells of the mesh, rising, whose nodes (`corners`: whose corners, all of them) are among `nodes` as the
/// criterion says.
std::vector<int> cells_on_nodes(const Mesh& mesh, std::span<const int> nodes, NodeCriterion criterion);

/// The face cells (in a plane mesh, which may be one of flat plates: the line cells too) whose normal makes at most
/// `angle` (in radians) with `direction`; `either_sense`: or with its opposite. The normal is that of the corners, by
/// the right-hand rule; a line's is its direction turned by -90 degrees. Error `zero-vector` where the direction has no
/// length.
std::vector<int> cells_with_normal(const Mesh& mesh, const Point& direction, double angle, bool either_sense);

/// Lengths below are in the mesh's unit; `tolerance` is a distance. All return the nodes of the mesh, rising.
/// Error `zero-vector` where a direction has no length.
/// At most `radius` from the centre.
std::vector<int> nodes_in_ball(const Mesh& mesh, const Point& centre, double radius);
/// At most `tolerance` from the sphere's surface.
std::vector<int> nodes_on_sphere(const Mesh& mesh, const Point& centre, double radius, double tolerance);
/// At most `radius` from the axis through `point`.
std::vector<int> nodes_in_cylinder(const Mesh& mesh, const Point& point, const Point& axis, double radius);
/// At most `tolerance` from the cylinder's surface.
std::vector<int> nodes_on_cylinder(const Mesh& mesh, const Point& point, const Point& axis, double radius,
                                   double tolerance);
/// At most `tolerance` from the plane through `point`.
std::vector<int> nodes_on_plane(const Mesh& mesh, const Point& point, const Point& normal, double tolerance);

/// The nodes of line cells in the order in which one passes them, middle nodes between their ends. An open line is
/// walked from `start` to `end`, either of which may be left out (without both: from the end that a cell begins with,
/// the first such in the mesh, else from the first end that a cell ends with, as Code_Aster 17.3 does); a closed one
/// from `start` (else the first node of the first cell) round, its first step the one closer to `direction` (else along
/// the first cell), each node once. Throws Error `not-a-line`: no cells, a cell that is not a line, a fork, several
/// pieces, or a start or end that is not an end of the line.
std::vector<int> nodes_along_line(const Mesh& mesh, std::span<const int> cells, std::optional<int> start = {},
                                  std::optional<int> end = {}, std::optional<Point> direction = {});

/// The first of the nodes at which the way from one to the next turns back (by more than 90 degrees), and does not go
/// along edges of cells before and behind it; none where they follow each other along a line.
std::optional<int> node_out_of_order(const Mesh& mesh, std::span<const int> nodes);
/// Whether three nodes or more lie on a straight line, but for a millionth of its length.
bool lie_on_a_line(const Mesh& mesh, std::span<const int> nodes);

double distance(const Point& a, const Point& b);

/// The nodes sorted by their distance from `start` along the straight line to `end`. Throws Error `not-a-line` naming a
/// node that is more than `tolerance` off that line, `zero-vector` if the two ends coincide.
std::vector<int> nodes_along_segment(const Mesh& mesh, std::span<const int> nodes, int start, int end,
                                     double tolerance);

}  // namespace comma::solver
