#pragma once

#include "thing_kin/estimation/kalman.hpp"
#include "thing_kin/estimation/measurement_models.hpp"
#include "thing_kin/estimation/motion_models.hpp"

namespace thing_kin {

/// The extended Kalman filter, [M17] (3.24), (3.25), in Joseph's form.
///
/// Models of one's own are evaluated by the caller and come as numbers; those that derive from
/// MotionModel and MeasurementModel, as such. Errors and allocation as in KalmanFilter.
class ExtendedKalmanFilter : public GaussianFilter {
 public:
  using GaussianFilter::GaussianFilter;

  /// x <- fx, P <- F P F^T + Q; F is the model's Jacobian at x.
  FilterStatus predict(const StateVector& fx, const ModelMatrix& F, const StateMatrix& Q);

  /// Q == nullptr: what the model's own noise adds in dt seconds.
  FilterStatus predict(const MotionModel& model, double dt, const StateMatrix* Q = nullptr);

  /// hx is what is expected at x, H its Jacobian.
  FilterStatus update(const StateVector& z, const StateVector& hx, const ModelMatrix& H,
                      const StateMatrix& R, const UpdateOptions& options = {});

  /// The model knows its angles.
  FilterStatus update(const StateVector& z, const MeasurementModel& model, const StateMatrix& R,
                      double gate = 1.0);
};

/// Throw InvalidArgument where a model does not fit a filter's state: "f", "dt" or "h".
void check_model(const MotionModel& model, double dt, int n, const AngleSet& angles);
void check_model(const MeasurementModel& model, const StateVector& z, int n);

}  // namespace thing_kin
