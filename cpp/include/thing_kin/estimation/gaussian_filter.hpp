#pragma once

#include <cstdint>
#include <string>

#include "thing_kin/estimation/angle_set.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin {

/// The most entries of a filter's state, and of a measurement. A step's matrices are bounded by it:
/// nothing there allocates.
inline constexpr int kMaxState = 16;

using StateVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxState, 1>;
using StateMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxState, kMaxState>;
/// A Jacobian or a linear model, in rows, as numpy has it.
using ModelMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMaxState, kMaxState>;

/// What came of a step. All but kOk leave the state as it was.
enum class FilterStatus : std::uint8_t {
  kOk,
  kRejected,     ///< by the gate
  kMissing,      ///< no measurement in this row of a record
  kSingular,     ///< the innovation has no positive covariance
  kNotPositive,  ///< the state's covariance would lose positivity
  kNotFinite,    ///< numbers would overflow
};

const char* name_of(FilterStatus status) noexcept;

/// A state and how uncertain it is.
struct Gaussian {
  StateVector x;
  StateMatrix P;
  AngleSet angles;

  int size() const noexcept { return static_cast<int>(x.size()); }
};

/// What the last update saw, also if it was rejected.
struct FilterUpdate {
  StateVector innovation;  ///< (m), z minus what was expected
  StateMatrix S;           ///< (m, m), the innovation's covariance
  StateMatrix K;           ///< (n, m), the gain
  double nis = 0.0;        ///< normalized innovation squared
  double log_det = 0.0;    ///< ln det S
  bool accepted = false;
  bool any = false;  ///< there was one

  double log_likelihood() const noexcept;
};

/// A covariance that was checked stays known: control loops pass the same one again and again.
class KnownCovariance {
 public:
  /// A (n, n), made symmetric and kept positive. Throws InvalidArgument(name, ...) if it is none.
  const double* operator()(const double* A, int n, const char* name);

 private:
  StateMatrix given_, checked_;
};

/// A gate's probability as a bound of the NIS, computed when it changes.
class GateBound {
 public:
  /// Infinite for no gate, 1. Throws InvalidArgument("gate", ...) unless 0 < probability <= 1.
  double operator()(double probability, int rows);

 private:
  double probability_ = 1.0;
  int rows_ = 0;
  double bound_ = 0.0;
};

/// A prediction as the smoother wants it: x' = F x + noise, linear or linearized statistically.
struct Transition {
  ModelMatrix F;  ///< (n, n)
  StateMatrix Q;  ///< (n, n), of the noise and of what is not linear
  StateVector x;  ///< predicted
};

/// What the filters share: a Gaussian, its angles, and the last update.
class GaussianFilter {
 public:
  /// Throws InvalidArgument naming x, P or angles.
  GaussianFilter(const VectorView& x, const MatrixView& P, const AngleSet& angles = {});

  int size() const noexcept { return state_.size(); }
  const StateVector& x() const noexcept { return state_.x; }
  const StateMatrix& P() const noexcept { return state_.P; }
  const AngleSet& angles() const noexcept { return state_.angles; }
  const FilterUpdate& last() const noexcept { return last_; }
  FilterStatus status() const noexcept { return status_; }

  /// Throw InvalidArgument naming x or P.
  void set_x(const VectorView& x);
  void set_P(const MatrixView& P);

  /// Where predictions are written down from now on; nullptr, as at first, for nowhere.
  void record_transitions(Transition* transition) noexcept { transition_ = transition; }

 protected:
  /// Writes down a prediction that went well.
  void note_transition(const double* F, const double* Q) noexcept;
  FilterStatus done(FilterStatus status) noexcept { return status_ = status; }

  Gaussian state_;
  FilterUpdate last_;
  KnownCovariance known_Q_, known_R_;
  GateBound gate_bound_;
  FilterStatus status_ = FilterStatus::kOk;
  Transition* transition_ = nullptr;
};

}  // namespace thing_kin
