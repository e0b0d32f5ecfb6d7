#include "solver/contact/facet_overlap.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace comma::solver;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace facet_overlap_test {

using Points = std::vector<Vector3d>;

FacetGeometry facet(CellType type, const Points& points) { return {type, points}; }

/// A straight facet of any type on corners: mid-edge nodes and centre lie in between.
Points straight(CellType type, Points corners) {
  const auto count = corners.size();
  if (dimension(type) == 1 && node_count(type) == 3) corners.push_back((corners[0] + corners[1]) / 2);
  if (dimension(type) == 2 && node_count(type) > static_cast<int>(count))
    for (std::size_t i = 0; i < count; ++i) corners.push_back((corners[i] + corners[(i + 1) % count]) / 2);
  if (type == CellType::quad9) corners.push_back((corners[0] + corners[1] + corners[2] + corners[3]) / 4);
  return corners;
}

Vector3d place(const FacetGeometry& of, const Vector2d& xi) { return point_at(of, xi); }

/// Integral of f over the part of the slave that faces the master.
template <class Function>
double integral(const FacetGeometry& slave, const FacetGeometry& master, Function f) {
  double sum = 0.0;
  for (const OverlapPoint& at : facet_overlap(slave, master).points) {
    sum += at.weight * facet_stretch(slave.type, slave.points, at.slave, false) * f(at);
  }
  return sum;
}

double one(const OverlapPoint&) { return 1.0; }

TEST_CASE("Segments have in common what their shadows on each other have") {
  for (const CellType type : {CellType::seg2, CellType::seg3}) {
    const Points below = straight(type, {{0, 0, 0}, {2, 0, 0}});  // outward normal: down
    const Points above = straight(type, {{3, -0.5, 0}, {0.5, -0.5, 0}});
    CHECK(integral(facet(type, below), facet(type, above), one) == Approx(1.5).epsilon(1e-14));
    const Points beside = straight(type, {{4, -0.5, 0}, {2, -0.5, 0}});
    CHECK(facet_overlap(facet(type, below), facet(type, beside)).points.empty());
    // Turned the other way it does not face the slave.
    const Points away = straight(type, {{0.5, -0.5, 0}, {3, -0.5, 0}});
    CHECK(facet_overlap(facet(type, below), facet(type, away)).points.empty());
    // Nor does one that stands nearly upright.
    CHECK_FALSE(
        facet_overlap(facet(type, below), facet(type, straight(type, {{1.5, -10, 0}, {0, -0.5, 0}}))).points.empty());
    const auto upright = facet_overlap(facet(type, below), facet(type, straight(type, {{1.5, -20, 0}, {0, -0.5, 0}})));
    CHECK(upright.points.empty());
    CHECK(upright.master.empty());
  }
}

TEST_CASE("Both places of an overlap point lie on the slave's normal") {
  const Points slave = {{0, 0, 0}, {2, 0, 0}, {1, -0.1, 0}};
  const Points master = {{2.5, -0.4, 0}, {-0.5, -0.5, 0}, {1, -0.6, 0}};
  const FacetGeometry geometry = facet(CellType::seg3, slave);
  const auto overlap = facet_overlap(geometry, facet(CellType::seg3, master));
  REQUIRE(!overlap.points.empty());
  for (const OverlapPoint& at : overlap.points) {
    const Vector3d apart = place(facet(CellType::seg3, master), at.master) - place(geometry, at.slave);
    CHECK(apart.cross(normal_at(geometry, at.slave)).norm() < 1e-14);
  }
}

TEST_CASE("The overlaps of a bent slave line with the pieces of a master line add up to the line") {
  const Points slave = {{0, 0, 0}, {2, 0, 0}, {1, -0.2, 0}};
  double sum = 0.0;
  for (int i = -4; i < 12; ++i) {
    const double x = 0.31 * i;
    const Points master = {{x + 0.31, -0.5 - 0.1 * x, 0}, {x, -0.5 - 0.1 * (x - 0.31), 0}};
    for (const OverlapPoint& at : facet_overlap(facet(CellType::seg3, slave), facet(CellType::seg2, master)).points)
      sum += at.weight;
  }
  CHECK(sum == Approx(2.0).epsilon(1e-12));
}

TEST_CASE("The areas of a facet's overlaps with a grid of others add up to its own") {
  const Points triangle = {{0.1, 0.2, 0}, {1.7, 0.4, 0}, {0.6, 1.8, 0}};
  const Points quadrangle = {{0.1, 0.2, 0}, {1.7, 0.4, 0}, {1.5, 1.6, 0}, {0.3, 1.8, 0}};
  using enum CellType;
  for (const CellType type : {tria3, tria6, quad4, quad8, quad9}) {
    const Points slave = straight(type, corner_count(type) == 3 ? triangle : quadrangle);
    for (const CellType other : {tria3, tria6, quad4, quad8, quad9}) {
      CAPTURE(name_of(type), name_of(other));
      double sum = 0.0;
      for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j) {
          const double h = 0.4;
          const Points square = {{h * i, h * j, 0.3},
                                 {h * i, h * (j + 1), 0.3},
                                 {h * (i + 1), h * (j + 1), 0.3},
                                 {h * (i + 1), h * j, 0.3}};
          if (corner_count(other) == 4) {
            sum += integral(facet(type, slave), facet(other, straight(other, square)), one);
          } else {
            sum += integral(facet(type, slave), facet(other, straight(other, {square[0], square[1], square[2]})), one);
            sum += integral(facet(type, slave), facet(other, straight(other, {square[0], square[2], square[3]})), one);
          }
        }
      const Vector3d first = corner_count(type) == 3 ? triangle[1] - triangle[0] : quadrangle[2] - quadrangle[0];
      const Vector3d second = corner_count(type) == 3 ? triangle[2] - triangle[0] : quadrangle[3] - quadrangle[1];
      const double area = 0.5 * std::abs(first.cross(second)[2]);
      CHECK(sum == Approx(area).epsilon(1e-13));
    }
  }
}

TEST_CASE("The master's own part of an overlap is what the slave faces of it") {
  // Parallel lines: the common part is from 0.5 to 2, seen from below and from above.
  const Points below = straight(CellType::seg2, {{0, 0, 0}, {2, 0, 0}});
  const Points above = straight(CellType::seg3, {{3, -0.5, 0}, {0.5, -0.5, 0}});
  double sum = 0.0;
  for (const FacePoint& at : facet_overlap(facet(CellType::seg2, below), facet(CellType::seg3, above)).master)
    sum += at.weight * 1.25;
  CHECK(sum == Approx(1.5).epsilon(1e-14));
  // A master that leans by half a right angle has more area than its shadow.
  const Points slave = straight(CellType::tria3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Points leaning = straight(CellType::quad4, {{-2, -2, 2}, {-2, 2, 2}, {2, 2, -2}, {2, -2, -2}});
  sum = 0.0;
  for (const FacePoint& at : facet_overlap(facet(CellType::tria3, slave), facet(CellType::quad4, leaning)).master)
    sum += at.weight * facet_stretch(CellType::quad4, leaning, at.xi, false);
  CHECK(sum == Approx(0.5 * std::sqrt(2.0)).epsilon(1e-13));
}

TEST_CASE("Whatever middle nodes do, a facet is covered once by others that tile the plane") {
  Points slave = straight(CellType::tria6, {{0.1, 0.2, 0}, {1.7, 0.4, 0}, {0.6, 1.8, 0}});
  slave[3] += Vector3d(0.02, -0.05, 0.01);
  slave[4] += Vector3d(-0.03, 0.04, 0.0);
  double sum = 0.0;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      const double h = 0.4;
      Points square = straight(
          CellType::quad8,
          {{h * i, h * j, 0.3}, {h * i, h * (j + 1), 0.3}, {h * (i + 1), h * (j + 1), 0.3}, {h * (i + 1), h * j, 0.3}});
      square[4] += Vector3d(0.03, 0.01, -0.02);
      for (const OverlapPoint& at :
           facet_overlap(facet(CellType::tria6, slave), facet(CellType::quad8, square)).points) {
        sum += at.weight;
        const Vector3d apart =
            place(facet(CellType::quad8, square), at.master) - place(facet(CellType::tria6, slave), at.slave);
        CHECK(apart.cross(normal_at(facet(CellType::tria6, slave), at.slave)).norm() < 1e-9);
      }
    }
  CHECK(sum == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("On plane facets polynomials of the shape functions' degree are integrated exactly, on either side") {
  const Points slave = straight(CellType::tria6, {{0, 0, 0}, {2, 0.3, 0}, {0.4, 1.9, 0}});
  const Points master = straight(CellType::tria6, {{0.2, 0.1, 0.5}, {0.5, 2.2, 0.5}, {1.9, 0.5, 0.5}});
  const auto whole = facet(CellType::tria6, slave);
  const auto other = facet(CellType::tria6, master);
  // Shape functions add up to one, and interpolate places exactly: both sides give the same first and second moments.
  const auto moment = [&](auto on) {
    return integral(whole, other, [&](const OverlapPoint& at) {
      const Vector3d p = on(at);
      return p[0] * p[0] + 2.0 * p[0] * p[1] - p[1];
    });
  };
  const double ours = moment([&](const OverlapPoint& at) { return place(whole, at.slave); });
  const double theirs = moment([&](const OverlapPoint& at) { return place(other, at.master); });
  CHECK(ours == Approx(theirs).epsilon(1e-13));
  // Cutting the master in two changes nothing: the rule is exact for these polynomials.
  const Vector3d half = (master[1] + master[2]) / 2;
  double pieces = 0.0;
  for (const Points& corners : {Points{master[0], master[1], half}, Points{master[0], half, master[2]}}) {
    const Points piece = straight(CellType::tria6, corners);
    pieces += integral(whole, facet(CellType::tria6, piece), [&](const OverlapPoint& at) {
      const Vector3d p = place(whole, at.slave);
      return p[0] * p[0] + 2.0 * p[0] * p[1] - p[1];
    });
  }
  CHECK(pieces == Approx(ours).epsilon(1e-13));
}

TEST_CASE("What a bent slave faces is decided by corners, and the master's part by its own normals") {
  // A roof z = -c x^2 over a plate at z = -1, whose edge is at x = 0.3: its foot on the plane of the slave's corners.
  constexpr double bend = 0.2, edge = 0.3;
  Points roof = straight(CellType::quad9, {{-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0}});
  for (Vector3d& node : roof) node[2] = -bend * node[0] * node[0];
  const Points plate = {{edge, -2, -1}, {3, -2, -1}, {3, 2, -1}, {edge, 2, -1}};
  const FacetOverlap overlap = facet_overlap(facet(CellType::quad9, roof), facet(CellType::quad4, plate));
  double covered = 0.0;
  for (const OverlapPoint& at : overlap.points) covered += at.weight;
  CHECK(covered == Approx(2.0 * (1.0 - edge)).epsilon(1e-14));
  // The normal at x leans by 2 c x, and meets the plate as much farther as it is deep below.
  const auto met = [&](double x) { return x - 2.0 * bend * x * (1.0 - bend * x * x); };
  double faced = 0.0;
  for (const FacePoint& at : overlap.master) faced += at.weight * facet_stretch(CellType::quad4, plate, at.xi, false);
  CHECK(faced == Approx(2.0 * (met(1.0) - met(edge))).epsilon(1e-13));
}

TEST_CASE("What the slaves of a grid face of a master adds up to its own, with its shape functions") {
  const Points master = {{0.1, 0.2, 0}, {1.7, 0.4, 0}, {1.5, 1.6, 0}, {0.3, 1.8, 0}};
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  const auto add = [&](CellType type, const Points& slave) {
    for (const FacePoint& at : facet_overlap(facet(type, slave), facet(CellType::quad4, master)).master)
      for (int i = 0; i < 4; ++i)
        sum[i] += at.weight * facet_stretch(CellType::quad4, master, at.xi, false) *
                  facet_shape(CellType::quad4, at.xi).values[static_cast<std::size_t>(i)];
  };
  const auto place = [](int i, int j) {
    const double x = 0.4 * i, y = 0.4 * j;
    const double skew = 0.05 * std::sin(2.0 * x) * std::sin(2.3 * y);
    return Vector3d(x + skew, y - 0.7 * skew, 0.3);
  };
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      const Points square = {place(i, j), place(i, j + 1), place(i + 1, j + 1), place(i + 1, j)};
      add(CellType::tria3, {square[0], square[1], square[2]});
      add(CellType::tria3, {square[0], square[2], square[3]});
    }
  Eigen::Vector4d whole = Eigen::Vector4d::Zero();
  for (const FacePoint& at : face_rule(CellType::quad4, ContactRule::gauss, 4))
    for (int i = 0; i < 4; ++i)
      whole[i] += at.weight * facet_stretch(CellType::quad4, master, at.xi, false) *
                  facet_shape(CellType::quad4, at.xi).values[static_cast<std::size_t>(i)];
  CHECK((sum - whole).norm() < 1e-13);
}

}  // namespace facet_overlap_test
