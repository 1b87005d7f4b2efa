#pragma once

// Steps of the filters whose models are functions.

#include "estimation/filter_run.hpp"

namespace thing_kin::python {

template <typename Filter>
bool predict_nonlinear(Filter& self, const MotionLike& f, const OptionalArray& Q,
                       const OptionalFunction& jacobian, const OptionalNumber& dt) {
  const Motion motion(f, jacobian, "jacobian", self.size());
  const double seconds = read_dt(dt, motion);
  StateMatrix storage;
  const StateMatrix* noise = read_noise(Q, motion, self.size(), storage);
  return motion.predict(self, noise, seconds) == FilterStatus::kOk;
}

template <typename Filter>
bool update_nonlinear(Filter& self, const ArrayLike& z, const MeasurementLike& h,
                      const ArrayLike& R, const OptionalFunction& jacobian,
                      const OptionalNumber& gate, const Indices& angles) {
  StateVector measured;
  StateMatrix noise;
  read_measurement(z, "z", measured);
  const auto m = static_cast<int>(measured.size());
  read_into(R, "R", m, noise);
  const Sensor sensor(h, jacobian, "jacobian", angles, self.size(), m);
  return sensor.update(self, measured, noise, read_gate(gate)) == FilterStatus::kOk;
}

/// What a run's models are.
struct RunModels {
  const MotionLike& f;
  const OptionalFunction& f_jacobian;
  const MeasurementLike& h;
  const OptionalFunction& h_jacobian;
  const OptionalArray& Q;
  const OptionalArray& dt;
};

template <typename Filter>
FilterRun run_nonlinear(Filter& self, const ArrayLike& record, const RunModels& models,
                        const ArrayLike& R, const OptionalNumber& gate, const Indices& angles,
                        bool smooth) {
  const int n = self.size();
  const Batch rows = read_record(record);
  const py::ssize_t count = rows.count;
  const auto m = static_cast<int>(rows.size);
  const Motion motion(models.f, models.f_jacobian, "f_jacobian", n, count);
  const Sensor sensor(models.h, models.h_jacobian, "h_jacobian", angles, n, m, count);
  const RunArguments arguments{rows, Rows(R, "R", {m, m}, count), read_gate(gate), smooth};
  StateMatrix storage(n, n);
  std::optional<Rows> noise;
  std::optional<Rows> seconds;
  if (!models.Q.is_none()) {
    noise.emplace(models.Q, "Q", std::vector<py::ssize_t>{n, n}, count);
  } else {
    read_noise(models.Q, motion, n, storage);  // says that it is missing
  }
  if (motion.is_model() && !models.dt.is_none()) {
    seconds.emplace(models.dt, "dt", std::vector<py::ssize_t>{}, count);
  } else {
    read_dt(py::reinterpret_borrow<OptionalNumber>(models.dt), motion);  // likewise
  }
  const auto predict_row = [&](Filter& filter, py::ssize_t i) {
    if (noise) {
      std::copy_n(noise->at(i), n * n, storage.data());
    }
    return motion.predict(filter, noise ? &storage : nullptr, seconds ? *seconds->at(i) : 0.0, i);
  };
  const auto update_row = [&](Filter& filter, py::ssize_t i, const StateVector& z,
                              const StateMatrix& covariance) {
    return sensor.update(filter, z, covariance, arguments.gate, i);
  };
  const bool python = motion.calls_python() || sensor.calls_python();
  return run_filter(self, arguments, python, predict_row, update_row);
}

}  // namespace thing_kin::python
