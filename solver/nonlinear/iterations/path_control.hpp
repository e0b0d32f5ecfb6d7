// How the intensity of driven loads is found when it is an unknown (path following, R5.03.80).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "solver/model/component.hpp"

namespace comma::solver {

/// What an increment of displacement must do in a step: `scale` times the measure of the increment is the length of the
/// step in time.
enum class PathMeasure : std::uint8_t {
  displacement,       ///< the sum of the controlled displacements (DDL_IMPO)
  arc_length,         ///< the length of a node's, as a quadratic mean over the nodes (LONG_ARC)
  strain,             ///< the largest change of strain at a point in the direction of its strain (DEFORMATION)
  elastic_prediction  ///< how far the elastic prediction lies beyond the yield surface where it does the most
                      ///< (PRED_ELAS)
};

/// Which solution is taken where the measure leaves two.
enum class PathChoice : std::uint8_t {
  smallest_increment,  ///< that of the smaller increment of displacement (NORM_INCR_DEPL)
  smallest_angle,      ///< that whose increment is nearest the direction of the last step's (ANGL_INCR_DEPL)
  smallest_residual,   ///< that which leaves the smaller residual (RESIDU)
  clear_residual       ///< that, where it is less than a tenth of the other, else that of the smaller increment (MIXTE)
};

/// Forces and imposed displacements read fixed(t) + intensity * driven(t).
struct PathControl {
  PathMeasure measure = PathMeasure::displacement;
  PathChoice choice = PathChoice::smallest_increment;
  double scale = 1.0;                 ///< COEF_MULT
  std::vector<int> nodes;             ///< of the controlled displacements; empty: all
  std::vector<Component> components;  ///< of the controlled displacements
  std::vector<int> cells;             ///< where strains or the elastic prediction are looked at; empty: everywhere
  bool grows = false;                 ///< EVOL_PARA='CROISSANT': the intensity never falls
  bool falls = false;                 ///< EVOL_PARA='DECROISSANT'
  double least_sought = -std::numeric_limits<double>::infinity();  ///< ETA_PILO_R_MIN: solutions below are passed over
  double most_sought = std::numeric_limits<double>::infinity();    ///< ETA_PILO_R_MAX
  double least = -std::numeric_limits<double>::infinity();         ///< ETA_PILO_MIN: the computation ends there
  double most = std::numeric_limits<double>::infinity();           ///< ETA_PILO_MAX
  bool stops_at_bound = true;  ///< PROJ_BORNES: the last step ends at the bound, not beyond it
};

}  // namespace comma::solver
