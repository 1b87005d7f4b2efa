#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "thing_kin/estimation/smoother.hpp"

namespace thing_kin {

/// Where a run over N rows writes: arrays of the caller's.
struct RunOutput {
  double* x = nullptr;             ///< (N, n)
  double* P = nullptr;             ///< (N, n, n)
  double* innovation = nullptr;    ///< (N, m), NaN without a measurement
  double* nis = nullptr;           ///< (N), likewise
  FilterStatus* status = nullptr;  ///< (N), of the prediction if that failed, else of the update
  double* x_smooth = nullptr;      ///< (N, n), or nullptr for no smoothing
  double* P_smooth = nullptr;      ///< (N, n, n)
  double log_likelihood = 0.0;     ///< the sum over what was accepted
};

/// One row's results.
inline void write_row(const GaussianFilter& filter, Eigen::Index row, int m, FilterStatus status,
                      bool seen, RunOutput& out) {
  const Eigen::Index n = filter.size();
  std::copy_n(filter.x().data(), n, out.x + row * n);
  std::copy_n(filter.P().data(), n * n, out.P + row * n * n);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const bool known = seen && filter.last().any && status != FilterStatus::kSingular;
  if (known) {
    std::copy_n(filter.last().innovation.data(), m, out.innovation + row * m);
  } else {
    std::fill_n(out.innovation + row * m, m, kNone);
  }
  out.nis[row] = known ? filter.last().nis : kNone;
  out.status[row] = status;
  if (status == FilterStatus::kOk && seen) {
    out.log_likelihood += filter.last().log_likelihood();
  }
}

/// For each row predict(i), then update(i, z) unless z, the row of the record (N, m), is NaN; then,
/// if asked for, the smoother. A step that fails leaves the state as it was, and the run goes on.
template <typename Filter, typename Predict, typename Update>
void run_record(Filter& filter, const double* record, Eigen::Index count, int m,
                const Predict& predict, const Update& update, RunOutput& out) {
  const int n = filter.size();
  const bool smooth = out.x_smooth != nullptr;
  std::optional<TransitionRecord> transitions;
  Transition transition;
  if (smooth) {
    transitions.emplace(n, count);
    filter.record_transitions(&transition);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    if (smooth) {  // a prediction that fails is none
      transition.F.setIdentity(n, n);
      transition.Q.setZero(n, n);
      transition.x = filter.x();
    }
    FilterStatus status = predict(i);
    if (smooth) {
      transitions->store(i, transition);
    }
    const double* z = record + i * m;
    const bool seen = !std::isnan(z[0]);
    if (seen) {
      const FilterStatus updated = update(i, z);
      status = status == FilterStatus::kOk ? updated : status;
    } else if (status == FilterStatus::kOk) {
      status = FilterStatus::kMissing;
    }
    write_row(filter, i, m, status, seen, out);
  }
  filter.record_transitions(nullptr);
  if (smooth) {
    smooth_record(*transitions, filter.angles(), count, n, out.x, out.P, out.x_smooth,
                  out.P_smooth);
  }
}

}  // namespace thing_kin
