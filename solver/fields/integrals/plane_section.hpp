// Area, centre and inertia of a section that is meshed in the plane (POST_ELEM, CARA_GEOM; U4.81.22).
#pragma once

#include <span>

#include <Eigen/Dense>

#include "solver/model/model.hpp"

namespace comma::solver {

/// Second moments about axes through a point: `first` the integral of the second coordinate squared (about the first
/// axis), `second` that of the first one squared, `product` that of both.
struct AreaMoments {
  double first = 0.0;
  double second = 0.0;
  double product = 0.0;
};

struct PlaneSection {
  double area = 0.0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  AreaMoments moments;  ///< about the centre
};

/// Of plane cells, by their places alone. Throws Error `empty-section` where they have no area.
PlaneSection plane_section(const Model& model, std::span<const int> cells);

/// A section and its image in the line y = 0 (`about_first`) or x = 0, as one.
PlaneSection with_image(const PlaneSection& half, bool about_first);

/// The moments about another point (Steiner).
AreaMoments moments_about(const PlaneSection& section, const Eigen::Vector2d& point);

/// The angle in radians, from -pi/2 to pi/2 and beyond up to pi, by which the first axis is turned to be that of the
/// least moment, and the moments about these axes.
struct PrincipalMoments {
  double angle = 0.0;
  double least = 0.0;
  double greatest = 0.0;
};
PrincipalMoments principal_moments(const AreaMoments& moments);

}  // namespace comma::solver
