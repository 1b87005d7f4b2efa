#include "thing_kin/estimation/extended_kalman.hpp"

#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/estimation/linear_steps.hpp"
#include "thing_kin/estimation/step_checks.hpp"

namespace thing_kin {

void check_model(const MotionModel& model, double dt, int n, const AngleSet& angles) {
  if (model.size() != n) {
    throw InvalidArgument("f", model.name() + " of " + std::to_string(model.size()) + " variables",
                          "a model of " + std::to_string(n));
  }
  if (!(model.angles() == angles)) {
    throw InvalidArgument("f", model.name() + ", whose angles are not the filter's",
                          "a filter made with angles=model.angles");
  }
  if (!(std::isfinite(dt) && dt >= 0.0)) {
    throw InvalidArgument("dt", text(dt), "a finite number of seconds from 0");
  }
}

void check_model(const MeasurementModel& model, const StateVector& z, int n) {
  check_measurement(z);
  if (model.rows() != z.size()) {
    throw InvalidArgument("z", std::to_string(z.size()) + " entries", std::to_string(model.rows()));
  }
  if (model.least_size() > n) {
    throw InvalidArgument("h",
                          model.name() + " of a state with " + std::to_string(model.least_size()) +
                              " entries or more",
                          "a model of " + std::to_string(n));
  }
}

FilterStatus ExtendedKalmanFilter::predict(const StateVector& fx, const ModelMatrix& F,
                                           const StateMatrix& Q) {
  const int n = size();
  check_vector(fx, n, "f(x)");
  check_matrix(F, n, n, "jacobian(x)");
  check_square(Q, n, "Q");
  const double* noise = known_Q_(Q.data(), n, "Q");
  done(predict_linear(state_, fx.data(), F.data(), noise));
  note_transition(F.data(), noise);
  return status_;
}

FilterStatus ExtendedKalmanFilter::predict(const MotionModel& model, double dt,
                                           const StateMatrix* Q) {
  const int n = size();
  check_model(model, dt, n, state_.angles);
  StateVector fx(n);
  ModelMatrix F(n, n);
  StateMatrix own;
  const double* noise = nullptr;
  if (Q != nullptr) {
    check_square(*Q, n, "Q");
    noise = known_Q_(Q->data(), n, "Q");
  } else {
    own.resize(n, n);
    model.noise(state_.x.data(), dt, own.data());
    noise = own.data();
  }
  model.linearize(state_.x.data(), dt, fx.data(), F.data());
  done(predict_linear(state_, fx.data(), F.data(), noise));
  note_transition(F.data(), noise);
  return status_;
}

FilterStatus ExtendedKalmanFilter::update(const StateVector& z, const StateVector& hx,
                                          const ModelMatrix& H, const StateMatrix& R,
                                          const UpdateOptions& options) {
  check_measurement(z);
  const int m = static_cast<int>(z.size());
  check_vector(hx, m, "h(x)");
  check_matrix(H, m, size(), "jacobian(x)");
  check_square(R, m, "R");
  StateVector residual(m);
  options.angles.difference(z.data(), hx.data(), residual.data(), m);
  const LinearMeasurement measured{m, residual.data(), H.data(), known_R_(R.data(), m, "R")};
  return done(update_linear(state_, measured, gate_bound_(options.gate, m), last_));
}

FilterStatus ExtendedKalmanFilter::update(const StateVector& z, const MeasurementModel& model,
                                          const StateMatrix& R, double gate) {
  const int n = size();
  check_model(model, z, n);
  const int m = model.rows();
  check_square(R, m, "R");
  StateVector residual(m);
  ModelMatrix H(m, n);
  model.evaluate(state_.x.data(), residual.data());
  model.jacobian(state_.x.data(), n, H.data());
  model.angles().difference(z.data(), residual.data(), residual.data(), m);
  const LinearMeasurement measured{m, residual.data(), H.data(), known_R_(R.data(), m, "R")};
  return done(update_linear(state_, measured, gate_bound_(gate, m), last_));
}

}  // namespace thing_kin
