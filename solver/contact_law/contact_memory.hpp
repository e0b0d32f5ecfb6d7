// What of a contact a computation that goes on from a step needs beside its fields.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/contact_points.hpp"
#include "solver/contact_law/raised_penalties.hpp"

namespace comma::solver {

/// Where a point lies before deformation, and whether it was closed.
struct RememberedPoint {
  int cell = -1;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  bool closed = false;
};

/// The place of a point before deformation (m).
Eigen::Vector3d initial_place(const ContactPoint& point, const Mesh& mesh);

struct ZoneMemory {
  bool bilateral = false;                    ///< GLISSIERE
  std::array<double, 5> penalties = {};      ///< of contact and of friction, as given, 0 where there is none; 1 where
                                             ///< either grows by a limit; 1 of the mixed formulation
  std::vector<int> slave_cells = {};         ///< rising
  std::vector<RememberedPoint> points = {};  ///< none where no zone is bilateral
};

/// At the end of a step. Zones are known again by their slave cells and points by their places, whatever the order in
/// which a later contact has them, and whatever its rule of integration.
struct ContactMemory {
  std::vector<ZoneMemory> zones;
  RaisedPenalties penalties;

  /// The zone from which that zone goes on: the one of its number or else the first that has some of its slave cells.
  std::optional<std::size_t> zone_like(const ZoneMemory& zone, std::size_t number) const;
  /// Whether the point nearest to each of these, of the zones that have some of the slave cells, was closed in a zone
  /// that holds what it has closed. What lies farther than the face of the point is large (`reach`, one a point) was no
  /// point of it. Of equally near ones that of the same face counts, else the first.
  std::vector<char> held(std::span<const RememberedPoint> points, const ZoneMemory& zone,
                         std::span<const double> reach) const;
};

}  // namespace comma::solver
