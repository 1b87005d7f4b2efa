#include "thing_kin/inverse/numeric_ik.hpp"

#include <algorithm>

#include "ik_search.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/core/parallel.hpp"

namespace thing_kin {

namespace {

// The part of all links' lengths that as a position error weighs as much as one radian. Flat
// between 0.2 and 0.6.
constexpr double kLengthPerRadian = 0.3;

// Links shorter than this are none, but rounding.
constexpr double kLeastLength = 1e-9;

// A thread costs some tens of microseconds, a target about ten.
constexpr std::size_t kTargetsPerThread = 16;

JointVector inverse_weights(const JointVector& weights, int n) {
  if (weights.size() == 0) {
    return JointVector::Ones(n);
  }
  return weights.cwiseInverse();
}

IkOptions checked(IkOptions options, const Chain& chain) {
  options.check(chain);
  return options;
}

void store(const IkResult& result, std::size_t i, const IkBatchResult& results) {
  const auto n = static_cast<std::size_t>(result.q.size());
  std::copy_n(result.q.data(), n, results.q + i * n);
  std::copy_n(result.active_limits.data(), n, results.active_limits + i * n);
  results.status[i] = static_cast<std::uint8_t>(result.status);
  results.position_error[i] = result.position_error;
  results.rotation_error[i] = result.rotation_error;
  results.iterations[i] = result.iterations;
  results.restarts[i] = result.restarts;
  results.time[i] = result.time;
}

}  // namespace

NumericIk::NumericIk(const Chain& chain, int frame, IkOptions options)
    : chain_(chain),
      frame_(frame),
      options_(checked(std::move(options), chain)),
      mobility_(inverse_weights(options_.joint_weights, chain.dof())),
      box_(chain),
      reach_(chain, frame),
      length_(reach_.length() > kLeastLength ? kLengthPerRadian * reach_.length() : 1.0),
      samples_(chain.dof(), options_.rng) {
  const auto& weight = options_.weights.weight;
  const bool whole_pose = std::ranges::find(weight, 0.0) == weight.end();
  if (options_.closed_form && whole_pose && !chain.base_joints()) {
    closed_form_ = ClosedFormIk::find(chain, frame);
  }
}

IkResult NumericIk::solve(const SE3& target, const double* seed) const noexcept {
  return IkSearch(*this, target, seed).run();
}

void NumericIk::solve(const IkBatch& batch, const IkBatchResult& results) const {
  const int threads = thread_count(batch.threads, batch.count, kTargetsPerThread);
  const std::size_t stride = batch.one_seed ? 0 : static_cast<std::size_t>(chain_.dof());
  parallel_ranges(batch.count, threads, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const double* seed = batch.seeds == nullptr ? nullptr : batch.seeds + i * stride;
      store(solve(batch.targets[i], seed), i, results);
    }
  });
}

}  // namespace thing_kin
