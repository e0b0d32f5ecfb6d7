#include "solver/mesh/slave_cut.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "solver/error.hpp"
#include "solver/mesh/boundary.hpp"
#include "solver/mesh/new_names.hpp"
#include "solver/mesh/reference_cell.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {
namespace {

using enum CellType;
using Eigen::Vector3d;

/// The inner piece of a face that is cut around one, over the face.
constexpr double inner_share = 1.0 / 3;
/// How deep the inner hexahedron or quadrangle reaches into the body.
constexpr double inner_depth = 0.5;

struct Cell {
  CellType type = poi1;
  std::vector<int> nodes;
};

std::span<const int> corners_of(const Cell& cell) {
  return std::span(cell.nodes).first(static_cast<std::size_t>(corner_count(cell.type)));
}

FacetKey key_of(std::span<const int> corners) {
  FacetKey key = {-1, -1, -1, -1};
  std::ranges::copy(corners, key.begin());
  std::ranges::sort(key);
  return key;
}

/// The facets of a cell, turned outwards; the ends of a line, without a sense.
std::vector<Cell> facets_of(const Cell& cell) {
  if (dimension(cell.type) == 1) return {{poi1, {cell.nodes[0]}}, {poi1, {cell.nodes[1]}}};
  std::vector<Cell> facets;
  for (const BoundaryFacet& local : boundary_facets(cell.type)) {
    Cell& facet = facets.emplace_back(Cell{local.type, {}});
    for (int i = 0; i < node_count(local.type); ++i)
      facet.nodes.push_back(cell.nodes[static_cast<std::size_t>(local.nodes[static_cast<std::size_t>(i)])]);
  }
  return facets;
}

/// The cell between a facet and an apex.
std::optional<CellType> cone_type(CellType base) {
  switch (base) {
    case seg2:
      return tria3;
    case seg3:
      return tria6;
    case tria3:
      return tetra4;
    case tria6:
      return tetra10;
    case quad4:
      return pyram5;
    case quad8:
      return pyram13;
    default:
      return std::nullopt;
  }
}

bool has_inner_node(CellType type) { return type == seg3 || type == tria7 || type == quad9; }

class SlaveCutter {
 public:
  SlaveCutter(const Mesh& mesh, HexaCut hexa_cut)
      : source_(mesh),
        result_(mesh),
        hexa_cut_(hexa_cut),
        node_names_(result_.node_names, "NS"),
        cell_names_(result_.cell_names, "MS") {
    for (int cell = 0; cell < mesh.cell_count(); ++cell)
      cells_.push_back({mesh.cell_types[cell], {mesh.cell(cell).begin(), mesh.cell(cell).end()}});
    pieces_.resize(cells_.size());
  }

  Mesh cut(std::span<const int> faces) {
    if (!faces.empty()) index(dimension(cells_[static_cast<std::size_t>(faces.front())].type));
    std::vector<int> kept;
    std::set<FacetKey> done;
    for (const int face : faces) {
      if (!done.insert(key_of(corners_of(cell(face)))).second) continue;
      cut(face);
      kept.push_back(face);
    }
    for (const int face : kept) result_.slave_patches.push_back(family(face));
    for (auto& [name, members] : result_.cell_groups) members = with_pieces(members);
    number_cells();
    return std::move(result_);
  }

 private:
  const Cell& cell(int index) const { return cells_[static_cast<std::size_t>(index)]; }
  Vector3d place(int node) const { return Vector3d(result_.nodes[node].data()); }

  int add_node(const Vector3d& position) {
    result_.nodes.push_back({position[0], position[1], position[2]});
    node_names_.add();
    return result_.node_count() - 1;
  }

  /// Pieces follow one another in the place of what was cut.
  void number_cells() {
    std::vector<int> sources(static_cast<std::size_t>(source_.cell_count()));
    std::iota(sources.begin(), sources.end(), 0);
    std::vector<int> number(cells_.size());
    std::vector<std::string> names;
    result_.cell_types.clear();
    result_.connectivity.clear();
    result_.cell_starts = {0};
    for (const int each : with_pieces(sources)) {
      number[static_cast<std::size_t>(each)] = result_.add_cell(cell(each).type, cell(each).nodes);
      if (!result_.cell_names.empty()) names.push_back(result_.cell_names[static_cast<std::size_t>(each)]);
    }
    result_.cell_names = std::move(names);
    const auto renumber = [&](std::vector<int>& cells) {
      for (int& each : cells) each = number[static_cast<std::size_t>(each)];
    };
    for (auto& [name, members] : result_.cell_groups) renumber(members);
    for (std::vector<int>& patch : result_.slave_patches) renumber(patch);
  }

  void index(int face_dimension) {
    for (int each = 0; each < source_.cell_count(); ++each) {
      if (dimension(cell(each).type) == face_dimension) skins_[key_of(corners_of(cell(each)))].push_back(each);
      if (dimension(cell(each).type) == face_dimension + 1) add_body(each);
    }
  }

  void add_body(int body) {
    for (const Cell& facet : facets_of(cell(body))) bodies_[key_of(corners_of(facet))].push_back(body);
  }
  void remove_body(int body) {
    for (const Cell& facet : facets_of(cell(body))) std::erase(bodies_[key_of(corners_of(facet))], body);
  }

  int body_behind(int face) const {
    const auto found = bodies_.find(key_of(corners_of(cell(face))));
    if (found == bodies_.end() || found->second.empty())
      throw Error("no-body", fmt::format("no body stands behind the slave face {}", source_.cell_name(face)),
                  "choose faces on the skin of a body");
    if (found->second.size() > 1)
      throw Error("inner-face", fmt::format("the slave face {} lies between two bodies", source_.cell_name(face)),
                  "choose faces on the skin of a body");
    return found->second.front();
  }

  void cut(int face) {
    const int body = body_behind(face);
    if (has_inner_node(cell(face).type)) return;
    const FacetKey key = key_of(corners_of(cell(face)));
    const bool by_hexahedra = hexa_cut_ == HexaCut::hexahedra && corner_count(cell(body).type) == 8;
    const bool around_inner = by_hexahedra || cell(body).type == quad4;
    std::vector<Cell> body_pieces;
    if (around_inner) {
      prepare_inner(face, body);
      body_pieces = by_hexahedra ? hexahedra(cell(face), cell(body)) : quadrangles_behind(body, key);
    } else {
      prepare_centre(cell(face));
      add_middles_behind(cell(face), cell(body));
      body_pieces = pieces_of_body(body, face, key);
    }
    for (const int skin : skins_.at(key))
      replace(skin, around_inner ? pieces_around_inner(cell(skin)) : pieces_of_face(skin, key));
    remove_body(body);
    for (const int piece : replace(body, std::move(body_pieces))) add_body(piece);
  }

  /// The node at the centre of a face, and what the edges between it and the corners carry. On quadratic faces they lie
  /// on the surface that the shape functions describe. Their numbers are those of Code_Aster 17.3.
  void prepare_centre(const Cell& face) {
    middles_.clear();
    const Vector3d centre = reference_centre(face, corners_of(face));
    const auto add_middles = [&] {
      for (const int corner : corners_of(face)) add_middle(face, corner, centre);
    };
    if (face.type == tria6) add_middles();
    centre_ = add_node(place_in(face, centre));
    if (face.type == quad8) add_middles();
  }

  /// Between the centre and the corners of a quadratic body off the face, in the order of the corners of the face that
  /// edges lead from, where the body's shape functions have them (Code_Aster 17.3).
  void add_middles_behind(const Cell& face, const Cell& body) {
    if (middles_.empty()) return;
    const Vector3d centre = reference_centre(body, corners_of(face));
    for (const int corner : corners_of(face))
      for (const auto& edge : middle_edges(body.type)) {
        const int first = body.nodes[static_cast<std::size_t>(edge[0])];
        const int second = body.nodes[static_cast<std::size_t>(edge[1])];
        if (first != corner && second != corner) continue;
        const int other = first == corner ? second : first;
        if (!middles_.contains(other)) add_middle(body, other, centre);
      }
  }

  static Vector3d reference_place(const Cell& cell, int node) {
    const auto at = std::ranges::find(cell.nodes, node) - cell.nodes.begin();
    return Vector3d(reference_nodes(cell.type)[static_cast<std::size_t>(at)].data());
  }

  static Vector3d reference_centre(const Cell& cell, std::span<const int> nodes) {
    Vector3d sum = Vector3d::Zero();
    for (const int node : nodes) sum += reference_place(cell, node);
    return sum / static_cast<double>(nodes.size());
  }

  Vector3d place_in(const Cell& cell, const Vector3d& at) const {
    const Eigen::VectorXd shape = shape_functions(cell.type, {at[0], at[1], at[2]});
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < cell.nodes.size(); ++i)
      sum += shape[static_cast<Eigen::Index>(i)] * place(cell.nodes[i]);
    return sum;
  }

  /// Half-way, in reference coordinates, from a corner to the centre.
  void add_middle(const Cell& cell, int corner, const Vector3d& centre) {
    middles_.emplace(corner, add_node(place_in(cell, 0.5 * (reference_place(cell, corner) + centre))));
  }

  /// Between the centre of the face and each facet, but the face itself.
  std::vector<Cell> cones(const std::vector<Cell>& facets, const FacetKey& face, int of) {
    std::vector<Cell> pieces;
    for (const Cell& facet : facets) {
      if (key_of(corners_of(facet)) == face) continue;
      const auto type = cone_type(facet.type);
      if (!type)
        throw Error("unsupported",
                    fmt::format("the {} cell {} behind a slave face cannot be cut", name_of(cell(of).type),
                                result_.cell_name(of)),
                    "use the quadratic cells without nodes inside their facets there (HEXA20, PENTA15), or HEXA27 "
                    "behind QUAD9");
      pieces.push_back(cone(facet, *type));
    }
    return pieces;
  }

  /// Their order, and that of their nodes, is that of Code_Aster 17.3 for TRIA3 and TETRA4.
  std::vector<Cell> pieces_of_body(int body, int face, const FacetKey& key) {
    if (cell(body).type == tria3) {
      const std::vector<int> corner = corners_from_edge(body, key);
      return {{tria3, {corner[0], centre_, corner[2]}}, {tria3, {centre_, corner[1], corner[2]}}};
    }
    if (cell(body).type != tetra4) return cones(facets_of(cell(body)), key, body);
    const std::vector<int>& base = cell(face).nodes;
    int apex = -1;
    for (const int node : cell(body).nodes)
      if (std::ranges::find(base, node) == base.end()) apex = node;
    std::vector<Cell> pieces;
    for (std::size_t i = 0; i < 3; ++i) pieces.push_back({tetra4, {apex, base[i], base[(i + 1) % 3], centre_}});
    return pieces;
  }

  std::vector<Cell> pieces_of_face(int face, const FacetKey& key) {
    const Cell& whole = cell(face);
    if (dimension(whole.type) > 1) return cones(facets_of(whole), key, face);
    return {{seg2, {whole.nodes[0], centre_}}, {seg2, {centre_, whole.nodes[1]}}};
  }

  Cell cone(const Cell& base, CellType type) const {
    Cell result{type, std::vector<int>(static_cast<std::size_t>(node_count(type)), centre_)};
    const BoundaryFacet& own = boundary_facets(type).front();
    for (std::size_t i = 0; i < base.nodes.size(); ++i)
      result.nodes[static_cast<std::size_t>(own.nodes[i])] = base.nodes[i];
    const int apex = corner_count(type) - 1;
    const auto edges = middle_edges(type);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (edges[e][0] != apex && edges[e][1] != apex) continue;
      const int corner = edges[e][0] == apex ? edges[e][1] : edges[e][0];
      result.nodes[static_cast<std::size_t>(corner_count(type)) + e] =
          middles_.at(result.nodes[static_cast<std::size_t>(corner)]);
    }
    return result;
  }

  void prepare_inner(int face, int body) {
    if (cell(body).type != hexa8 && cell(body).type != quad4)
      throw Error("unsupported",
                  fmt::format("the {} cell {} behind a slave face cannot be cut into hexahedra",
                              name_of(cell(body).type), source_.cell_name(face)),
                  "write DECOUPE_HEXA='PYRA'");
    inner_.clear();
    deep_.clear();
    const Cell skin = cell(face);
    const Cell whole = cell(body);
    std::vector<int> base;
    for (const int corner : corners_of(skin)) base.push_back(below(whole, skin, corner));
    const std::vector<Vector3d> shallow = inner_places(whole, corners_of(skin));
    const std::vector<Vector3d> beneath = inner_places(whole, base);
    for (std::size_t i = 0; i < base.size(); ++i) inner_.emplace(skin.nodes[i], add_node(place_in(whole, shallow[i])));
    for (std::size_t i = 0; i < base.size(); ++i)
      deep_.emplace(skin.nodes[i],
                    add_node(place_in(whole, (1 - inner_depth) * shallow[i] + inner_depth * beneath[i])));
  }

  /// In the reference cell of a body: the corners of a facet, drawn towards its centre.
  static std::vector<Vector3d> inner_places(const Cell& body, std::span<const int> facet) {
    const Vector3d centre = reference_centre(body, facet);
    std::vector<Vector3d> places;
    for (const int corner : facet) places.push_back(centre + inner_share * (reference_place(body, corner) - centre));
    return places;
  }

  std::vector<Cell> pieces_around_inner(const Cell& face) const {
    const auto inner = [&](std::size_t i) { return inner_.at(face.nodes[i]); };
    if (face.type == seg2)
      return {{seg2, {face.nodes[0], inner(0)}}, {seg2, {inner(0), inner(1)}}, {seg2, {inner(1), face.nodes[1]}}};
    std::vector<Cell> pieces;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t j = (i + 1) % 4;
      pieces.push_back({quad4, {face.nodes[i], face.nodes[j], inner(j), inner(i)}});
    }
    pieces.push_back({quad4, {inner(0), inner(1), inner(2), inner(3)}});
    return pieces;
  }

  /// The corners of a triangle or quadrangle, those on its slave edge first.
  std::vector<int> corners_from_edge(int body, const FacetKey& key) const {
    const auto own = corners_of(cell(body));
    std::vector<int> corner(own.begin(), own.end());
    while (key_of(std::span(corner).first(2)) != key) std::ranges::rotate(corner, corner.begin() + 1);
    return corner;
  }

  /// Four: one below the middle third of the face, half as deep as the body, and one between it and each of the body's
  /// other sides.
  std::vector<Cell> quadrangles_behind(int body, const FacetKey& key) const {
    const std::vector<int> corner = corners_from_edge(body, key);
    const std::array<int, 2> shallow = {inner_.at(corner[0]), inner_.at(corner[1])};
    const std::array<int, 2> deep = {deep_.at(corner[0]), deep_.at(corner[1])};
    return {{quad4, {corner[0], shallow[0], deep[0], corner[3]}},
            {quad4, {shallow[0], shallow[1], deep[1], deep[0]}},
            {quad4, {shallow[1], corner[1], corner[2], deep[1]}},
            {quad4, {corner[2], corner[3], deep[0], deep[1]}}};
  }

  /// One hexahedron between the inner square and each side of the face, one below it that reaches to the facet
  /// opposite, one between.
  std::vector<Cell> hexahedra(const Cell& face, const Cell& body) const {
    std::array<int, 4> top{}, base{}, shallow{}, deep{};  // corners of the face, those below them, and the inner ones
    for (std::size_t i = 0; i < 4; ++i) {
      top[i] = face.nodes[i];
      base[i] = below(body, face, top[i]);
      shallow[i] = inner_.at(top[i]);
      deep[i] = deep_.at(top[i]);
    }
    std::vector<Cell> pieces;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t j = (i + 1) % 4;
      pieces.push_back({hexa8, {shallow[i], shallow[j], top[j], top[i], deep[i], deep[j], base[j], base[i]}});
    }
    pieces.push_back({hexa8, {deep[3], deep[2], deep[1], deep[0], base[3], base[2], base[1], base[0]}});
    pieces.push_back({hexa8, {shallow[3], shallow[2], shallow[1], shallow[0], deep[3], deep[2], deep[1], deep[0]}});
    return pieces;
  }

  /// The other end of the edge that leaves a face of a hexahedron or quadrangle at a corner: the corner next to it on a
  /// facet beside the face.
  static int below(const Cell& body, const Cell& face, int corner) {
    const auto on_face = [&](int node) { return std::ranges::find(face.nodes, node) != face.nodes.end(); };
    for (const Cell& facet : facets_of(body)) {
      const auto found = std::ranges::find(facet.nodes, corner);
      if (found == facet.nodes.end()) continue;
      const auto i = static_cast<std::size_t>(found - facet.nodes.begin());
      const auto count = static_cast<std::size_t>(corner_count(facet.type));
      for (const std::size_t beside : {(i + 1) % count, (i + count - 1) % count})
        if (!on_face(facet.nodes[beside])) return facet.nodes[beside];
    }
    return -1;
  }

  /// Returns the indices of the pieces.
  std::vector<int> replace(int index, std::vector<Cell> pieces) {
    std::vector<int> places = {index};
    cells_[static_cast<std::size_t>(index)] = std::move(pieces.front());
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      pieces_[static_cast<std::size_t>(index)].push_back(static_cast<int>(cells_.size()));
      cells_.push_back(std::move(pieces[i]));
      pieces_.emplace_back();
      cell_names_.add();
      places.push_back(pieces_[static_cast<std::size_t>(index)].back());
    }
    return places;
  }

  /// A cell and what was cut off it.
  std::vector<int> family(int index) const {
    std::vector<int> members = {index};
    for (const int piece : pieces_[static_cast<std::size_t>(index)]) {
      const auto further = family(piece);
      members.insert(members.end(), further.begin(), further.end());
    }
    return members;
  }

  std::vector<int> with_pieces(const std::vector<int>& members) const {
    std::vector<int> all;
    for (const int member : members) {
      const auto own = family(member);
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  }

  const Mesh& source_;
  Mesh result_;
  HexaCut hexa_cut_;
  NewNames node_names_;
  NewNames cell_names_;
  std::vector<Cell> cells_;
  std::vector<std::vector<int>> pieces_;  ///< of each cell: what was cut off it
  std::unordered_map<FacetKey, std::vector<int>, FacetKeyHash> skins_;
  std::unordered_map<FacetKey, std::vector<int>, FacetKeyHash> bodies_;
  int centre_ = -1;
  std::map<int, int> middles_;  ///< by corner: the node between it and the centre
  std::map<int, int> inner_;    ///< by corner of the face: that of the inner square or third
  std::map<int, int> deep_;     ///< the one below it, inside the body
};

}  // namespace

Mesh with_cut_slave_faces(const Mesh& mesh, std::span<const int> faces, HexaCut hexa_cut) {
  return SlaveCutter(mesh, hexa_cut).cut(faces);
}

std::vector<int> inner_nodes(const Mesh& mesh, std::span<const int> patch) {
  std::map<FacetKey, std::pair<int, std::vector<int>>> edges;  // how many faces have it, and its nodes
  std::set<int> nodes, corners;
  for (const int face : patch) {
    const Cell own{mesh.cell_types[face], {mesh.cell(face).begin(), mesh.cell(face).end()}};
    nodes.insert(own.nodes.begin(), own.nodes.end());
    corners.insert(corners_of(own).begin(), corners_of(own).end());
    for (const Cell& edge : facets_of(own)) {
      auto& known = edges[key_of(corners_of(edge))];
      ++known.first;
      known.second = edge.nodes;
    }
  }
  for (const auto& [key, edge] : edges)
    if (edge.first == 1)
      for (const int node : edge.second) nodes.erase(node);
  std::vector<int> inner;
  std::ranges::set_intersection(nodes, corners, std::back_inserter(inner));
  if (inner.empty()) inner.assign(nodes.begin(), nodes.end());
  return inner;
}

}  // namespace comma::solver
