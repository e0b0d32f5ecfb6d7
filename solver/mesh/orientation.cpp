#include "solver/mesh/orientation.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <iterator>

#include "solver/error.hpp"
#include "solver/mesh/boundary.hpp"

namespace comma::solver {
namespace {

/// Below this part of the cube of its longest edge (of the square, for a face) a cell counts as flat: its two sides are
/// then a matter of rounding. Far below any cell that an element could use.
constexpr double flatness = 1e-12;

std::string described(const Mesh& mesh, int cell) {
  return fmt::format("{} {}", name_of(mesh.cell_types[cell]), mesh.cell_name(cell));
}

double longest_edge(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  const int corners = corner_count(mesh.cell_types[cell]);
  double longest = 0.0;
  for (int i = 0; i < corners; ++i) {
    for (int j = 0; j < i; ++j) {
      const Eigen::Vector3d a(mesh.nodes[nodes[i]].data());
      const Eigen::Vector3d b(mesh.nodes[nodes[j]].data());
      longest = std::max(longest, (a - b).norm());
    }
  }
  return longest;
}

/// Whether the facets of the cell, as boundary_facets() lists them, really point outwards: they do not when the nodes
/// of the cell run in the other sense, as meshers write them now and then.
bool runs_in_reference_sense(const Mesh& mesh, int cell) {
  const double size = signed_size(mesh, cell);
  const double length = longest_edge(mesh, cell);
  const bool solid = dimension(mesh.cell_types[cell]) == 3;
  if (std::abs(size) > flatness * (solid ? length * length * length : length * length)) return size > 0.0;
  throw Error("flat-cell", fmt::format("{} is flat{}, so the skin on it has no outer side", described(mesh, cell),
                                       solid ? "" : " or stands upright on the xy plane"));
}

/// Whether `nodes`, the corners of a skin cell, run round the facet in the facet's own sense.
bool same_sense(std::span<const int> nodes, std::span<const int> facet_nodes, int corners) {
  if (corners == 2) return nodes[0] == facet_nodes[0];
  const auto first = std::ranges::find(facet_nodes.first(static_cast<std::size_t>(corners)), nodes[0]);
  const auto next = (first - facet_nodes.begin() + 1) % corners;
  return facet_nodes[static_cast<std::size_t>(next)] == nodes[1];
}

std::span<int> nodes_of(Mesh& mesh, int cell) {
  return std::span(mesh.connectivity)
      .subspan(static_cast<std::size_t>(mesh.cell_starts[cell]),
               static_cast<std::size_t>(node_count(mesh.cell_types[cell])));
}

/// Turns a line or face cell round. The corners of a face are taken in the opposite order, the last one first, as
/// Code_Aster does: the reference cell of a triangle is not alike in all corners, and contact brings points that fall
/// beside a face back within it; the first edge gives principal directions in a skin their signs
/// (surface_stresses.hpp).
void reverse(std::span<int> nodes, CellType type) {
  const int corners = corner_count(type);
  if (dimension(type) == 1) {
    std::swap(nodes[0], nodes[1]);
    if (type == CellType::seg4) std::swap(nodes[2], nodes[3]);
    return;
  }
  const bool quadratic = node_count(type) >= 2 * corners;
  std::reverse(nodes.begin(), nodes.begin() + corners);
  if (quadratic) std::reverse(nodes.begin() + corners, nodes.begin() + 2 * corners - 1);
}

/// Of `support`, or of all cells of one dimension more than one of the skin: those that may have a facet of the skin,
/// whose corners are among its nodes.
std::vector<int> cells_behind(const Mesh& mesh, std::span<const int> skin, std::span<const int> support) {
  std::array<bool, 4> wanted{};
  std::vector<bool> is_of_skin(static_cast<std::size_t>(mesh.node_count()), false);
  for (const int cell : skin) {
    wanted[static_cast<std::size_t>(dimension(mesh.cell_types[cell]))] = true;
    for (const int node : mesh.cell(cell)) is_of_skin[static_cast<std::size_t>(node)] = true;
  }
  const auto touches = [&](int cell) {
    const int least = dimension(mesh.cell_types[cell]);  // corners of its smallest facet
    return std::ranges::count_if(mesh.cell(cell),
                                 [&](int node) { return is_of_skin[static_cast<std::size_t>(node)]; }) >= least;
  };
  std::vector<int> behind;
  const auto take = [&](int cell) {
    if (touches(cell)) behind.push_back(cell);
  };
  if (!support.empty()) {
    std::ranges::for_each(support, take);
    return behind;
  }
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const int below = dimension(mesh.cell_types[cell]) - 1;
    if (below >= 1 && wanted[static_cast<std::size_t>(below)]) take(cell);
  }
  return behind;
}

FacetMap facets_behind(const Mesh& mesh, std::span<const int> skin, std::span<const int> support = {}) {
  return map_facets(mesh, cells_behind(mesh, skin, support));
}

CellFacet support_of(const Mesh& mesh, int cell, const FacetMap& facets) {
  const auto found = facets.find(facet_key(mesh, cell));
  if (found == facets.end()) {
    throw Error("skin-without-support", fmt::format("{} bounds no cell", described(mesh, cell)),
                "the skin's nodes must be those of a face of a volume cell, or of an edge of a plane cell");
  }
  if (found->second.size() > 1) {
    throw Error("skin-inside-body",
                fmt::format("{} lies between {} and {}, so it has no outer side", described(mesh, cell),
                            described(mesh, found->second[0].cell), described(mesh, found->second[1].cell)),
                "say which of the bodies the skin belongs to");
  }
  return found->second.front();
}

/// Whether the normal of a skin cell points into the cell behind it.
bool points_inwards(const Mesh& mesh, int cell, const CellFacet& behind) {
  const int corners = corner_count(mesh.cell_types[cell]);
  const bool as_listed = same_sense(mesh.cell(cell), nodes_of_facet(mesh, behind), corners);
  return as_listed != runs_in_reference_sense(mesh, behind.cell);
}

}  // namespace

void turn_skin_cell(Mesh& mesh, int cell) { reverse(nodes_of(mesh, cell), mesh.cell_types[cell]); }

void turn_sheet_cell(Mesh& mesh, int cell) {
  const CellType type = mesh.cell_types[cell];
  const auto nodes = nodes_of(mesh, cell);
  if (dimension(type) == 1) return reverse(nodes, type);
  const int corners = corner_count(type);
  std::reverse(nodes.begin() + 1, nodes.begin() + corners);
  if (node_count(type) >= 2 * corners) std::reverse(nodes.begin() + corners, nodes.begin() + 2 * corners);
}

namespace {

void require_no_solids(const Mesh& mesh, std::span<const int> skin) {
  for (const int cell : skin)
    if (dimension(mesh.cell_types[static_cast<std::size_t>(cell)]) == 3)
      throw Error("wrong-cell",
                  fmt::format("the group holds the solid cell {} ({}), which is no skin", mesh.cell_name(cell),
                              name_of(mesh.cell_types[static_cast<std::size_t>(cell)])),
                  "name a group of the faces alone (DEFI_GROUP, CREA_GROUP_MA with TYPE_MAILLE='2D')");
}

}  // namespace

int orient_skin(Mesh& mesh, std::span<const int> skin, std::span<const int> support) {
  require_no_solids(mesh, skin);
  const FacetMap facets = facets_behind(mesh, skin, support);
  int turned = 0;
  for (const int cell : skin) {
    if (!points_inwards(mesh, cell, support_of(mesh, cell, facets))) continue;
    turn_skin_cell(mesh, cell);
    ++turned;
  }
  return turned;
}

std::vector<int> loose_skin(const Mesh& mesh, std::span<const int> skin, std::span<const int> support) {
  require_no_solids(mesh, skin);
  const FacetMap facets = facets_behind(mesh, skin, support);
  std::vector<int> loose;
  std::ranges::copy_if(skin, std::back_inserter(loose),
                       [&](int cell) { return !facets.contains(facet_key(mesh, cell)); });
  return loose;
}

std::vector<int> inward_skin(const Mesh& mesh, std::span<const int> skin) {
  const FacetMap facets = facets_behind(mesh, skin);
  std::vector<int> inward;
  for (const int cell : skin) {
    const auto found = facets.find(facet_key(mesh, cell));
    if (found == facets.end() || found->second.size() != 1) continue;
    if (points_inwards(mesh, cell, found->second.front())) inward.push_back(cell);
  }
  return inward;
}

}  // namespace comma::solver
