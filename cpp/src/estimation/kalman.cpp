#include "thing_kin/estimation/kalman.hpp"

#include <string>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/finite.hpp"
#include "thing_kin/estimation/linear_steps.hpp"
#include "thing_kin/estimation/step_checks.hpp"

namespace thing_kin {

namespace {

void check_shape(Eigen::Index rows, Eigen::Index cols, Eigen::Index r, Eigen::Index c,
                 const char* name) {
  if (rows != r || cols != c) {
    const auto shape = [](Eigen::Index a, Eigen::Index b) {
      return std::string("(").append(std::to_string(a)).append(", ").append(std::to_string(b)) +
             ")";
    };
    throw InvalidArgument(name, std::string("shape ").append(shape(rows, cols)), shape(r, c));
  }
}

void check_numbers(const double* numbers, Eigen::Index count, const char* name) {
  if (!all_finite(numbers, static_cast<std::size_t>(count))) {
    throw InvalidArgument(name, "NaN or infinity", "finite numbers");
  }
}

}  // namespace

void check_matrix(const ModelMatrix& A, Eigen::Index rows, Eigen::Index cols, const char* name) {
  check_shape(A.rows(), A.cols(), rows, cols, name);
  check_numbers(A.data(), A.size(), name);
}

void check_square(const StateMatrix& A, Eigen::Index n, const char* name) {
  check_shape(A.rows(), A.cols(), n, n, name);
}

void check_vector(const StateVector& v, Eigen::Index size, const char* name) {
  if (v.size() != size) {
    throw InvalidArgument(name, std::to_string(v.size()) + " entries", std::to_string(size));
  }
  check_numbers(v.data(), v.size(), name);
}

void check_measurement(const StateVector& z) {
  if (z.size() < 1) {
    throw InvalidArgument("z", "no entries", "1 to " + std::to_string(kMaxState));
  }
  check_numbers(z.data(), z.size(), "z");
}

FilterStatus KalmanFilter::predict(const ModelMatrix& F, const StateMatrix& Q,
                                   const StateVector& offset) {
  const int n = size();
  check_matrix(F, n, n, "F");
  check_square(Q, n, "Q");
  StateVector fx(n);
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j) {
      sum += F.data()[i * n + j] * state_.x.data()[j];
    }
    fx.data()[i] = sum;
  }
  if (offset.size() > 0) {
    check_vector(offset, n, "offset");
    fx += offset;
  }
  const double* noise = known_Q_(Q.data(), n, "Q");
  done(predict_linear(state_, fx.data(), F.data(), noise));
  note_transition(F.data(), noise);
  return status_;
}

FilterStatus KalmanFilter::update(const StateVector& z, const ModelMatrix& H, const StateMatrix& R,
                                  const UpdateOptions& options) {
  check_measurement(z);
  const int n = size();
  const int m = static_cast<int>(z.size());
  check_matrix(H, m, n, "H");
  check_square(R, m, "R");
  StateVector residual(m);
  for (int i = 0; i < m; ++i) {
    double expected = 0.0;
    for (int j = 0; j < n; ++j) {
      expected += H.data()[i * n + j] * state_.x.data()[j];
    }
    residual.data()[i] = z.data()[i] - expected;
  }
  options.angles.wrap(residual.data());
  const LinearMeasurement measured{m, residual.data(), H.data(), known_R_(R.data(), m, "R")};
  return done(update_linear(state_, measured, gate_bound_(options.gate, m), last_));
}

}  // namespace thing_kin
