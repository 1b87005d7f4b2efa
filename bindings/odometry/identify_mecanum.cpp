#include "thing_kin/odometry/identify_mecanum.hpp"

#include <cmath>

#include <pybind11/stl.h>

#include "estimation_bindings.hpp"
#include "odometry/dead_reckoning.hpp"
#include "odometry/mecanum.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

using Map3 = Eigen::Map<const Eigen::Vector3d>;
using Map4 = Eigen::Map<const Eigen::Vector4d>;
using Options = MecanumIdentificationOptions;

// What Python returns: the numbers, and which wheel was which.
struct Identified {
  MecanumIdentification result;
  WheelOrder order;
};

// No robot goes farther, and no product of such numbers overflows.
void check_size(const Batch& batch, const char* name) {
  constexpr double kFarthest = 1e9;
  for (py::ssize_t i = 0; i < batch.count * batch.size; ++i) {
    if (std::abs(batch.data[i]) > kFarthest) {
      throw InvalidArgument(name, text(batch.data[i]), "numbers up to " + text(kFarthest));
    }
  }
}

Eigen::Vector3d read_mount(const ArrayLike& argument, const char* name) {
  const Batch batch = read(argument, name, {3}, false);
  check_size(batch, name);
  return Map3(batch.data);
}

double optional_number(const py::object& value, const char* name) {
  return value.is_none() ? Options::kNone : *read(value, name, {}, false).data;
}

template <typename Vector>
Array array_of(const Vector& vector) {
  return Array(static_cast<py::ssize_t>(vector.size()), vector.data());
}

Array matrix_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  const py::ssize_t shape[] = {matrix.rows(), matrix.cols()};
  Array array = make_array(shape, 2);
  write_matrix(matrix, array.mutable_data());
  return array;
}

std::string status_of(const MecanumIdentification& result) {
  switch (result.status) {
    case MecanumStatus::kConverged:
      return "converged";
    case MecanumStatus::kNotConverged:
      return "not converged";
    default:
      return "too little motion";
  }
}

std::string line_of(const MecanumParameter& parameter) {
  std::string line = parameter.name + " = " + text(parameter.value);
  if (parameter.identifiable) {
    return line.append(" +- ").append(text(parameter.std)).append(", identified\n");
  }
  line.append(" +- ").append(text(parameter.nominal_std));
  return line.append(parameter.nominal_std > 0.0 ? ", not identifiable: nominal value kept\n"
                                                 : ", given\n");
}

std::string report_of(const Identified& identified) {
  const MecanumIdentification& result = identified.result;
  std::string words = status_of(result) + "\n";
  for (const MecanumParameter& parameter : result.parameters) {
    words.append(line_of(parameter));
  }
  words.append(std::to_string(result.windows)).append(" motions between windows, ");
  words.append(std::to_string(result.outliers)).append(" of them outliers\n");
  words.append("rms error of position: ").append(text(result.rms_nominal));
  words.append(" m nominal, ").append(text(result.rms_unaligned));
  words.append(" m with the initial yaw identified, ").append(text(result.rms_aligned));
  words.append(" m aligned\n").append(text(100.0 * result.nees_inside));
  return words.append(" % of the NEES below the 95 % bound");
}

std::vector<Eigen::Vector4d> sorted_angles(const ArrayLike& wheel_angles, const WheelOrder& order) {
  const Batch rows = read(wheel_angles, "wheel_angles", {4});
  check_size(rows, "wheel_angles");
  if (rows.single) {
    throw InvalidArgument("wheel_angles", "shape (4,)", "(N, 4) with a row for each stamp");
  }
  std::vector<Eigen::Vector4d> angles;
  angles.reserve(static_cast<std::size_t>(rows.count));
  for (py::ssize_t i = 0; i < rows.count; ++i) {
    angles.push_back(order.sorted(Map4(rows.item(i))));
  }
  return angles;
}

std::vector<double> stamps_of(const ArrayLike& t, const char* name) {
  const std::vector<py::ssize_t> shape = shape_of_any(t, name);
  const py::ssize_t length = shape.empty() ? 2 : shape[0];
  const Batch stamps = read(t, name, {length}, false);
  check_magnitude(stamps, name);
  return {stamps.data, stamps.data + length};
}

std::vector<Pose2> poses_of(const ArrayLike& poses) {
  const Batch rows = read(poses, "poses", {3});
  check_size(rows, "poses");
  if (rows.single) {
    throw InvalidArgument("poses", "shape (3,)", "(M, 3) with a row for each stamp");
  }
  std::vector<Pose2> all;
  all.reserve(static_cast<std::size_t>(rows.count));
  for (py::ssize_t i = 0; i < rows.count; ++i) {
    all.emplace_back(Map3(rows.item(i)));
  }
  return all;
}

void bind_numbers(py::class_<Identified>& c) {
  const auto value = [&](const char* name, std::size_t i, const char* doc) {
    c.def_property_readonly(
        name, [i](const Identified& self) { return self.result.parameters[i].value; }, doc);
  };
  const auto deviation = [&](const char* name, std::size_t i, const char* doc) {
    c.def_property_readonly(
        name, [i](const Identified& self) { return self.result.parameters[i].std; }, doc);
  };
  value("wheel_radius", 0, "Wheel radius, m.");
  deviation("wheel_radius_std", 0, "Its standard deviation, m.");
  value("k", 1, "Half the wheel base plus half the track, m.");
  deviation("k_std", 1, "Its standard deviation, m: the prior's if it is not identifiable.");
  value("clock_offset", 5, "By how much the wheels' stamps are ahead of the reference's, s.");
  deviation("clock_offset_std", 5, "Its standard deviation, s.");
  c.def_property_readonly(
      "mount",
      [](const Identified& self) {
        const auto& p = self.result.parameters;
        return array_of(Eigen::Vector3d(p[2].value, p[3].value, p[4].value));
      },
      "(3,), m and rad: pose of the reference's body on the robot.");
  c.def_property_readonly(
      "names",
      [](const Identified& self) {
        py::tuple names(kMecanumParameters);
        for (std::size_t i = 0; i < kMecanumParameters; ++i) {
          names[i] = self.result.parameters[i].name;
        }
        return names;
      },
      "What the rows of the covariance are.");
  c.def_property_readonly(
      "covariance", [](const Identified& self) { return matrix_of(self.result.covariance); },
      "(6, 6), in the order of names; what is not identifiable has its prior variance.");
  c.def_property_readonly(
      "identifiable",
      [](const Identified& self) {
        py::dict flags;
        for (const MecanumParameter& parameter : self.result.parameters) {
          flags[parameter.name.c_str()] = parameter.identifiable;
        }
        return flags;
      },
      "By name, whether the record shows it: at least half of the prior's deviation is gone.");
  c.def_property_readonly(
      "odometry",
      [](const Identified& self) {
        const auto& p = self.result.parameters;
        return MecanumOdometry(p[0].value, p[1].value, self.order);
      },
      "MecanumOdometry with these numbers.");
}

template <typename Member>
void bind_member(py::class_<Identified>& c, const char* name, Member member, const char* doc) {
  c.def_property_readonly(
      name, [member](const Identified& self) { return self.result.*member; }, doc);
}

template <typename Member>
void bind_array(py::class_<Identified>& c, const char* name, Member member, const char* doc) {
  c.def_property_readonly(
      name, [member](const Identified& self) { return array_of(self.result.*member); }, doc);
}

void bind_fit(py::class_<Identified>& c) {
  using Result = MecanumIdentification;
  c.def_property_readonly(
      "success",
      [](const Identified& self) { return self.result.status == MecanumStatus::kConverged; },
      "Whether the least squares have converged.");
  c.def_property_readonly(
      "status", [](const Identified& self) { return status_of(self.result); },
      "'converged', 'not converged' or 'too little motion'.");
  bind_array(c, "slip_variance", &Result::slip_variance,
             "(3,): variances of x, y (m^2) and theta (rad^2) for each metre of travel.");
  bind_array(c, "reference_std", &Result::reference_std,
             "(3,), m and rad: deviation of the reference in a window.");
  bind_member(c, "start_time", &Result::start_time, "Of the first window, s.");
  c.def_property_readonly(
      "start", [](const Identified& self) { return array_of(self.result.start.pose); },
      "(3,), m and rad: the robot at that time, as the reference saw it there and then.");
  c.def_property_readonly(
      "start_covariance",
      [](const Identified& self) { return matrix_of(self.result.start.covariance); },
      "(3, 3), in world axes.");
  bind_array(c, "initial_pose", &Result::initial_pose,
             "(3,), m and rad: the robot at t[0], its place as first seen, its yaw as fits the "
             "whole run.");
  bind_array(c, "aligned_pose", &Result::aligned_pose,
             "(3,), m and rad: the robot at t[0], place and yaw as fit the whole run best.");
  bind_member(c, "rms_nominal", &Result::rms_nominal,
              "Error of position from the reference's first pose, nominal numbers, m.");
  bind_member(c, "rms_unaligned", &Result::rms_unaligned,
              "Error of position, dead reckoning from initial_pose, m.");
  bind_member(c, "rms_aligned", &Result::rms_aligned,
              "Error of position, dead reckoning from aligned_pose, m.");
  bind_array(c, "times", &Result::times, "(W,), s: middles of the windows after the first.");
  bind_array(c, "nees", &Result::nees,
             "(W,): normalized squared error of dead reckoning from start; 3 degrees of freedom.");
  bind_member(c, "nees_inside", &Result::nees_inside,
              "Fraction of nees below the 95 % bound of chi-square.");
  bind_member(c, "windows", &Result::windows, "Motions between windows that were used.");
  bind_member(c, "outliers", &Result::outliers, "Of these, those that were weighed down.");
  bind_member(c, "iterations", &Result::iterations, "Of Gauss-Newton.");
  c.def("report", &report_of, R"(The result in words.

Returns
-------
str

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 20.0, 401)
>>> twists = np.stack([0.3 * np.cos(t), 0.2 * np.sin(2 * t), 0.5 * np.sin(t)], axis=1)
>>> angles = np.cumsum(wheels.wheel_speeds(twists) * 0.05, axis=0)
>>> poses = wheels.integrate_angles(t, angles).poses
>>> found = est.identify_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
>>> print(found.report().splitlines()[0])
converged
)");
  c.def("__repr__", [](const Identified& self) {
    const auto& p = self.result.parameters;
    std::string words = "MecanumIdentification(" + status_of(self.result);
    words.append(", wheel_radius=")
        .append(text(p[0].value))
        .append(", k=")
        .append(text(p[1].value));
    return words.append(")");
  });
}

Identified identify(const ArrayLike& t, const ArrayLike& wheel_angles, const ArrayLike& t_reference,
                    const ArrayLike& poses, const py::object& order, const Options& options) {
  Identified identified{{}, read_order(order)};
  const std::vector<double> stamps = stamps_of(t, "t");
  const std::vector<Eigen::Vector4d> angles = sorted_angles(wheel_angles, identified.order);
  const std::vector<double> reference_stamps = stamps_of(t_reference, "t_reference");
  const std::vector<Pose2> reference = poses_of(poses);
  const py::gil_scoped_release release;
  identified.result = identify_mecanum(stamps, angles, reference_stamps, reference, options);
  return identified;
}

}  // namespace

void bind_identify_mecanum(py::module_& m) {
  py::class_<Identified> c(m, "MecanumIdentification", R"(What identify_mecanum has found.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 20.0, 401)
>>> angles = np.cumsum(wheels.wheel_speeds(np.tile([0.3, 0.2, 0.0], (401, 1))) * 0.05, axis=0)
>>> poses = wheels.integrate_angles(t, angles).poses
>>> found = est.identify_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
>>> found.identifiable["k"], found.k  # the robot has never turned
(False, 0.5)
)");
  bind_numbers(c);
  bind_fit(c);
  const Options defaults;
  m.def(
      "identify_mecanum",
      [](const ArrayLike& t, const ArrayLike& wheel_angles, const ArrayLike& t_reference,
         const ArrayLike& poses, const py::object& order, const py::object& wheel_radius,
         const py::object& k, double wheel_radius_std, double k_std, const ArrayLike& mount,
         const ArrayLike& mount_std, double clock_offset_std, double window, double longest_gap) {
        Options options;
        options.wheel_radius = optional_number(wheel_radius, "wheel_radius");
        options.k = optional_number(k, "k");
        options.wheel_radius_std = wheel_radius_std;
        options.k_std = k_std;
        options.mount = read_mount(mount, "mount");
        options.mount_std = read_mount(mount_std, "mount_std");
        options.clock_offset_std = clock_offset_std;
        options.window = window;
        options.longest_gap = longest_gap;
        return identify(t, wheel_angles, t_reference, poses, order, options);
      },
      py::arg("t"), py::arg("wheel_angles"), py::arg("t_reference"), py::arg("poses"),
      py::arg("order") = default_order(), py::kw_only(), py::arg("wheel_radius") = py::none(),
      py::arg("k") = py::none(), py::arg("wheel_radius_std") = defaults.wheel_radius_std,
      py::arg("k_std") = defaults.k_std, py::arg("mount") = py::make_tuple(0.0, 0.0, 0.0),
      py::arg("mount_std") =
          py::make_tuple(defaults.mount_std[0], defaults.mount_std[1], defaults.mount_std[2]),
      py::arg("clock_offset_std") = defaults.clock_offset_std, py::arg("window") = defaults.window,
      py::arg("longest_gap") = defaults.longest_gap,
      R"(Wheel radius and k of [M17] (3.20) from a record with reference poses.

Errors of odometry add up along the way, so that motions between windows of time are compared, never
absolute poses. A window's reference is the median of its poses, each carried to the window's middle
by the wheels; outlying poses and windows hardly count. The noise of both is estimated from the
record: that of the wheels as a random walk whose variance grows with the way, that of the reference
as shared by the motions before and after a window. Generalized least squares on SE(2), with priors.

A number is identifiable if the record leaves less than half of its prior's standard deviation. What
is not keeps its nominal value and its prior variance, and the others' covariance accounts for that.

Parameters
----------
t : (N,), s
    Of the wheels; not decreasing.
wheel_angles : (N, 4), rad
    Whole turns included; of encoders: see angles_from_ticks; of speeds: their integral.
t_reference : (M,), s
    Of the reference, by the same clock (see clock_offset_std); not decreasing.
poses : (M, 3), m and rad
    (x, y, theta) of a body fixed to the robot, in a world of its own.
order : sequence of str
    Which wheel is which, as in MecanumOdometry.
wheel_radius, k : float, m, optional
    Nominal values. Default: some 0.1 m within a factor of 3, some 0.4 m within a factor of 2.
wheel_radius_std, k_std : float
    Standard deviations of these, as fractions of them; 0: exactly known.
mount : (3,), m and rad
    Nominal pose of the reference's body on the robot: x, y, yaw.
mount_std : (3,), m and rad
    Standard deviations; 0: exactly known.
clock_offset_std : float, s
    Standard deviation of the wheels' stamps from the reference's clock; offsets up to three times
    as large are searched, at most 20 s (50 windows, if those are shorter
    than 0.4 s) and half of the record. Default: one clock.
window : float, s
    Long enough to hold several reference poses, short enough that the wheels lead through it.
longest_gap : float, s
    A motion during which the wheels' stamps have a longer gap is left out, if they turned.

Returns
-------
MecanumIdentification

Raises
------
ValueError
    If a shape does not fit, stamps decrease or share no time, or a number is not finite.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 20.0, 401)
>>> twists = np.stack([0.3 * np.cos(t), 0.2 * np.sin(2 * t), 0.5 * np.sin(t)], axis=1)
>>> angles = np.cumsum(wheels.wheel_speeds(twists) * 0.05, axis=0)
>>> poses = wheels.integrate_angles(t, angles).poses
>>> found = est.identify_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
>>> round(found.wheel_radius, 4), round(found.k, 3)
(0.07, 0.4)
)");
}

}  // namespace thing_kin::python
