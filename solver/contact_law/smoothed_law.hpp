// Contact and friction at a point by a law that is smooth.
#pragma once

#include <Eigen/Dense>

#include "solver/contact_law/contact_law.hpp"

namespace comma::solver {

/// What a point resists by along its normal and along the surface, through the bodies and its penalty: a pressure over
/// a length, or 0.
struct PointStiffness {
  double normal = 0.0, along = 0.0;
};

/// How far the law of a point is from the one that it stands for.
struct LawSmoothing {
  double pressure = 0.0;  ///< by which pressures and limits of friction are rounded off
  /// Of the augmentations of the law, beside those of the bodies: 0 to 1, in decades.
  double law_share = 1.0, law_share_along = 1.0;
  bool stays_closed = false;
  bool rubs = false;
  bool on_node = true;  ///< alone on it
};

/// By how much what is left of the law counts as a length: gaps and slips by themselves, tractions by what the bodies
/// give way under them.
struct SmoothedLawValue : ContactLawValue {
  double counts = 1.0, counts_along = 1.0;
};

/// contact_law() without statuses: max(0, x) is that of Chen, Harker, Kanzow and Smale (C. Chen and O. L. Mangasarian,
/// Computational Optimization and Applications 5, 1996). A penalty is a law with a multiplier all the same, by which a
/// gap is closed but for what the penalty gives way: however stiff, it does no harm.
class SmoothedLaw {
 public:
  SmoothedLaw(const ContactLaw& law, PointStiffness bodies, const LawSmoothing& smoothing);

  SmoothedLawValue at(const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump) const;
  /// The status that contact_law() has there.
  ContactStatus status(const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump) const;

 private:
  struct PositivePart;
  struct Shear;

  double trial_pressure(const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump) const;
  Eigen::Vector2d trial_shear(const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump) const;
  Shear live_shear(const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump, double limit) const;
  static Shear shear_of(const Eigen::Vector2d& trial, double limit, double e);
  void add_shear(const PositivePart& pressure, const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump,
                 SmoothedLawValue& result) const;
  void let_open_shears_vanish(const PositivePart& pressure, const Eigen::Vector3d& multiplier,
                              SmoothedLawValue& result) const;

  ContactLaw law_;
  PointStiffness bodies_;
  LawSmoothing smoothing_;
  double stiffness_, stiffness_along_;          ///< augmentations
  double by_multiplier_, by_multiplier_along_;  ///< shares of trials
};

}  // namespace comma::solver
