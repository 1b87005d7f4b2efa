#include "thing_kin/estimation/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "array.hpp"
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

SE3 read_one_pose(const py::object& argument, const char* name) {
  if (argument.is_none()) {
    return {};
  }
  const Batch batch = read(argument, name, {4, 4}, false);
  check_far(batch, name);
  return read_pose(batch.data, name);
}

// Whether the item was measured: it is not if all of it is NaN. Anything else is refused.
bool is_seen(const Batch& batch, py::ssize_t i, py::ssize_t size) {
  const double* const item = batch.data + i * size;
  const auto missing = std::count_if(item, item + size, [](double x) { return std::isnan(x); });
  const auto finite = std::count_if(item, item + size, [](double x) { return std::isfinite(x); });
  if (missing != size && finite != size) {
    throw InvalidArgument("measured", "NaN or inf in measurement " + std::to_string(i),
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
  const bool is_flat =
      py::cast<py::ssize_t>(py::module_::import("numpy").attr("ndim")(measured)) < 3;
  const std::vector<py::ssize_t> item =
      is_flat && k == 1 ? std::vector<py::ssize_t>{3} : std::vector<py::ssize_t>{k, 3};
  const Batch batch = read_rows(measured, "measured", item, data.postures(), Finite::kNo);
  data.places.setZero(3, batch.count * k);
  for (py::ssize_t i = 0; i < batch.count * k; ++i) {
    data.seen.push_back(is_seen(batch, i, 3));
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

const char* status_of(CalibrationStatus status) {
  switch (status) {
    case CalibrationStatus::kConverged:
      return "converged";
    case CalibrationStatus::kNotConverged:
      return "not converged";
    case CalibrationStatus::kUnderdetermined:
      break;
  }
  return "underdetermined";
}

Array pose_array(const SE3& T) {
  const py::ssize_t shape[] = {4, 4};
  Array array = make_array(shape, 2);
  write_pose(T, array.mutable_data());
  return array;
}

Array bools(const std::vector<bool>& flags) {
  const auto n = static_cast<py::ssize_t>(flags.size());
  Array array = make_array(&n, 1);
  std::ranges::copy(flags, array.mutable_data());
  return array;
}

// What calibrate() of Python asks, step by step.
class Problem {
 public:
  Problem(const Chain& chain, const py::object& q, const std::string& kind,
          const py::object& measured, const py::object& points, const py::object& covariance,
          const py::object& q_covariance, const py::object& torques, CalibrationRequest request)
      : chain_(chain) {
    data_.kind = kind_of(kind);
    const Batch rows = read_rows(q, "q", {chain.dof()}, -1);
    if (rows.count == 0) {
      throw InvalidArgument("q", "no posture", "at least one");
    }
    data_.q = Eigen::Map<const Eigen::MatrixXd>(rows.data, chain.dof(), rows.count);
    if (!points.is_none()) {
      const Batch places = read_rows(points, "points", {3}, -1);
      if (places.count == 0) {
        throw InvalidArgument("points", "no point", "at least one");
      }
      data_.points = Eigen::Map<const Eigen::Matrix3Xd>(places.data, 3, places.count);
    }
    if (data_.kind == CalibrationKind::kPoses) {
      read_poses(data_, measured);
    } else {
      read_places(data_, measured);
    }
    const auto blocks = static_cast<py::ssize_t>(data_.seen.size());
    data_.covariances = read_covariances(covariance, "covariance", data_.rows(), blocks, true);
    data_.joint_covariances =
        read_covariances(q_covariance, "q_covariance", chain.dof(), rows.count, false);
    if (!torques.is_none()) {
      const Batch loads = read_rows(torques, "torques", {chain.dof()}, rows.count);
      data_.torques = Eigen::Map<const Eigen::MatrixXd>(loads.data, chain.dof(), loads.count);
    }
    request.points =
        data_.kind == CalibrationKind::kPoints ? static_cast<int>(data_.points.cols()) : 0;
    parameters_ = calibration_parameters(chain, request);
    if (parameters_.empty()) {
      throw InvalidArgument("parameters", "none that is free", "at least one");
    }
  }

  const std::vector<CalibrationParameter>& parameters() const { return parameters_; }

  CalibrationFit fit(const CalibrationOptions& options, const std::vector<int>& postures) const {
    CalibrationModel model(chain_, parameters_);
    return fit_calibration(model, data_, postures, options);
  }

  Eigen::VectorXd errors(const CalibrationState& state, const std::vector<int>& postures) const {
    CalibrationModel model(chain_, parameters_);
    Eigen::VectorXd e;
    CalibrationResiduals(model, data_, postures).errors(state, e, nullptr);
    return e;
  }

  // The same kind of measurement at other postures, as it would be without errors.
  CalibrationData imagined(const CalibrationFit& fit, const Eigen::MatrixXd& q,
                           const Eigen::MatrixXd& torques) const {
    CalibrationData data = data_;
    data.q = q;
    data.torques = torques;
    data.covariances =
        data_.covariances.empty() ? data_.covariances : std::vector{data_.covariances.front()};
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

  RowMajorMatrix derivatives(const CalibrationFit& fit, const CalibrationData& data) const {
    CalibrationModel model(chain_, parameters_);
    std::vector<int> all(static_cast<std::size_t>(data.postures()));
    std::iota(all.begin(), all.end(), 0);
    CalibrationResiduals residuals(model, data, all);
    residuals.weigh(fit.state, fit.noise);
    Eigen::VectorXd r;
    RowMajorMatrix J(residuals.rows(), residuals.size());
    residuals.evaluate(fit.state, r, &J);
    return J;
  }

  std::vector<int> everything() const {
    std::vector<int> all(static_cast<std::size_t>(data_.postures()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  const Chain& chain() const { return chain_; }
  const CalibrationData& data() const { return data_; }

 private:
  Chain chain_;
  CalibrationData data_;
  std::vector<CalibrationParameter> parameters_;
};

Eigen::MatrixXd columns_of(const py::object& argument, const char* name, int dof) {
  if (argument.is_none()) {
    return {};
  }
  const Batch rows = read_rows(argument, name, {dof}, -1);
  return Eigen::Map<const Eigen::MatrixXd>(rows.data, dof, rows.count);
}

CalibrationOptions read_options(const std::string& loss, const std::optional<double>& loss_scale,
                                double gate, int max_iterations, const py::object& base,
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

void bind_fit(py::module_& m) {
  const auto places = [](const CalibrationFit& fit, auto member) {
    std::vector<int> all;
    all.reserve(fit.blocks.size());
    for (const auto& block : fit.blocks) {
      all.push_back(block.*member);
    }
    return all;
  };
  py::class_<CalibrationFit>(m, "Fit", "Of a Problem.")
      .def_property_readonly("status", [](const CalibrationFit& f) { return status_of(f.status); })
      .def_property_readonly("base",
                             [](const CalibrationFit& f) { return pose_array(f.state.base); })
      .def_property_readonly("tool",
                             [](const CalibrationFit& f) { return pose_array(f.state.tool); })
      .def_property_readonly("values", [](const CalibrationFit& f) { return to_array(f.values); })
      .def_property_readonly("noise",
                             [](const CalibrationFit& f) {
                               return py::make_tuple(f.noise.position, f.noise.rotation);
                             })
      .def_readonly("noise_is_estimated", &CalibrationFit::noise_is_estimated)
      .def_readonly("variance_factor", &CalibrationFit::variance_factor)
      .def_readonly("dof", &CalibrationFit::dof)
      .def_readonly("iterations", &CalibrationFit::iterations)
      .def_property_readonly("postures",
                             [places](const CalibrationFit& f) {
                               return places(f, &CalibrationResiduals::Block::posture);
                             })
      .def_property_readonly("points",
                             [places](const CalibrationFit& f) {
                               return places(f, &CalibrationResiduals::Block::point);
                             })
      .def_property_readonly("errors", [](const CalibrationFit& f) { return to_array(f.errors); })
      .def_property_readonly("distances",
                             [](const CalibrationFit& f) { return to_array(f.distances); })
      .def_property_readonly("outliers", [](const CalibrationFit& f) { return bools(f.outliers); })
      .def_property_readonly("rank", [](const CalibrationFit& f) { return f.sight.rank; })
      .def_property_readonly(
          "singular_values",
          [](const CalibrationFit& f) { return to_array(f.sight.singular_values); })
      .def_property_readonly("covariance",
                             [](const CalibrationFit& f) { return to_array(f.sight.covariance); })
      .def_property_readonly("is_told",
                             [](const CalibrationFit& f) { return bools(f.sight.is_told); })
      .def_property_readonly("unseen",
                             [](const CalibrationFit& f) { return to_array(f.sight.unseen); });
}

void bind_problem(py::module_& m) {
  py::class_<Problem>(m, "Problem", "Measurements of an arm, and what is to be estimated of it.")
      .def(py::init([](const Chain& chain, const py::object& q, const std::string& kind,
                       const py::object& measured, const py::object& points,
                       const py::object& covariance, const py::object& q_covariance,
                       const py::object& torques, std::vector<std::string> parameters,
                       std::map<std::string, double> priors, std::vector<int> sagging) {
             return Problem(chain, q, kind, measured, points, covariance, q_covariance, torques,
                            {std::move(parameters), std::move(priors), 0, std::move(sagging)});
           }),
           py::arg("chain"), py::arg("q"), py::arg("kind"), py::arg("measured"), py::arg("points"),
           py::arg("covariance"), py::arg("q_covariance"), py::arg("torques"),
           py::arg("parameters"), py::arg("priors"), py::arg("sagging"))
      .def_property_readonly("names",
                             [](const Problem& p) {
                               std::vector<std::string> names;
                               for (const auto& parameter : p.parameters()) {
                                 names.push_back(parameter.name);
                               }
                               return names;
                             })
      .def_property_readonly("deviations",
                             [](const Problem& p) {
                               std::vector<double> deviations;
                               for (const auto& parameter : p.parameters()) {
                                 deviations.push_back(parameter.deviation);
                               }
                               return deviations;
                             })
      .def_property_readonly("has_prior",
                             [](const Problem& p) {
                               std::vector<bool> has;
                               for (const auto& parameter : p.parameters()) {
                                 has.push_back(parameter.has_prior);
                               }
                               return has;
                             })
      .def_property_readonly("rows", [](const Problem& p) { return p.data().rows(); })
      .def_property_readonly("per_posture", [](const Problem& p) { return p.data().per_posture(); })
      .def(
          "nominal_errors",
          [](const Problem& p, const py::object& base, const py::object& tool) {
            const auto n = static_cast<Index>(p.parameters().size());
            return to_array(p.errors({read_one_pose(base, "base"), read_one_pose(tool, "tool"),
                                      Eigen::VectorXd::Zero(n)},
                                     p.everything()));
          },
          py::arg("base"), py::arg("tool"))
      .def(
          "fit",
          [](const Problem& p, const std::string& loss, const std::optional<double>& loss_scale,
             double gate, int max_iterations, const py::object& base, const py::object& tool,
             const std::vector<int>& postures) {
            const CalibrationOptions options =
                read_options(loss, loss_scale, gate, max_iterations, base, tool);
            const py::gil_scoped_release release;
            return p.fit(options, postures);
          },
          py::arg("loss"), py::arg("loss_scale"), py::arg("gate"), py::arg("max_iterations"),
          py::arg("base"), py::arg("tool"), py::arg("postures"))
      .def(
          "errors",
          [](const Problem& p, const CalibrationFit& fit, const std::vector<int>& postures) {
            return to_array(p.errors(fit.state, postures));
          },
          py::arg("fit"), py::arg("postures"))
      .def(
          "chain",
          [](const Problem& p, const CalibrationFit& fit) {
            CalibrationModel model(p.chain(), p.parameters());
            model.set(fit.state);
            return model.calibrated();
          },
          py::arg("fit"))
      .def(
          "sight_of",
          [](const Problem& p, const CalibrationFit& fit, const py::object& q,
             const py::object& torques) {
            const int dof = p.chain().dof();
            const CalibrationData data =
                p.imagined(fit, columns_of(q, "q", dof), columns_of(torques, "torques", dof));
            return bools(calibration_sight(p.derivatives(fit, data), p.parameters()).is_told);
          },
          py::arg("fit"), py::arg("q"), py::arg("torques"))
      .def(
          "most_telling",
          [](const Problem& p, const CalibrationFit& fit, const py::object& q,
             const py::object& torques, int count) {
            const int dof = p.chain().dof();
            const CalibrationData data = p.imagined(fit, columns_of(q, "candidates", dof),
                                                    columns_of(torques, "torques", dof));
            return most_telling(p.derivatives(fit, data), data.rows() * data.per_posture(),
                                p.parameters(), fit.sight.covariance, count);
          },
          py::arg("fit"), py::arg("q"), py::arg("torques"), py::arg("count"))
      .def(
          "unseen_in_words",
          [](const Problem& p, const CalibrationFit& fit) {
            return unseen_in_words(fit.sight, p.parameters());
          },
          py::arg("fit"));
}

}  // namespace

}  // namespace thing_kin::python

PYBIND11_MODULE(_calibration, m) {
  using namespace thing_kin;
  using namespace thing_kin::python;
  py::module_::import("thing_kin._core");  // brings the type of the chain
  m.doc() = "Calibration. Private: use thing_kin.estimation.calibrate.";
  bind_fit(m);
  bind_problem(m);
  m.def(
      "joint_origins",
      [](const Chain& chain) {
        const py::ssize_t shape[] = {chain.dof(), 4, 4};
        Array origins = make_array(shape, 3);
        for (int i = 0; i < chain.dof(); ++i) {
          write_pose(chain.joints()[static_cast<std::size_t>(i)].fixed,
                     origins.mutable_data() + 16 * i);
        }
        return py::make_tuple(origins, pose_array(chain.frames().back().offset));
      },
      py::arg("chain"),
      "Of each joint in the one before, (n, 4, 4), and the last frame in the last joint.");
}
