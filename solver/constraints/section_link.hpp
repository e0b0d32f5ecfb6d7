// A beam's end joined to the section where a solid or plane body takes over (R3.03.03).
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The relations and what a caller may wish to warn of.
struct SectionLink {
  std::vector<LinearRelation> relations;
  Eigen::Vector3d centroid;  ///< of the section
  double offset = 0.0;       ///< distance of the beam's node from it; the method supposes 0
  double size = 0.0;         ///< radius of gyration of the section, to compare the offset with
};

/// The section's mean displacement is that of the beam's node P, and its mean rotation that of P: with G the centroid
/// and S the section, the integral over S of u equals |S| u(P), and that of GM x u equals that of GM x (rotation(P) x
/// GM). Six relations for a section of faces in space, three for one of edges in the plane; they pass on the resultants
/// of the beam without hindering the section to warp. Throws Error `not-a-skin` for a cell that is no face in space (or
/// no edge in the plane).
SectionLink section_link(const Mesh& mesh, std::span<const int> section, int beam_node, const Origin& origin);

}  // namespace comma::solver
