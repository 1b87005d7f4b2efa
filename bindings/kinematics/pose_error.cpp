#include "thing_kin/kinematics/pose_error.hpp"

#include <numbers>

#include "array.hpp"
#include "bindings.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/core/tolerance.hpp"

namespace thing_kin::python {

namespace {

Vector6 error_between(const double* from, const double* to, ErrorFrame frame, ErrorMethod method) {
  const SE3 T = read_pose(from, "T");
  const SE3 T_goal = read_pose(to, "T_goal");
  const bool body = frame == ErrorFrame::kBody;
  if (method == ErrorMethod::kLog) {
    return body ? pose_error_body(T, T_goal) : pose_error(T, T_goal);
  }
  const double angle = rotation_angle(T.rotation, T_goal.rotation);
  if (angle >= std::numbers::pi / 2 - kQuarterTurnMargin) {
    throw InvalidArgument("T_goal", "a rotation by " + text(angle) + " rad from T",
                          "less than pi/2 with method='cross'");
  }
  Vector6 error;
  error << T_goal.translation - T.translation, orientation_error_cross(T.rotation, T_goal.rotation);
  if (body) {
    error.head<3>() = T.rotation.transpose() * error.head<3>().eval();
    error.tail<3>() = T.rotation.transpose() * error.tail<3>().eval();
  }
  return error;
}

}  // namespace

void bind_pose_error(py::module_& m) {
  m.def(
      "pose_error",
      [](const ArrayLike& T, const ArrayLike& T_goal, const std::string& frame,
         const std::string& method) {
        const ErrorFrame error_frame = error_frame_from_string(frame);
        const ErrorMethod error_method = error_method_from_string(method);
        const Batch from = read(T, "T", {4, 4});
        const Batch to = read(T_goal, "T_goal", {4, 4});
        if (!from.single && !to.single && from.count != to.count) {
          throw InvalidArgument("T_goal", std::to_string(to.count) + " poses",
                                std::to_string(from.count) + ", as many as T, or one");
        }
        const Batch& longer = from.single ? to : from;
        Array out = make_array(longer, {6});
        double* error = out.mutable_data();
        for (py::ssize_t i = 0; i < longer.count; ++i) {
          Eigen::Map<Vector6>(error + 6 * i) =
              error_between(from.item(from.single ? 0 : i), to.item(to.single ? 0 : i), error_frame,
                            error_method);
        }
        return out;
      },
      py::arg("T"), py::arg("T_goal"), py::kw_only(), py::arg("frame") = "world_aligned",
      py::arg("method") = "log",
      R"(What is missing from one pose to another, [linear, angular], [M17] (3.16)-(3.18), (4.28).

pose_error(fk(q), fk(q + dq)) is J dq to first order, with the default Jacobian.

Parameters
----------
T, T_goal : (4, 4) or (N, 4, 4)
    A single pose goes with every one of a batch.
frame : str
    'world_aligned': [p_goal - p; log(R_goal R^T)], axes of the world. 'body': log(T^-1 T_goal) on
    SE(3), axes of T.
method : str
    'log': valid up to half a turn, where the sign of the axis is chosen as in so3_log. 'cross':
    (3.18) as printed, tan(angle) axis, only below a quarter turn; in the body frame its parts are
    turned into the axes of T.

Returns
-------
(6,) or (N, 6), m and rad

Raises
------
ValueError
    If a pose is not rigid, or 'cross' is asked for a quarter turn or more.

Examples
--------
>>> import thing_kin as tk
>>> tk.pose_error(tk.transform(), tk.transform(xyz=(1, 0, 0), rpy=(0, 0, 0.5)))
array([1. , 0. , 0. , 0. , 0. , 0.5])
)");
}

}  // namespace thing_kin::python
