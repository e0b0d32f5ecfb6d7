// Turning skin cells so that their normals point out of the bodies they bound (MODI_MAILLAGE ORIE_PEAU, U4.23.04).
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Turns a line or face round, as Code_Aster does it: of a face of a skin (ORIE_PEAU) the last corner becomes the first
/// one, of a sheet (ORIE_NORM_COQUE) the first one stays.
void turn_skin_cell(Mesh& mesh, int cell);
void turn_sheet_cell(Mesh& mesh, int cell);

/// Turns each of the skin cells so that its normal points out of the volume (or plane) cell behind it. `support` limits
/// the search to those cells; empty: all cells of one dimension more. Returns how many were turned. Throws Error
/// `skin-without-support` naming a cell that bounds nothing, `skin-inside-body` one that lies between two cells of the
/// support.
int orient_skin(Mesh& mesh, std::span<const int> skin, std::span<const int> support = {});

/// Those of the skin cells that bound no cell of the support (default as above): the surface of a rigid body, say,
/// which has no inside.
std::vector<int> loose_skin(const Mesh& mesh, std::span<const int> skin, std::span<const int> support = {});

/// Those of the skin cells whose normals point into the body behind them. Cells that bound no body, or lie between two,
/// have no outer side and are left out.
std::vector<int> inward_skin(const Mesh& mesh, std::span<const int> skin);

/// How a set of cells is to run: the normals (faces, and lines of a plane mesh) or the tangents (lines) of the cells at
/// a node make an acute angle with a direction.
struct OrientationSeed {
  int node;
  Point direction;
};

/// Turns faces or lines so that the normals of neighbours agree (MODI_MAILLAGE ORIE_NORM_COQUE, U4.23.04): they agree
/// with the seed or, without one, with the first cell. Returns how many were turned. Throws Error `not-orientable`
/// naming two cells whose normals cannot agree, `several-pieces` where a cell is not connected with the others,
/// `wrong-cell` for points and solids, `unknown-node` where no cell is at the seed's node, `ambiguous-direction` where
/// the direction lies in the cells.
int orient_normals(Mesh& mesh, std::span<const int> cells, const std::optional<OrientationSeed>& seed);

/// Turns lines so that each begins where its neighbour ends (ORIE_LIGNE). Returns and throws as above.
int orient_lines(Mesh& mesh, std::span<const int> cells, const std::optional<OrientationSeed>& seed);

/// Two of the faces or lines that share an edge (or an end) with no third one and do not run alike: their normals point
/// to different sides. Throws `wrong-cell` for points and solids.
std::optional<std::pair<int, int>> unlike_neighbours(const Mesh& mesh, std::span<const int> cells);

}  // namespace comma::solver
