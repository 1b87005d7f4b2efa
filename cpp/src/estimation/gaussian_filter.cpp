#include "thing_kin/estimation/gaussian_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "thing_kin/core/chi_square.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/symmetric_kernels.hpp"

namespace thing_kin {

namespace {

// The covariance as the filters keep one: exactly symmetric, and positive clear of rounding.
StateMatrix kept_covariance(const MatrixView& P, Eigen::Index n, const char* name) {
  check_covariance(P, n, name);
  StateMatrix kept = P;
  symmetrize(kept);
  keep_positive(kept);
  return kept;
}

}  // namespace

const char* name_of(FilterStatus status) noexcept {
  switch (status) {
    case FilterStatus::kOk:
      return "ok";
    case FilterStatus::kRejected:
      return "rejected";
    case FilterStatus::kMissing:
      return "missing";
    case FilterStatus::kSingular:
      return "singular";
    case FilterStatus::kNotPositive:
      return "not_positive";
    case FilterStatus::kNotFinite:
      break;
  }
  return "not_finite";
}

double FilterUpdate::log_likelihood() const noexcept {
  constexpr double kLogTwoPi = 1.8378770664093454836;
  return -0.5 * (nis + log_det + static_cast<double>(innovation.size()) * kLogTwoPi);
}

const double* KnownCovariance::operator()(const double* A, int n, const char* name) {
  const auto size = static_cast<std::size_t>(n * n);
  if (given_.rows() == n && std::memcmp(A, given_.data(), size * sizeof(double)) == 0) {
    return checked_.data();
  }
  const Eigen::Map<const Eigen::MatrixXd> matrix(A, n, n);
  checked_ = kept_covariance(matrix, n, name);
  given_ = matrix;
  return checked_.data();
}

double GateBound::operator()(double probability, int rows) {
  if (probability != probability_ || rows != rows_) {
    if (!(probability > 0.0 && probability <= 1.0)) {
      throw InvalidArgument("gate", text(probability), "a probability, above 0 and up to 1");
    }
    bound_ = chi_square_quantile(probability, rows);
    probability_ = probability;
    rows_ = rows;
  }
  return bound_;
}

GaussianFilter::GaussianFilter(const VectorView& x, const MatrixView& P, const AngleSet& angles) {
  if (x.size() < 1 || x.size() > kMaxState) {
    throw InvalidArgument("x", std::to_string(x.size()) + " entries",
                          "1 to " + std::to_string(kMaxState));
  }
  state_.angles = angles;
  state_.x.resize(x.size());
  set_x(x);
  set_P(P);
}

void GaussianFilter::set_x(const VectorView& x) {
  if (x.size() != state_.x.size() || !x.allFinite()) {
    throw InvalidArgument("x", "another size, NaN or infinity",
                          std::to_string(state_.x.size()) + " finite numbers");
  }
  state_.x = x;
  state_.angles.wrap(state_.x.data());
}

void GaussianFilter::note_transition(const double* F, const double* Q) noexcept {
  if (transition_ != nullptr && status_ == FilterStatus::kOk) {
    const int n = size();
    transition_->F = Eigen::Map<const ModelMatrix>(F, n, n);
    transition_->Q = Eigen::Map<const StateMatrix>(Q, n, n);
    transition_->x = state_.x;
  }
}

void GaussianFilter::set_P(const MatrixView& P) {
  state_.P = kept_covariance(P, state_.x.size(), "P");
}

}  // namespace thing_kin
