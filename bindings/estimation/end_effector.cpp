#include "thing_kin/estimation/end_effector.hpp"

#include <optional>

#include <pybind11/stl.h>

#include "estimation_bindings.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin::python {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct HandArrays {
  Array pose;
  Array covariance;
  Array task_vector;
  Array task_covariance;
};

// An object with `pose` and `covariance` (of BaseLocalizer.estimate), a tuple of the two, or a pose
// that is exactly known.
struct BaseArrays {
  Batch pose;
  Batch covariance;
  bool known = false;
};

BaseArrays read_base(const py::object& estimate) {
  py::object pose = estimate;
  py::object covariance = py::none();
  if (py::hasattr(estimate, "pose") && py::hasattr(estimate, "covariance")) {
    pose = estimate.attr("pose");
    covariance = estimate.attr("covariance");
  } else if (py::isinstance<py::tuple>(estimate) && py::len(estimate) == 2) {
    pose = estimate[py::int_(0)];
    covariance = estimate[py::int_(1)];
  }
  BaseArrays base;
  base.pose = read(pose, "estimate", {3});
  check_magnitude(base.pose, "estimate");
  base.known = covariance.is_none();
  if (!base.known) {
    base.covariance = read(covariance, "estimate", {3, 3});
    check_magnitude(base.covariance, "estimate");
    for (py::ssize_t i = 0; i < base.covariance.count; ++i) {
      check_covariance(Eigen::Map<const RowMajor>(base.covariance.item(i), 3, 3), 3, "estimate");
    }
  }
  return base;
}

SmallMatrix read_joint_noise(const ArrayLike& joint_std, const py::object& joint_covariance,
                             int n) {
  const SmallVector deviations = read_number_or_vector(joint_std, "joint_std", n, Finite::kYes);
  if (n > 0 && !(deviations.minCoeff() >= 0.0)) {
    throw InvalidArgument("joint_std", text(deviations.minCoeff()), "numbers >= 0");
  }
  constexpr double kLargestDeviation = 1e25;  // so that products of variances are finite
  if (n > 0 && !(deviations.maxCoeff() <= kLargestDeviation)) {
    throw InvalidArgument("joint_std", text(deviations.maxCoeff()), "numbers up to 1e25");
  }
  SmallMatrix noise = deviations.cwiseAbs2().asDiagonal();
  if (joint_covariance.is_none()) {
    return noise;
  }
  if (n > 0 && deviations.maxCoeff() > 0.0) {
    throw InvalidArgument("joint_covariance", "joint_std, too", "one of the two");
  }
  const Batch batch = read(joint_covariance, "joint_covariance", {n, n}, false);
  check_magnitude(batch, "joint_covariance");
  noise = Eigen::Map<const RowMajor>(batch.data, n, n);
  check_covariance(noise, n, "joint_covariance");
  return noise;
}

int read_hand_frame(const Chain& chain, const std::optional<std::string>& name) {
  const int frame = name ? chain.frame_index(*name) : chain.tool();
  if (chain.base_joints() && frame <= chain.frame_index("base")) {
    throw InvalidArgument("frame", quoted(*name), "a frame of the arm");
  }
  return frame;
}

struct Request {
  const Chain& chain;
  Batch q;
  BaseArrays base;
  ArmUncertainty uncertainty;
  int frame;
  SE3 mount;
};

const Batch& longest_of(const Request& request) {
  const Batch& q = request.q;
  const Batch& pose = request.base.pose;
  const Batch& covariance = request.base.covariance;
  const auto agree = [](const Batch& a, const Batch& b, const char* name) {
    if (!a.single && !b.single && a.count != b.count) {
      throw InvalidArgument(name, std::to_string(b.count) + " rows",
                            std::to_string(a.count) + " as in q_arm or the pose, or one");
    }
  };
  agree(q, pose, "estimate");
  if (!request.base.known) {
    agree(q, covariance, "estimate");
    agree(pose, covariance, "estimate");
  }
  if (!q.single) {
    return q;
  }
  return pose.single && !request.base.known ? covariance : pose;
}

HandArrays hands(const Request& request) {
  const Batch& longest = longest_of(request);
  HandArrays out{make_array(longest, {4, 4}), make_array(longest, {6, 6}),
                 make_array(longest, {10}), make_array(longest, {10, 10})};
  double* const poses = out.pose.mutable_data();
  double* const covariances = out.covariance.mutable_data();
  double* const tasks = out.task_vector.mutable_data();
  double* const task_covariances = out.task_covariance.mutable_data();
  const auto at = [](const Batch& batch, py::ssize_t i) {
    return batch.item(batch.single ? 0 : i);
  };
  const py::gil_scoped_release release;
  for (py::ssize_t i = 0; i < longest.count; ++i) {
    PlanarEstimate base;
    base.pose = Eigen::Map<const Eigen::Vector3d>(at(request.base.pose, i));
    if (!request.base.known) {
      base.covariance = Eigen::Map<const Eigen::Matrix3d>(at(request.base.covariance, i));
    }
    const EndEffector hand = end_effector(request.chain, at(request.q, i), base,
                                          request.uncertainty, request.frame, request.mount);
    write_pose(hand.pose, poses + 16 * i);
    write_matrix(hand.covariance, covariances + 36 * i);
    write_matrix(hand.task_vector, tasks + 10 * i);
    write_matrix(hand.task_covariance, task_covariances + 100 * i);
  }
  return out;
}

Matrix6 read_mount_covariance(const py::object& argument) {
  if (argument.is_none()) {
    return Matrix6::Zero();
  }
  const Batch batch = read(argument, "mount_covariance", {6, 6}, false);
  check_magnitude(batch, "mount_covariance");
  const Matrix6 P = Eigen::Map<const RowMajor>(batch.data, 6, 6);
  check_covariance(P, 6, "mount_covariance");
  return P;
}

SE3 read_mount(const Chain& chain, const py::object& mount) {
  if (mount.is_none()) {
    return {};
  }
  if (chain.base_joints()) {
    throw InvalidArgument("mount", "one, for a chain that stands on a base already",
                          "None, or a chain without a base");
  }
  return read_pose(read(mount, "mount", {4, 4}, false).data, "mount");
}

}  // namespace

void bind_end_effector(py::module_& m) {
  py::class_<HandArrays>(m, "EndEffector", R"(The hand, and how well its place is known.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> from thing_kin import estimation as est
>>> hand = est.end_effector(tk.robots.thing(), np.zeros(6), [1.0, 2.0, 0.0], joint_std=1e-3)
>>> hand.pose.shape, hand.task_covariance.shape
((4, 4), (10, 10))
)")
      .def_readonly("pose", &HandArrays::pose, "(4, 4) or (N, 4, 4), in the world.")
      .def_readonly("covariance", &HandArrays::covariance,
                    "(6, 6) or (N, 6, 6), [position, rotation], m and rad, axes of the world: "
                    "R = exp(phi) R_mean.")
      .def_readonly("task_vector", &HandArrays::task_vector,
                    "(10,) or (N, 10): [p, quaternion w x y z, x, y, theta], [M17] (3.5).")
      .def_readonly("task_covariance", &HandArrays::task_covariance,
                    "(10, 10) or (N, 10, 10), positive semidefinite: none along the quaternion.")
      .def("__repr__", [](const HandArrays& hand) {
        return "EndEffector(pose=" + std::string(py::repr(hand.pose)) + ")";
      });
  m.def(
      "end_effector",
      [](const Chain& robot, const ArrayLike& q_arm, const py::object& estimate,
         const ArrayLike& joint_std, const py::object& joint_covariance, const py::object& mount,
         const py::object& mount_covariance, const std::optional<std::string>& frame) {
        const int n = arm_dof(robot);
        Request request{robot,
                        read_vectors(q_arm, "q_arm", n),
                        read_base(estimate),
                        {read_joint_noise(joint_std, joint_covariance, n),
                         read_mount_covariance(mount_covariance)},
                        read_hand_frame(robot, frame),
                        read_mount(robot, mount)};
        check_magnitude(request.q, "q_arm");
        return hands(request);
      },
      py::arg("robot"), py::arg("q_arm"), py::arg("estimate"), py::arg("joint_std") = 0.0,
      py::kw_only(), py::arg("joint_covariance") = py::none(), py::arg("mount") = py::none(),
      py::arg("mount_covariance") = py::none(), py::arg("frame") = py::none(),
      R"(Pose of the hand on a base whose pose is estimated, with its covariance.

To first order, J P J^T, for independent errors of the arm's joints, the base and the mount; the
task vector's is that of [M17] (3.5). With errors of angles of 0.1 rad a tenth of the covariance is
beyond that, and the mean is off by the sagitta, reach/2 times the variance.

Parameters
----------
robot : Chain
    On an omnidirectional base, or an arm alone that stands on a base at `mount`.
q_arm : (n,) or (N, n), rad and m
    The arm's joints, in their order in q; those of the base are the estimate's.
estimate : object, tuple or array
    Of the base: what has `pose` (3,) and `covariance` (3, 3), as BaseLocalizer.estimate() gives,
    covariance in world axes; a tuple of the two; or a pose alone, exactly known. Or N of each.
joint_std : float or (n,), rad and m
    Standard deviations of the joints.
joint_covariance : (n, n), optional
    Instead of them.
mount : (4, 4), optional
    Pose of the arm's root in the base, for an arm alone; default: the identity.
mount_covariance : (6, 6), optional
    Of the arm's root on the base, [position, rotation], in the axes of the base, the small
    rotation on the left. Default: exactly known.
frame : str, optional
    Default: the tool.

Returns
-------
EndEffector

Raises
------
ValueError
    If a shape does not fit, a number is not finite, a covariance is none, or the frame is not one
    of the arm.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> from thing_kin import estimation as est
>>> robot, q_arm = tk.robots.thing(), np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0])
>>> base = ([1.0, 2.0, 0.5], np.diag([1e-4, 1e-4, 1e-6]))
>>> hand = est.end_effector(robot, q_arm, base, joint_std=1e-3)
>>> np.sqrt(np.diag(hand.covariance)[:3]).round(4)  # of the position, m
array([0.01  , 0.0101, 0.0011])
)");
}

}  // namespace thing_kin::python
