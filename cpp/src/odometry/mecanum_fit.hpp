#pragma once

#include <array>
#include <vector>

#include "reference_windows.hpp"

namespace thing_kin {

/// The noise of wheels and reference as the record itself shows it.
struct RecordNoise {
  Eigen::Vector3d slip = Eigen::Vector3d::Constant(1e-4);  ///< for each metre of travel
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();     ///< added to each window's own variance
};

/// Least squares over successive relative motions; wheels and reference in one state of knowledge.
class MecanumFit {
 public:
  MecanumFit(const ReferenceRecord& reference, WheelPath wheels,
             const MecanumIdentificationOptions& options);

  /// Parameters as MecanumVector lists them, their prior, and which are held.
  MecanumVector x, prior, prior_std;
  std::array<bool, kMecanumParameters> held{};
  RecordNoise noise;

  /// Windows and motions for the present parameters.
  void linearize();
  void estimate_noise(bool outliers_known);
  void weigh();
  void rescale();

  /// First values of all that is not held: from the medians of ratios and directions.
  void guess();

  /// One Gauss-Newton step; returns its largest entry relative to the standard deviation.
  double step();

  /// Covariance of x, those that are held at their prior's.
  MecanumMatrix covariance() const;

  /// Dead reckoning from the first window to each later one.
  std::vector<RelativeMotion> from_start() const;
  Eigen::Matrix3d covariance_of(const RelativeMotion& motion, std::size_t from,
                                std::size_t to) const;

  const std::vector<ReferenceWindow>& windows() const { return windows_; }
  const std::vector<double>& weights() const { return weights_; }
  const WheelPath& wheels() const { return wheels_; }
  Pose2 mount() const { return x.segment<3>(2); }
  std::size_t used() const;
  double travel() const;

 private:
  struct Normal {
    MecanumMatrix H = MecanumMatrix::Zero();
    MecanumVector g = MecanumVector::Zero();
    double chi2 = 0.0;
  };
  Normal normal_equations() const;
  Normal with_prior(Normal normal) const;

  ReferenceRecord reference_;
  WheelPath wheels_;
  double window_;
  double scale_ = 1.0;  // of all variances, so that residuals are as large as they say
  std::vector<ReferenceWindow> windows_;
  std::vector<WheelMotion> rolled_;
  std::vector<RelativeMotion> motions_;
  std::vector<double> weights_;  // of each motion; 0: not used
};

}  // namespace thing_kin
