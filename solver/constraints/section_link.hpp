// A beam's end joined to the section where a solid, a plane body (R3.03.03) or a plate (R3.03.06) takes over.
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

/// The edge of a plate in space as a section: what lies within half the thickness of it along the normal of the plate.
struct PlateEdge {
  int cell = -1;           ///< an edge
  double thickness = 0.0;  ///< of the plate there (a length)
};

/// The same where a plate ends at the beam: displacements vary through the thickness by the rotations of its nodes,
/// u + z rotation x n. `axis`: of the beam; the normal n of the plate is at right angles to it and to the edge. Throws
/// Error `not-a-skin` for a cell that is no edge, `parallel-directions` for one along the axis.
SectionLink plate_section_link(const Mesh& mesh, std::span<const PlateEdge> section, const Eigen::Vector3d& axis,
                               int beam_node, const Origin& origin);

}  // namespace comma::solver
