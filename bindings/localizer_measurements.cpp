#include <bit>
#include <optional>

#include <pybind11/stl.h>

#include "localizer_bindings.hpp"
#include "quick_method.hpp"

namespace thing_kin::python {

namespace {

using Kind = LocalizerMeasurement::Kind;

/// Numbers of one class of measurement: which variables of a source concern it, and how it is said.
struct Entries {
  std::uint8_t (*mask)(const LocalizerSource&);
  const char* names;
};
constexpr Entries kPoseEntries{[](const LocalizerSource& s) { return s.pose_mask(); },
                               "'x', 'y' or 'theta'"};
constexpr Entries kTwistEntries{[](const LocalizerSource& s) { return s.twist_mask(); },
                                "'vx', 'vy' or 'omega'"};

// The source's own covariance where none is given.
template <typename Read>
Eigen::Matrix3d covariance_of(const LocalizerSource* source, const OptionalArray& given,
                              const char* name, const Read& read_given) {
  if (!given.is_none()) {
    return check_measured_covariance(read_given(), name);
  }
  if (source == nullptr || !source->covariance) {
    throw InvalidArgument(name, "None", "a covariance, here or of the source");
  }
  return *source->covariance;
}

// Everything is checked before a new source is declared: what is refused leaves no trace.
bool take(BaseLocalizer& self, LocalizerMeasurement& m, const std::string& name,
          const Entries& entries, std::uint8_t measured) {
  const LocalizerSource undeclared;
  const LocalizerSource* known = self.look_up(name);
  m.mask = measured & entries.mask(known != nullptr ? *known : undeclared);
  if (m.mask == 0) {
    throw InvalidArgument("source", "one whose variables are others",
                          std::string(entries.names) + " among its variables");
  }
  m.source = self.find_or_declare(name);
  const LocalizerSource& source = self.source_at(m.source);
  m.bound = m.kind == Kind::kTwist && !source.gates_twists
                ? NisBound{kNoGate, kNoGate, kNoGate, kNoGate}
                : source.bound;
  return self.add(m);
}

bool add_vector(BaseLocalizer& self, Kind kind, double t, const ArrayLike& z, const char* z_name,
                const OptionalArray& covariance, const std::string& source) {
  return naming(source, [&] {
    LocalizerMeasurement m;
    m.kind = kind;
    m.t = t;
    check_time(t, "t");
    m.z = read_triple(z, z_name);
    check_measured(m.z, z_name);
    m.R = covariance_of(self.look_up(source), covariance, "covariance",
                        [&] { return read_triple_matrix(covariance, "covariance"); });
    return take(self, m, source, kind == Kind::kTwist ? kTwistEntries : kPoseEntries, 7);
  });
}

bool add_number(BaseLocalizer& self, Kind kind, double t, double z, const char* z_name,
                const OptionalArray& variance, const std::string& source) {
  return naming(source, [&] {
    LocalizerMeasurement m;
    m.kind = kind;
    m.t = t;
    check_time(t, "t");
    m.z = Eigen::Vector3d(0.0, 0.0, z);
    check_measured(m.z, z_name);
    const Eigen::Matrix3d R = covariance_of(self.look_up(source), variance, "variance", [&] {
      return Eigen::Matrix3d(Eigen::Matrix3d::Identity() *
                             *read(variance, "variance", {}, false).data);
    });
    m.R = Eigen::Matrix3d::Identity();
    m.R(2, 2) = R(2, 2);
    return take(self, m, source, kind == Kind::kTwist ? kTwistEntries : kPoseEntries, 4);
  });
}

bool add_motion(BaseLocalizer& self, double t1, double t2, const ArrayLike& motion,
                const OptionalArray& covariance, const std::string& source) {
  return naming(source, [&] {
    LocalizerMeasurement m;
    m.kind = Kind::kRelative;
    check_time(t1, "t1");
    check_time(t2, "t2");
    if (!(t1 < t2)) {
      throw InvalidArgument("t2", text(t2 - t1) + " s after t1", "a time after t1");
    }
    m.t = t2;
    m.t_from = t1;
    m.z = read_triple(motion, "motion");
    check_measured(m.z, "motion");
    m.R = covariance_of(self.look_up(source), covariance, "covariance",
                        [&] { return read_triple_matrix(covariance, "covariance"); });
    return take(self, m, source, kPoseEntries, 7);
  });
}

bool add_twist(BaseLocalizer& self, double t, const ArrayLike& twist,
               const OptionalArray& covariance, const std::string& source) {
  return add_vector(self, Kind::kTwist, t, twist, "twist", covariance, source);
}

bool add_pose(BaseLocalizer& self, double t, const ArrayLike& pose, const OptionalArray& covariance,
              const std::string& source) {
  return add_vector(self, Kind::kPose, t, pose, "pose", covariance, source);
}

bool add_yaw_rate(BaseLocalizer& self, double t, double rate, const OptionalArray& variance,
                  const std::string& source) {
  return add_number(self, Kind::kTwist, t, rate, "rate", variance, source);
}

bool add_yaw(BaseLocalizer& self, double t, double yaw, const OptionalArray& variance,
             const std::string& source) {
  return add_number(self, Kind::kYaw, t, yaw, "yaw", variance, source);
}

BaseEstimate estimate_at(BaseLocalizer& self, std::optional<double> t) { return self.estimate(t); }

}  // namespace

Eigen::Vector3d read_triple(const ArrayLike& argument, const char* name) {
  Eigen::Vector3d v;
  if (!read_plain(argument, {3}, v.data())) {
    v = Eigen::Map<const Eigen::Vector3d>(read(argument, name, {3}, false).data);
  }
  return v;
}

Eigen::Matrix3d read_triple_matrix(py::handle argument, const char* name) {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> A;
  if (!read_plain(argument, {3, 3}, A.data())) {
    A = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
        read(argument, name, {3, 3}, false).data);
  }
  return A;
}

void bind_localizer_measurements(py::class_<BaseLocalizer>& localizer) {
  QuickMethod<&add_twist>::define(localizer, "add_twist", py::arg("t"), py::arg("twist"),
                                  py::arg("covariance") = py::none(), py::kw_only(),
                                  py::arg("source"),
                                  R"(Take a twist: the mean since the previous stamp of that source.

It is held until the next. Its error is one draw: over T seconds it moves the pose by R T^2.

Parameters
----------
t : float, s
twist : (3,)
    vx, vy, omega in the body, m/s and rad/s.
covariance : (3, 3), optional
    Default: the source's.
source : str

Returns
-------
bool
    False if it is older than the history, which `refused` counts.

Raises
------
ValueError
    That names the source; then nothing has changed.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(t=0.0)
>>> localizer.add_twist(1.0, (1.0, 0.0, np.pi / 2), np.eye(3), source="wheels")
True
>>> localizer.estimate().pose.round(4)  # a quarter of a circle
array([0.6366, 0.6366, 1.5708])
)");
  QuickMethod<&add_pose>::define(
      localizer, "add_pose", py::arg("t"), py::arg("pose"), py::arg("covariance") = py::none(),
      py::kw_only(), py::arg("source"), R"(Take a pose, as of a map, a marker or motion capture.

Parameters
----------
t : float, s
pose : (3,), m and rad
covariance : (3, 3), optional
    World axes. Default: the source's.
source : str

Returns
-------
bool
    False if it is older than the history, which `refused` counts.

Raises
------
ValueError
    That names the source; then nothing has changed.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(covariance=np.eye(3))
>>> localizer.add_pose(1.7e9, (1.0, 0.0, 0.0), np.eye(3), source="lidar")
True
>>> localizer.estimate().pose
array([0.5, 0. , 0. ])
)");
  QuickMethod<&add_motion>::define(
      localizer, "add_relative_pose", py::arg("t1"), py::arg("t2"), py::arg("motion"),
      py::arg("covariance") = py::none(), py::kw_only(), py::arg("source"),
      R"(Take a motion between two times: the pose at t2 as the base at t1 saw it.

The pose at t1 is kept, correlated with the present, so that what the twists said of the same way is
not counted twice. At most eight motions may overlap at any time; one more is rejected.

Parameters
----------
t1, t2 : float, s
    t1 < t2, at most the history apart.
motion : (3,), m and rad
    As `lie.se2_between(pose1, pose2)`.
covariance : (3, 3), optional
    In the axes of the base at t1. Default: the source's.
source : str

Returns
-------
bool
    False if t1 is older than the history, which `refused` counts.

Raises
------
ValueError
    That names the source; then nothing has changed.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(t=0.0)
>>> localizer.add_twist(1.0, (1.0, 0.0, 0.0), 1e-2 * np.eye(3), source="wheels")
True
>>> localizer.add_relative_pose(0.0, 1.0, (1.1, 0.0, 0.0), 1e-6 * np.eye(3), source="scan")
True
>>> localizer.estimate().pose.round(3)
array([1.1, 0. , 0. ])
)");
  QuickMethod<&add_yaw_rate>::define(
      localizer, "add_yaw_rate", py::arg("t"), py::arg("rate"), py::arg("variance") = py::none(),
      py::kw_only(), py::arg("source"),
      R"(Take a yaw rate, as of a gyro: a twist of which omega counts.

Parameters
----------
t : float, s
rate : float, rad/s
variance : float, optional, (rad/s)^2
    Default: the source's.
source : str

Returns
-------
bool
    False if it is older than the history, which `refused` counts.

Raises
------
ValueError
    That names the source; then nothing has changed.

Examples
--------
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(t=0.0)
>>> localizer.add_yaw_rate(1.0, 0.25, 1e-4, source="imu")
True
>>> localizer.estimate().pose
array([0.  , 0.  , 0.25])
)");
  QuickMethod<&add_yaw>::define(localizer, "add_yaw", py::arg("t"), py::arg("yaw"),
                                py::arg("variance") = py::none(), py::kw_only(), py::arg("source"),
                                R"(Take a heading, as of a compass: a pose of which theta counts.

Parameters
----------
t : float, s
yaw : float, rad
variance : float, optional, rad^2
    Default: the source's.
source : str

Returns
-------
bool
    False if it is older than the history, which `refused` counts.

Raises
------
ValueError
    That names the source; then nothing has changed.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(pose=(0, 0, 3.0), covariance=np.eye(3))
>>> localizer.add_yaw(0.0, -3.0, 1.0, source="compass")  # no jump at pi
True
>>> float(abs(localizer.estimate().pose[2]).round(6))
3.141593
)");
  QuickMethod<&estimate_at>::define(localizer, "estimate", py::arg("t") = py::none(),
                                    R"(Estimate pose and twist at a time.

Parameters
----------
t : float, optional, s
    Within the history, or later: then the twist is held, and the uncertainty grows. Default: the
    time of the latest measurement.

Returns
-------
BaseEstimate

Raises
------
ValueError
    Before the first measurement, or before the history.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(t=0.0)
>>> localizer.add_twist(1.0, (1.0, 0.0, 0.0), 1e-4 * np.eye(3), source="wheels")
True
>>> ahead = localizer.estimate(3.0)
>>> ahead.pose, bool(ahead.covariance[0, 0] > localizer.estimate().covariance[0, 0])
(array([3., 0., 0.]), True)
)");
}

}  // namespace thing_kin::python
