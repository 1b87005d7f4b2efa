#pragma once

#include <array>
#include <chrono>
#include <span>

#include "closest_pose.hpp"
#include "thing_kin/inverse/ik_descent.hpp"
#include "thing_kin/inverse/ik_samples.hpp"
#include "thing_kin/inverse/numeric_ik.hpp"

namespace thing_kin {

/// The ends of the attempts that came nearest, the nearest first.
class NearMisses {
 public:
  void add(const IkPoint& point) noexcept;
  std::span<IkPoint> nearest() noexcept { return {points_.data(), count_}; }

 private:
  std::array<IkPoint, 8> points_;
  std::size_t count_ = 0;
};

/// One solve of NumericIk: its attempts in order, and the best of them.
class IkSearch {
 public:
  IkSearch(const NumericIk& solver, const SE3& target, const double* seed) noexcept;

  IkResult run() noexcept;

 private:
  bool attempt(const JointVector& start) noexcept;
  bool restart() noexcept;
  bool ask_closed_form() noexcept;
  void search_nearer() noexcept;
  void wind(IkPoint& point) const noexcept;
  void settle(IkPoint& point) noexcept;
  double distance_from_seed(const JointVector& q) const noexcept;
  bool is_out_of_reach() const noexcept;
  bool has_more() const noexcept;
  double elapsed() const noexcept;
  IkResult found() noexcept;
  IkResult failed() noexcept;
  Rest come_nearest() noexcept;
  IkStatus reason(const Rest& rest) const noexcept;
  IkResult result(IkStatus status) const noexcept;

  const NumericIk& solver_;
  const IkOptions& options_;
  bool has_seed_;
  JointVector seed_;
  IkProblem problem_;
  IkSamples samples_;
  std::chrono::steady_clock::time_point begin_;
  IkPoint best_;
  NearMisses misses_;
  int iterations_ = 0;
  int attempts_ = 0;
  bool is_nearest_ = false;   // no other solution is nearer to the seed
  bool is_hopeless_ = false;  // there is no solution but within the tolerance of one
};

}  // namespace thing_kin
