#include "thing_kin/inverse/ik_samples.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "thing_kin/kinematics/batch.hpp"

namespace thing_kin {

namespace {

constexpr int kCandidates = 16;

// Limits farther apart than this, rad or m, are a way to write that there are none.
constexpr double kLimitless = 1e4;

// What is sampled of [lower, upper]: a turn of a joint without limits, and of a slide without
// limits one length of the arm to either side; about zero, or as near to it as may be.
void finite_range(bool rotary, double length, double& lower, double& upper) {
  if (upper - lower <= kLimitless) {
    return;
  }
  const double half = rotary ? std::numbers::pi : std::max(length, 1.0);
  lower = std::clamp(-half, lower, std::max(lower, upper - 2.0 * half));
  upper = std::min(upper, lower + 2.0 * half);
}

}  // namespace

IkSamples::IkSamples(const IkProblem& problem, const LowDiscrepancy& sequence,
                     const Reach& reach) noexcept
    : problem_(problem), sequence_(sequence), reach_(reach) {
  const Eigen::Index n = problem.chain.dof();
  lower_.resize(n);
  range_.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    double lower = problem.box.lower(j);
    double upper = problem.box.upper(j);
    finite_range(problem.box.is_rotary(j), reach.length(), lower, upper);
    lower_[j] = lower;
    range_[j] = upper - lower;
  }
}

JointVector IkSamples::middle() const noexcept {
  JointVector q = lower_ + 0.5 * range_;
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    q[j] = problem_.box.inside(j, q[j]);  // but for rounding it is
  }
  return q;
}

void IkSamples::draw(double* q) noexcept {
  ++drawn_;
  for (Eigen::Index j = 0; j < lower_.size(); ++j) {
    const double x = lower_[j] + sequence_(drawn_, static_cast<int>(j)) * range_[j];
    q[j] = std::clamp(x, problem_.box.lower(j), problem_.box.upper(j));
  }
}

void IkSamples::next(JointVector& q) noexcept {
  const Eigen::Index n = lower_.size();
  std::array<double, std::size_t{kCandidates} * kMaxDof> candidates;
  alignas(64) std::array<double, std::size_t{kCandidates} * 16> poses;
  for (Eigen::Index i = 0; i < kCandidates; ++i) {
    draw(candidates.data() + i * n);
  }
  forward_kinematics(problem_.chain, {candidates.data(), kCandidates, 1}, problem_.frame,
                     PoseFormat::kMatrix, poses.data());
  double least = std::numeric_limits<double>::infinity();
  Eigen::Index best = 0;
  for (Eigen::Index i = 0; i < kCandidates; ++i) {
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(poses.data() + 16 * i);
    const SE3& target = problem_.residual.target();
    Eigen::Vector3d way = problem_.residual.way_from(T.topRightCorner<3, 1>());
    reach_.drive(problem_.box, 0.0, way, candidates.data() + i * n);
    const double turned = 3.0 - target.rotation.cwiseProduct(T.topLeftCorner<3, 3>()).sum();
    const double cost = problem_.residual.rough_cost(way, turned);
    if (cost < least) {
      least = cost;
      best = i;
    }
  }
  q = Eigen::Map<const Eigen::VectorXd>(candidates.data() + best * n, n);
}

}  // namespace thing_kin
