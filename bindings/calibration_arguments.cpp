#include "calibration_arguments.hpp"

#include <algorithm>
#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin::python {

namespace {

using Eigen::Index;

constexpr double kFarthest = 1e6;  // m, rad: no robot goes farther, and no product overflows

void check_far(const Batch& batch, const char* name) {
  for (py::ssize_t i = 0; i < batch.count * batch.size; ++i) {
    if (std::abs(batch.data[i]) > kFarthest) {
      throw InvalidArgument(name, text(batch.data[i]), "numbers up to " + text(kFarthest));
    }
  }
}

Batch read_rows(const py::object& argument, const char* name, const std::vector<py::ssize_t>& item,
                py::ssize_t count, Finite finite = Finite::kYes) {
  Batch batch = read(argument, name, item, true, finite);
  if (batch.single || (count >= 0 && batch.count != count)) {
    std::vector<py::ssize_t> shape(item);
    if (!batch.single) {
      shape.insert(shape.begin(), batch.count);
    }
    throw InvalidArgument(
        name, "shape " + shape_text(shape.data(), static_cast<py::ssize_t>(shape.size())),
        std::string(count >= 0 ? std::to_string(count) : "N").append(" of ") +
            shape_text(item.data(), static_cast<py::ssize_t>(item.size())));
  }
  check_far(batch, name);
  return batch;
}

// Whether the item was measured: it is not if all of it is NaN. Anything else is refused.
bool is_seen(const Batch& batch, py::ssize_t i, py::ssize_t size, py::ssize_t per_posture = 1) {
  const double* const item = batch.data + i * size;
  const auto missing = std::count_if(item, item + size, [](double x) { return std::isnan(x); });
  const auto finite = std::count_if(item, item + size, [](double x) { return std::isfinite(x); });
  if (missing != size && finite != size) {
    std::string where = "NaN or inf at posture " + std::to_string(i / per_posture);
    if (per_posture > 1) {
      where.append(", point ").append(std::to_string(i % per_posture));
    }
    throw InvalidArgument("measured", where,
                          "finite numbers, or NaN for all of what was not measured");
  }
  return finite == size;
}

void read_poses(CalibrationData& data, const py::object& measured) {
  const Batch batch = read_rows(measured, "measured", {4, 4}, data.postures(), Finite::kNo);
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    data.seen.push_back(is_seen(batch, i, 16));
    data.poses.push_back(data.seen.back() ? read_pose(batch.item(i), "measured") : SE3{});
  }
}

void read_places(CalibrationData& data, const py::object& measured) {
  const py::ssize_t k = data.per_posture();
  const py::tuple shape = py::module_::import("numpy").attr("shape")(measured);
  const bool is_flat = shape.size() < 3;
  if (shape.size() == 3 && shape[2].cast<py::ssize_t>() == 3 && shape[1].cast<py::ssize_t>() != k) {
    throw InvalidArgument(
        "points", std::to_string(k),
        "as many as measured has of each posture, " + std::string(py::str(shape[1])));
  }
  const std::vector<py::ssize_t> item =
      is_flat && k == 1 ? std::vector<py::ssize_t>{3} : std::vector<py::ssize_t>{k, 3};
  const Batch batch = read_rows(measured, "measured", item, data.postures(), Finite::kNo);
  data.places.setZero(3, batch.count * k);
  for (py::ssize_t i = 0; i < batch.count * k; ++i) {
    data.seen.push_back(is_seen(batch, i, 3, k));
    if (data.seen.back()) {
      data.places.col(i) = Eigen::Map<const Eigen::Vector3d>(batch.data + 3 * i);
    }
  }
}

std::vector<Eigen::MatrixXd> read_covariances(const py::object& argument, const char* name,
                                              Index size, py::ssize_t count, bool positive) {
  std::vector<Eigen::MatrixXd> all;
  if (argument.is_none()) {
    return all;
  }
  const Batch batch = read(argument, name, {size, size});
  check_magnitude(batch, name);
  if (!batch.single && batch.count != count) {
    throw InvalidArgument(name, std::to_string(batch.count) + " covariances",
                          "one, or " + std::to_string(count));
  }
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    const Eigen::MatrixXd P = Eigen::Map<const RowMajorMatrix>(batch.item(i), size, size);
    check_covariance(P, size, name);
    constexpr double kLeastVariance = 1e-20;
    if (positive && !(is_positive(P) && P.diagonal().minCoeff() > kLeastVariance)) {
      throw InvalidArgument(name, "a covariance that is not positive definite",
                            "positive definite ones");
    }
    all.push_back(P);
  }
  return all;
}

CalibrationKind kind_of(const std::string& kind) {
  if (kind == "poses") {
    return CalibrationKind::kPoses;
  }
  if (kind == "points") {
    return CalibrationKind::kPoints;
  }
  if (kind == "hits") {
    return CalibrationKind::kHits;
  }
  throw InvalidArgument("kind", quoted(shortened(kind, 40)), "'poses', 'points' or 'hits'");
}

}  // namespace

SE3 read_one_pose(const py::object& argument, const char* name) {
  if (argument.is_none()) {
    return {};
  }
  const Batch batch = read(argument, name, {4, 4}, false);
  check_far(batch, name);
  return read_pose(batch.data, name);
}

CalibrationData read_calibration_data(const Chain& chain, const CalibrationArguments& arguments) {
  CalibrationData data;
  data.kind = kind_of(arguments.kind);
  const Batch rows = read_rows(arguments.q, "q", {chain.dof()}, -1);
  if (rows.count == 0) {
    throw InvalidArgument("q", "no posture", "at least one");
  }
  data.q = Eigen::Map<const Eigen::MatrixXd>(rows.data, chain.dof(), rows.count);
  if (!arguments.points.is_none()) {
    const Batch places = read_rows(arguments.points, "points", {3}, -1);
    if (places.count == 0) {
      throw InvalidArgument("points", "no point", "at least one");
    }
    data.points = Eigen::Map<const Eigen::Matrix3Xd>(places.data, 3, places.count);
  }
  if (data.kind == CalibrationKind::kPoses) {
    read_poses(data, arguments.measured);
  } else {
    read_places(data, arguments.measured);
  }
  const auto blocks = static_cast<py::ssize_t>(data.seen.size());
  data.covariances =
      read_covariances(arguments.covariance, "covariance", data.rows(), blocks, true);
  data.joint_covariances =
      read_covariances(arguments.q_covariance, "q_covariance", chain.dof(), rows.count, false);
  if (!arguments.torques.is_none()) {
    const Batch loads = read_rows(arguments.torques, "torques", {chain.dof()}, rows.count);
    data.torques = Eigen::Map<const Eigen::MatrixXd>(loads.data, chain.dof(), loads.count);
  }
  return data;
}

Eigen::MatrixXd read_postures(const py::object& argument, const char* name, int dof) {
  if (argument.is_none()) {
    return {};
  }
  const Batch rows = read_rows(argument, name, {dof}, -1);
  return Eigen::Map<const Eigen::MatrixXd>(rows.data, dof, rows.count);
}

Array read_numbers(const py::object& argument, const std::string& name,
                   const std::vector<py::ssize_t>& item, bool several, bool is_covariance) {
  const Batch batch = read(argument, name.c_str(), item, several);
  check_far(batch, name.c_str());
  std::vector<py::ssize_t> shape(item);
  if (!batch.single) {
    shape.insert(shape.begin(), batch.count);
  }
  Array numbers = make_array(shape.data(), static_cast<int>(shape.size()));
  std::copy_n(batch.data, batch.count * batch.size, numbers.mutable_data());
  for (py::ssize_t i = 0; is_covariance && i < batch.count; ++i) {
    check_covariance(Eigen::Map<const RowMajorMatrix>(batch.item(i), item[0], item[1]), item[0],
                     name);
  }
  return numbers;
}

CalibrationOptions read_calibration_options(const std::string& loss,
                                            const std::optional<double>& loss_scale, double gate,
                                            int max_iterations, const py::object& base,
                                            const py::object& tool) {
  CalibrationOptions options;
  options.loss = calibration_loss_from_string(loss);
  if (loss_scale) {
    if (!(*loss_scale > 0.0 && std::isfinite(*loss_scale))) {
      throw InvalidArgument("loss_scale", text(*loss_scale), "a number > 0");
    }
    options.loss_scale = *loss_scale;
  }
  if (!(gate > 0.0 && gate < 1.0)) {
    throw InvalidArgument("gate", text(gate), "a probability between 0 and 1");
  }
  if (max_iterations < 1) {
    throw InvalidArgument("max_iterations", std::to_string(max_iterations), "at least 1");
  }
  options.gate = gate;
  options.max_iterations = max_iterations;
  options.base = read_one_pose(base, "base");
  options.tool = read_one_pose(tool, "tool");
  return options;
}

}  // namespace thing_kin::python
