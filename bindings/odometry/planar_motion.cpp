#include "thing_kin/odometry/planar_motion.hpp"

#include "estimation_bindings.hpp"
#include "odometry/dead_reckoning.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin::python {

namespace {

using Map3 = Eigen::Map<const Eigen::Vector3d>;

struct Twists {
  Batches<3> batches;

  Twists(const ArrayLike& pose, const ArrayLike& twist, const ArrayLike& dt)
      : batches{read_moderate(pose, "pose", 3), read_moderate(twist, "twist", 3),
                read(dt, "dt", {})} {
    check_magnitude(batches[2], "dt");
    check_counts(batches[0], "pose", batches[1], "twist");
    check_counts(batches[0], "pose", batches[2], "dt");
    check_counts(batches[1], "twist", batches[2], "dt");
  }
};

py::tuple jacobians(const ArrayLike& pose, const ArrayLike& twist, double dt) {
  const Batch at = read(pose, "pose", {3}, false);
  const Batch held = read(twist, "twist", {3}, false);
  check_magnitude(at, "pose");
  check_magnitude(held, "twist");
  if (!(std::abs(dt) <= 1e50)) {
    throw InvalidArgument("dt", text(dt), "numbers up to 1e+50");
  }
  const MotionJacobians J = motion_jacobians(Map3(at.data), Map3(held.data) * dt);
  const py::ssize_t shape[] = {3, 3};
  Array by_pose = make_array(shape, 2);
  Array by_twist = make_array(shape, 2);
  write_matrix(J.by_pose, by_pose.mutable_data());
  write_matrix(Eigen::Matrix3d(J.by_motion * dt), by_twist.mutable_data());
  return py::make_tuple(by_pose, by_twist);
}

DeadReckoning reckon_twists(const ArrayLike& pose, const ArrayLike& twists, const ArrayLike& dt,
                            const OptionalArray& covariance,
                            const OptionalArray& twist_covariance) {
  const PlanarEstimate start = read_start(pose, covariance);
  const Batch held = read_moderate(twists, "twists", 3);
  const Batch times = read(dt, "dt", {});
  check_magnitude(times, "dt");
  check_counts(held, "twists", times, "dt");
  std::vector<WheelRow> rows;
  for (py::ssize_t i = 0; i < held.count; ++i) {
    const double duration = *times.item(times.single ? 0 : i);
    rows.push_back({Map3(held.item(i)) * duration, duration, 0.0});
  }
  const auto none = py::reinterpret_borrow<OptionalArray>(py::none());
  return reckon(start, rows, {twist_covariance, none});
}

}  // namespace

void check_counts(const Batch& first, const char* first_name, const Batch& second,
                  const char* second_name) {
  if (!first.single && !second.single && first.count != second.count) {
    throw InvalidArgument(second_name, std::to_string(second.count) + " rows",
                          std::to_string(first.count) + ", as many as " + first_name + ", or one");
  }
}

Batch read_moderate(const ArrayLike& argument, const char* name, py::ssize_t size) {
  Batch batch = read_vectors(argument, name, size);
  check_magnitude(batch, name);
  return batch;
}

Eigen::Matrix3d read_planar_covariance(const OptionalArray& argument, const char* name,
                                       const Eigen::Matrix3d& fallback) {
  if (argument.is_none()) {
    return fallback;
  }
  const Batch batch = read(argument, name, {3, 3}, false);
  check_magnitude(batch, name);
  const Eigen::Matrix3d P = Eigen::Map<const Eigen::Matrix3d>(batch.data);
  check_covariance(P, 3, name);
  return 0.5 * (P + P.transpose());
}

std::vector<py::ssize_t> shape_of_any(const ArrayLike& argument, const char* name) {
  try {
    const py::object shape = py::module_::import("numpy").attr("asarray")(argument).attr("shape");
    std::vector<py::ssize_t> lengths;
    for (const py::handle length : shape) {
      lengths.push_back(length.cast<py::ssize_t>());
    }
    return lengths;
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) {
      throw;
    }
    throw InvalidArgument(name, py::str(py::type::of(argument).attr("__name__")),
                          "an array of real numbers");
  }
}

PlanarEstimate read_start(const ArrayLike& pose, const OptionalArray& covariance) {
  const Batch at = read(pose, "pose", {3}, false);
  check_magnitude(at, "pose");
  return {Map3(at.data), read_planar_covariance(covariance, "covariance", Eigen::Matrix3d::Zero())};
}

Batch read_stamps(const ArrayLike& t, py::ssize_t rows) {
  Batch stamps = read(t, "t", {rows}, false);
  check_magnitude(stamps, "t");
  for (py::ssize_t i = 0; i + 1 < rows; ++i) {
    if (stamps.data[i + 1] < stamps.data[i]) {
      throw InvalidArgument("t", "a stamp before the last one, at index " + std::to_string(i + 1),
                            "stamps that do not decrease");
    }
  }
  return stamps;
}

DeadReckoning reckon(const PlanarEstimate& start, const std::vector<WheelRow>& rows,
                     const WheelNoise& noise) {
  if (!noise.twist_covariance.is_none() && !noise.slip_variance.is_none()) {
    throw InvalidArgument("slip_variance", "twist_covariance, too", "one of the two");
  }
  Eigen::Matrix3d common = read_planar_covariance(noise.twist_covariance, "twist_covariance",
                                                  default_twist_covariance());
  const bool slips = !noise.slip_variance.is_none();
  if (slips) {
    const Batch variance = read(noise.slip_variance, "slip_variance", {3}, false);
    check_magnitude(variance, "slip_variance");
    if (!(Map3(variance.data).minCoeff() >= 0.0)) {
      throw InvalidArgument("slip_variance", text(Map3(variance.data).minCoeff()), "numbers >= 0");
    }
    common = Map3(variance.data).asDiagonal();
  }
  std::vector<NoisyMotion> motions;
  motions.reserve(rows.size());
  for (const WheelRow& row : rows) {
    motions.push_back({row.xi, slips ? row.travel : row.dt * row.dt});
  }
  const auto count = static_cast<py::ssize_t>(rows.size()) + 1;
  const py::ssize_t shape[] = {count, 3, 3};
  DeadReckoning result{make_array(shape, 2), make_array(shape, 3)};
  double* const poses = result.poses.mutable_data();
  double* const covariances = result.covariances.mutable_data();
  const py::gil_scoped_release release;
  std::vector<PlanarEstimate> estimates(rows.size() + 1);
  dead_reckon(start, motions, common, estimates);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    Eigen::Map<Eigen::Vector3d>(poses + 3 * i) = estimates[i].pose;
    Eigen::Map<Eigen::Matrix3d>(covariances + 9 * i) = estimates[i].covariance;
  }
  return result;
}

void bind_planar_motion(py::module_& m) {
  m.def(
      "integrate_twist",
      [](const ArrayLike& pose, const ArrayLike& twist, const ArrayLike& dt) {
        Twists all(pose, twist, dt);
        const Serial serial;
        return map_together(all.batches, {3}, Run{serial.out, serial.threads},
                            [](const std::array<const double*, 3>& in, double* out) {
                              Eigen::Map<Eigen::Vector3d>{out} =
                                  integrate_twist(Map3(in[0]), Map3(in[1]), *in[2]);
                            });
      },
      py::arg("pose"), py::arg("twist"), py::arg("dt"),
      R"(Pose after a constant twist of the body; exact on SE(2), not in steps.

Parameters
----------
pose : (3,) or (N, 3), m and rad
    (x, y, theta) in the world.
twist : (3,) or (N, 3), m/s and rad/s
    (vx, vy, omega) in the axes of the body.
dt : float or (N,), s

Returns
-------
(3,) or (N, 3), m and rad
    theta in (-pi, pi].

Raises
------
ValueError
    If a shape does not fit, or a number is not finite.

See Also
--------
dead_reckon : a whole record, with covariances

Examples
--------
A quarter of a circle of radius 1 m:

>>> import numpy as np
>>> from thing_kin import estimation as est
>>> pose = est.integrate_twist([0.0, 0.0, 0.0], [np.pi / 2, 0.0, np.pi / 2], 1.0)
>>> np.allclose(pose, [1.0, 1.0, np.pi / 2])
True
)");
  m.def("integrate_twist_jacobians", &jacobians, py::arg("pose"), py::arg("twist"), py::arg("dt"),
        R"(Derivatives of integrate_twist by the pose and by the twist.

With them a covariance goes through: P <- F P F^T + G R G^T, all in world axes but R.

Parameters
----------
pose : (3,), m and rad
twist : (3,), m/s and rad/s
dt : float, s

Returns
-------
F : (3, 3)
    By the pose.
G : (3, 3)
    By the twist.

Raises
------
ValueError
    If a shape does not fit, or a number is not finite.

Examples
--------
>>> from thing_kin import estimation as est
>>> F, G = est.integrate_twist_jacobians([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.5)
>>> F
array([[ 1. ,  0. , -0. ],
       [ 0. ,  1. ,  0.5],
       [ 0. ,  0. ,  1. ]])
)");
  m.def(
      "pose_difference",
      [](const ArrayLike& a, const ArrayLike& b) {
        Batches<2> both{read_moderate(a, "a", 3), read_moderate(b, "b", 3)};
        check_counts(both[0], "a", both[1], "b");
        const Serial serial;
        return map_together(both, {3}, Run{serial.out, serial.threads},
                            [](const std::array<const double*, 2>& in, double* out) {
                              Eigen::Map<Eigen::Vector3d>{out} =
                                  pose_difference(Map3(in[0]), Map3(in[1]));
                            });
      },
      py::arg("a"), py::arg("b"),
      R"(The difference a - b of planar poses in world axes, theta wrapped.

Its covariance is that of a plus that of b (both in world axes) if their errors are independent.

Parameters
----------
a, b : (3,) or (N, 3), m and rad

Returns
-------
(3,) or (N, 3), m and rad
    theta in (-pi, pi].

Raises
------
ValueError
    If a shape does not fit, or a number is not finite.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.pose_difference([1.0, 2.0, 3.0], [0.5, 2.0, -3.0]).round(3)
array([ 0.5  ,  0.   , -0.283])
)");
  py::class_<DeadReckoning>(m, "DeadReckoning", R"(Poses along a record, with covariances.

Examples
--------
>>> from thing_kin import estimation as est
>>> path = est.dead_reckon([0.0, 0.0, 0.0], [[1.0, 0.0, 0.0]] * 3, dt=0.1)
>>> path.poses.shape, path.covariances.shape
((4, 3), (4, 3, 3))
)")
      .def_readonly("poses", &DeadReckoning::poses, "(N, 3), m and rad: the first is the start.")
      .def_readonly("covariances", &DeadReckoning::covariances,
                    "(N, 3, 3), in world axes, m^2 and rad^2.")
      .def("__repr__", [](const DeadReckoning& path) {
        return "DeadReckoning(" + std::to_string(path.poses.shape(0)) + " poses)";
      });
  m.def("dead_reckon", &reckon_twists, py::arg("pose"), py::arg("twists"), py::arg("dt"),
        py::arg("covariance") = py::none(), py::arg("twist_covariance") = py::none(),
        R"(Poses along a whole record of twists, with their covariances.

Errors of successive twists are independent: a twist's covariance R enters the pose as R dt^2.

Parameters
----------
pose : (3,), m and rad
    Where the record begins.
twists : (N, 3), m/s and rad/s
    In the axes of the body, each held for its dt.
dt : float or (N,), s
covariance : (3, 3), optional
    Of the start, in world axes; default: zero.
twist_covariance : (3, 3), optional
    In the axes of the body; default: diag(0.001, 0.001, 0.03), [M17] (3.22).

Returns
-------
DeadReckoning
    N + 1 poses.

Raises
------
ValueError
    If a shape does not fit, a number is not finite or a covariance is none.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> path = est.dead_reckon([0, 0, 0], np.tile([0.5, 0.0, 0.1], (100, 1)), dt=0.1)
>>> np.allclose(path.poses[-1], est.integrate_twist([0, 0, 0], [0.5, 0.0, 0.1], 10.0))
True
>>> np.sqrt(np.diag(path.covariances[-1])).round(3)
array([0.289, 0.395, 0.173])
)");
}

}  // namespace thing_kin::python
