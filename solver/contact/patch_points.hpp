// Local average contact: the mean gap of each patch of slave faces (R5.03.55; Abbas, Drouet and Hild, Computer Methods
// in Applied Mechanics and Engineering 339, 2018).
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "solver/contact/contact_points.hpp"
#include "solver/contact/definition.hpp"
#include "solver/contact/normals.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The patches of a zone's slave faces, as indices into Mesh::slave_patches. Throws Error `no-patch` for a slave face
/// without one, or a patch that is not wholly slave.
std::vector<int> patches_of(const ContactZone& zone, const Mesh& mesh);

/// Appends a point for each patch of a zone. Its pressure is constant, its gap the mean over the part that faces the
/// master:
///     1/|P| integral over P of n . (x_s - x_m) - thickness,   -n the slave's own normal at x_s, with LISSAGE too
/// all of it, P too, as the bodies are at `positions`: facets face each other along these normals. The
/// point lies on a node inside the patch. The pressure is a force over the initial area, for `weight` and `area` and on
/// either side: it acts on the slave over the slave's own area, and on the master over that of the master's part that
/// the slave faces, along each side's own normal: where it acts, or with LISSAGE on each node along that of the cells
/// around, N_i n_i. Shares, which say how the gap changes, are those of the force; the two forces differ as the areas
/// do. What of this the references leave open Code_Aster's figures tell (ssnv104k, ssnv104m, to 1e-10; ssnp173b,
/// to 1e-9). A patch whose inner node is farther from the master nodes than the pairing distance faces nothing.
void append_patch_points(const ContactDefinition& definition, int zone, const Model& model, Positions positions,
                         double time, std::vector<ContactPoint>& points);

/// The mean gap of such a point when the nodes are at `positions`, as its shares have it.
double mean_gap(const ContactPoint& point, Positions positions);

}  // namespace comma::solver
