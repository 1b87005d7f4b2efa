#pragma once

#include <memory>
#include <string>
#include <vector>

#include "thing_kin/estimation/gaussian_filter.hpp"

namespace thing_kin {

/// What is measured of a state, with its exact Jacobian. Arrays are bare: x (n), z (m), H (m, n) in
/// rows. Angles need not be wrapped.
class MeasurementModel {
 public:
  virtual ~MeasurementModel() = default;
  MeasurementModel(const MeasurementModel&) = delete;
  MeasurementModel& operator=(const MeasurementModel&) = delete;
  MeasurementModel(MeasurementModel&&) = delete;
  MeasurementModel& operator=(MeasurementModel&&) = delete;

  const std::string& name() const noexcept { return name_; }
  int rows() const noexcept { return rows_; }
  /// How many entries a state must have at least.
  int least_size() const noexcept { return least_size_; }
  /// Of the measurement.
  const AngleSet& angles() const noexcept { return angles_; }

  virtual void evaluate(const double* x, double* z) const noexcept = 0;
  virtual void jacobian(const double* x, int n, double* H) const noexcept = 0;

 protected:
  MeasurementModel(std::string name, int rows, int least_size, const AngleSet& angles);

 private:
  std::string name_;
  int rows_, least_size_;
  AngleSet angles_;
};

using MeasurementModelPtr = std::shared_ptr<const MeasurementModel>;

/// Entries of the state as they are. `angles` are indices into the measurement. Throws
/// InvalidArgument("indices" or "angles", ...).
MeasurementModelPtr components(const std::vector<int>& indices,
                               const std::vector<int>& angles = {});

/// Distance and bearing, m and rad, of a landmark from a planar pose (x, y, theta), the state's
/// first three entries. Throws InvalidArgument("landmark", ...) unless it is finite.
MeasurementModelPtr range_bearing(const Eigen::Vector2d& landmark);

}  // namespace thing_kin
