#include "thing_kin/estimation/calibration_problem.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;

std::vector<int> postures_of(const CalibrationData& data) {
  std::vector<int> all(static_cast<std::size_t>(data.postures()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

CalibrationProblem::CalibrationProblem(Chain chain, CalibrationData data,
                                       std::vector<CalibrationParameter> parameters)
    : chain_(std::move(chain)), data_(std::move(data)), parameters_(std::move(parameters)) {
  if (parameters_.empty()) {
    throw InvalidArgument("parameters", "none that is free", "at least one");
  }
}

std::vector<int> CalibrationProblem::all_postures() const { return postures_of(data_); }

Eigen::VectorXd CalibrationProblem::nominal() const {
  Eigen::VectorXd numbers(static_cast<Index>(parameters_.size()));
  std::ranges::transform(parameters_, numbers.begin(), [&](const CalibrationParameter& parameter) {
    const auto& segments = chain_.description().segments;
    const auto row = [&] { return *dh_form(segments[static_cast<std::size_t>(parameter.place)]); };
    switch (parameter.part) {
      case CalibrationPart::kD:
        return row().d;
      case CalibrationPart::kTheta:
        return row().theta;
      case CalibrationPart::kA:
        return row().a;
      case CalibrationPart::kAlpha:
        return row().alpha;
      case CalibrationPart::kScale:
        return 1.0;
      case CalibrationPart::kPoint:
        return data_.points(parameter.axis, parameter.place);
      default:
        return 0.0;
    }
  });
  return numbers;
}

CalibrationFit CalibrationProblem::fit(const CalibrationOptions& options,
                                       std::span<const int> postures) const {
  CalibrationModel model(chain_, parameters_);
  return fit_calibration(model, data_, postures, options);
}

Eigen::VectorXd CalibrationProblem::errors(const CalibrationState& state,
                                           std::span<const int> postures) const {
  CalibrationModel model(chain_, parameters_);
  Eigen::VectorXd e;
  CalibrationResiduals(model, data_, postures).errors(state, e, nullptr);
  return e;
}

Chain CalibrationProblem::calibrated(const CalibrationState& state) const {
  CalibrationModel model(chain_, parameters_);
  model.set(state);
  return model.calibrated();
}

std::vector<bool> CalibrationProblem::told_at(const CalibrationFit& fit, const Eigen::MatrixXd& q,
                                              const Eigen::MatrixXd& torques) const {
  return calibration_sight(derivatives(fit, imagined(fit, q, torques)), parameters_).is_told;
}

std::vector<int> CalibrationProblem::most_telling_of(const CalibrationFit& fit,
                                                     const Eigen::MatrixXd& candidates,
                                                     const Eigen::MatrixXd& torques,
                                                     int count) const {
  const RowMajorMatrix J = derivatives(fit, imagined(fit, candidates, torques));
  return most_telling(J, data_.rows() * data_.per_posture(), parameters_, fit.sight.covariance,
                      count);
}

// Measurements without errors.
CalibrationData CalibrationProblem::imagined(const CalibrationFit& fit, const Eigen::MatrixXd& q,
                                             const Eigen::MatrixXd& torques) const {
  CalibrationData data = data_;
  data.q = q;
  data.torques = torques;
  data.covariances.resize(std::min<std::size_t>(data.covariances.size(), 1));
  data.joint_covariances.clear();
  data.seen.assign(static_cast<std::size_t>(q.cols() * data.per_posture()), true);
  data.poses.clear();
  data.places.resize(3, q.cols() * data.per_posture());
  CalibrationModel model(chain_, parameters_);
  model.set(fit.state);
  for (Index i = 0; i < q.cols(); ++i) {
    const Eigen::VectorXd torque = torques.size() > 0 ? torques.col(i).eval() : Eigen::VectorXd();
    const SE3 tool = model.tool(q.col(i), torque, nullptr, nullptr);
    data.poses.push_back(tool);
    for (Index point = 0; point < data.per_posture(); ++point) {
      const Eigen::Vector3d place = data.kind == CalibrationKind::kHits
                                        ? Eigen::Vector3d(Eigen::Vector3d::UnitZ())
                                        : Eigen::Vector3d(data.points.col(point));
      data.places.col(i * data.per_posture() + point) = tool * place;
    }
  }
  return data;
}

RowMajorMatrix CalibrationProblem::derivatives(const CalibrationFit& fit,
                                               const CalibrationData& data) const {
  CalibrationModel model(chain_, parameters_);
  const std::vector<int> all = postures_of(data);
  CalibrationResiduals residuals(model, data, all);
  residuals.weigh(fit.state, fit.noise);
  Eigen::VectorXd r;
  RowMajorMatrix J(residuals.rows(), residuals.size());
  residuals.evaluate(fit.state, r, &J);
  return J;
}

}  // namespace thing_kin
