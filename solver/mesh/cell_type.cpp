#include "solver/mesh/cell_type.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace comma::solver {
namespace {

using enum CellType;

struct Traits {
  std::string_view name;
  std::int8_t nodes;
  std::int8_t corners;
  std::int8_t dimension;
};

constexpr std::array<Traits, cell_type_count> traits = {{
    {"POI1", 1, 1, 0},     {"SEG2", 2, 2, 1},     {"SEG3", 3, 2, 1},   {"SEG4", 4, 2, 1},     {"TRIA3", 3, 3, 2},
    {"TRIA6", 6, 3, 2},    {"TRIA7", 7, 3, 2},    {"QUAD4", 4, 4, 2},  {"QUAD8", 8, 4, 2},    {"QUAD9", 9, 4, 2},
    {"TETRA4", 4, 4, 3},   {"TETRA10", 10, 4, 3}, {"PYRAM5", 5, 5, 3}, {"PYRAM13", 13, 5, 3}, {"PENTA6", 6, 6, 3},
    {"PENTA15", 15, 6, 3}, {"PENTA18", 18, 6, 3}, {"HEXA8", 8, 8, 3},  {"HEXA20", 20, 8, 3},  {"HEXA27", 27, 8, 3},
}};

// The facets are written out with all their nodes: corners in the order that turns the facet outwards, then the middles
// of the edges in the same sense, then the middle of the face.
constexpr std::array<BoundaryFacet, 3> tria3_edges = {{{seg2, {0, 1}}, {seg2, {1, 2}}, {seg2, {2, 0}}}};
constexpr std::array<BoundaryFacet, 3> tria6_edges = {{{seg3, {0, 1, 3}}, {seg3, {1, 2, 4}}, {seg3, {2, 0, 5}}}};
constexpr std::array<BoundaryFacet, 4> quad4_edges = {{{seg2, {0, 1}}, {seg2, {1, 2}}, {seg2, {2, 3}}, {seg2, {3, 0}}}};
constexpr std::array<BoundaryFacet, 4> quad8_edges = {
    {{seg3, {0, 1, 4}}, {seg3, {1, 2, 5}}, {seg3, {2, 3, 6}}, {seg3, {3, 0, 7}}}};

// Tetrahedron: mid-edges 4 (0-1), 5 (1-2), 6 (0-2), 7 (0-3), 8 (1-3), 9 (2-3).
constexpr std::array<BoundaryFacet, 4> tetra4_faces = {
    {{tria3, {0, 2, 1}}, {tria3, {0, 1, 3}}, {tria3, {1, 2, 3}}, {tria3, {2, 0, 3}}}};
constexpr std::array<BoundaryFacet, 4> tetra10_faces = {{{tria6, {0, 2, 1, 6, 5, 4}},
                                                         {tria6, {0, 1, 3, 4, 8, 7}},
                                                         {tria6, {1, 2, 3, 5, 9, 8}},
                                                         {tria6, {2, 0, 3, 6, 7, 9}}}};

// Pyramid: mid-edges 5 (0-1), 6 (1-2), 7 (2-3), 8 (3-0), then 9 to 12 from each base corner to the apex 4.
constexpr std::array<BoundaryFacet, 5> pyram5_faces = {
    {{quad4, {0, 3, 2, 1}}, {tria3, {0, 1, 4}}, {tria3, {1, 2, 4}}, {tria3, {2, 3, 4}}, {tria3, {3, 0, 4}}}};
constexpr std::array<BoundaryFacet, 5> pyram13_faces = {{{quad8, {0, 3, 2, 1, 8, 7, 6, 5}},
                                                         {tria6, {0, 1, 4, 5, 10, 9}},
                                                         {tria6, {1, 2, 4, 6, 11, 10}},
                                                         {tria6, {2, 3, 4, 7, 12, 11}},
                                                         {tria6, {3, 0, 4, 8, 9, 12}}}};

// Wedge: mid-edges 6 to 8 below, 9 to 11 upright, 12 to 14 above; mid-faces 15 (0143), 16 (1254), 17 (2035).
constexpr std::array<BoundaryFacet, 5> penta6_faces = {
    {{tria3, {0, 2, 1}}, {tria3, {3, 4, 5}}, {quad4, {0, 1, 4, 3}}, {quad4, {1, 2, 5, 4}}, {quad4, {2, 0, 3, 5}}}};
constexpr std::array<BoundaryFacet, 5> penta15_faces = {{{tria6, {0, 2, 1, 8, 7, 6}},
                                                         {tria6, {3, 4, 5, 12, 13, 14}},
                                                         {quad8, {0, 1, 4, 3, 6, 10, 12, 9}},
                                                         {quad8, {1, 2, 5, 4, 7, 11, 13, 10}},
                                                         {quad8, {2, 0, 3, 5, 8, 9, 14, 11}}}};
constexpr std::array<BoundaryFacet, 5> penta18_faces = {{{tria6, {0, 2, 1, 8, 7, 6}},
                                                         {tria6, {3, 4, 5, 12, 13, 14}},
                                                         {quad9, {0, 1, 4, 3, 6, 10, 12, 9, 15}},
                                                         {quad9, {1, 2, 5, 4, 7, 11, 13, 10, 16}},
                                                         {quad9, {2, 0, 3, 5, 8, 9, 14, 11, 17}}}};

// Hexahedron: mid-edges 8 to 11 below, 12 to 15 upright, 16 to 19 above; mid-faces 20 (below), 21 (0154), 22 (1265),
// 23 (2376), 24 (3047), 25 (above).
constexpr std::array<BoundaryFacet, 6> hexa8_faces = {{{quad4, {0, 3, 2, 1}},
                                                       {quad4, {0, 1, 5, 4}},
                                                       {quad4, {1, 2, 6, 5}},
                                                       {quad4, {2, 3, 7, 6}},
                                                       {quad4, {3, 0, 4, 7}},
                                                       {quad4, {4, 5, 6, 7}}}};
constexpr std::array<BoundaryFacet, 6> hexa20_faces = {{{quad8, {0, 3, 2, 1, 11, 10, 9, 8}},
                                                        {quad8, {0, 1, 5, 4, 8, 13, 16, 12}},
                                                        {quad8, {1, 2, 6, 5, 9, 14, 17, 13}},
                                                        {quad8, {2, 3, 7, 6, 10, 15, 18, 14}},
                                                        {quad8, {3, 0, 4, 7, 11, 12, 19, 15}},
                                                        {quad8, {4, 5, 6, 7, 16, 17, 18, 19}}}};
constexpr std::array<BoundaryFacet, 6> hexa27_faces = {{{quad9, {0, 3, 2, 1, 11, 10, 9, 8, 20}},
                                                        {quad9, {0, 1, 5, 4, 8, 13, 16, 12, 21}},
                                                        {quad9, {1, 2, 6, 5, 9, 14, 17, 13, 22}},
                                                        {quad9, {2, 3, 7, 6, 10, 15, 18, 14, 23}},
                                                        {quad9, {3, 0, 4, 7, 11, 12, 19, 15, 24}},
                                                        {quad9, {4, 5, 6, 7, 16, 17, 18, 19, 25}}}};

const Traits& traits_of(CellType type) { return traits[static_cast<std::size_t>(type)]; }

}  // namespace

int node_count(CellType type) { return traits_of(type).nodes; }
int corner_count(CellType type) { return traits_of(type).corners; }
int dimension(CellType type) { return traits_of(type).dimension; }
std::string_view name_of(CellType type) { return traits_of(type).name; }

std::optional<CellType> cell_type_named(std::string_view name) {
  const auto* found = std::ranges::find(traits, name, &Traits::name);
  if (found == traits.end()) return std::nullopt;
  return static_cast<CellType>(found - traits.begin());
}

std::span<const BoundaryFacet> boundary_facets(CellType type) {
  switch (type) {
    case poi1:
    case seg2:
    case seg3:
    case seg4:
      return {};
    case tria3:
      return tria3_edges;
    case tria6:
    case tria7:
      return tria6_edges;
    case quad4:
      return quad4_edges;
    case quad8:
    case quad9:
      return quad8_edges;
    case tetra4:
      return tetra4_faces;
    case tetra10:
      return tetra10_faces;
    case pyram5:
      return pyram5_faces;
    case pyram13:
      return pyram13_faces;
    case penta6:
      return penta6_faces;
    case penta15:
      return penta15_faces;
    case penta18:
      return penta18_faces;
    case hexa8:
      return hexa8_faces;
    case hexa20:
      return hexa20_faces;
    case hexa27:
      return hexa27_faces;
  }
  assert(false);
  return {};
}

}  // namespace comma::solver
