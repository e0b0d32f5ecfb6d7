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
///     1/|P| integral over P of n . (x_s - x_m) - thickness,   x_m the place on the master along the slave's normal -n from x_s
/// as shares of the nodes' positions; weights are initial areas, that of P for `weight`. The point lies on a node inside the patch.
/// Facets whose gap is beyond the zone's pairing distance are left out.
void append_patch_points(const ContactDefinition& definition, int zone, const Model& model, Positions positions, double time,
                         std::vector<ContactPoint>& points);

}  // namespace comma::solver
