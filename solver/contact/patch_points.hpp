// Local average contact: the mean gap of each patch of slave faces (R5.03.55; Abbas, Drouet and Hild, Computer Methods in Applied
// Mechanics and Engineering 339, 2018).
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/contact/contact_points.hpp"
#include "solver/contact/definition.hpp"
#include "solver/contact/normals.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The patches of a zone's slave faces, as indices into Mesh::slave_patches. Throws Error `no-patch` for a slave face without
/// one, or a patch that is not wholly slave.
std::vector<int> patches_of(const ContactZone& zone, const Mesh& mesh);

/// Appends a point for each patch of a zone. Its pressure is constant, its gap the mean over the part that faces the master:
///     1/|P| integral over P of n . (x_s - x_m) - thickness,   -n the slave's normal at x_s
/// Weights are initial areas, that of P for `weight`. The point lies on a node inside the patch. Gaps and normals are those of
/// `positions`. What else can be chosen, Code_Aster's figures tell: in the plane, which places face each other is settled when a step
/// begins, at `start` (ssnp173a and ssnp173b, to 1e-9); in space it follows the bodies (ssnp170z, to 1e-7). The pressure acts on either side
/// along that side's own normal: where it acts, or with LISSAGE on each node along that of the cells around, N_i n_i. So do the
/// shares of a gap that moves.
/// Facets whose gap is beyond the zone's pairing distance are left out.
void append_patch_points(const ContactDefinition& definition, int zone, const Model& model, Positions positions, Positions start, double time,
                         std::vector<ContactPoint>& points);

}  // namespace comma::solver
