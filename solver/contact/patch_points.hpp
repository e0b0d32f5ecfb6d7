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
/// shares of a gap that moves. Where surfaces slide far in a step, give `positions` for `start` (see largest_slide).
/// Facets whose gap is beyond the zone's pairing distance are left out.
void append_patch_points(const ContactDefinition& definition, int zone, const Model& model, Positions positions, Positions start, double time,
                         std::vector<ContactPoint>& points);

/// Whether places of a zone face each other through a step as they did when it began: averages in the plane.
bool faces_as_at_start(const ContactZone& zone, const Mesh& mesh);

/// How far, since `start`, places of such zones have slid along what they face now or faced then, at most, as a share of the smaller facet's
/// size; those farther apart than that size do not count. Once it is a good part of a facet, what faces each other has to follow the
/// bodies: over a bend of the surface the gaps of places that have parted say nothing, and the geometry does not settle.
double largest_slide(const ContactDefinition& definition, const Mesh& mesh, Positions positions, Positions start);

}  // namespace comma::solver
