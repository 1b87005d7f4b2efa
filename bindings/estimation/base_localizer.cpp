#include "thing_kin/estimation/base_localizer.hpp"

#include <bit>
#include <memory>
#include <optional>

#include <pybind11/stl.h>

#include "array.hpp"
#include "estimation_bindings.hpp"
#include "thing_kin/core/error.hpp"

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

Eigen::Vector3d read_triple(const ArrayLike& argument, const char* name) {
  Eigen::Vector3d v;
  if (!read_plain(argument, {3}, v.data())) {
    v = Eigen::Map<const Eigen::Vector3d>(read(argument, name, {3}, false).data);
  }
  return v;
}

Eigen::Matrix3d read_matrix(py::handle argument, const char* name) {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> A;
  if (!read_plain(argument, {3, 3}, A.data())) {
    A = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
        read(argument, name, {3, 3}, false).data);
  }
  return A;
}

// A message begins with the argument; it also names the source.
template <typename Work>
auto naming(const std::string& source, const Work& work) {
  try {
    return work();
  } catch (const InvalidArgument& error) {
    throw py::value_error(std::string(error.what()) + " (source " + quoted(source) + ")");
  }
}

std::uint8_t read_fuse(const std::optional<std::vector<std::string>>& fuse) {
  if (!fuse) {
    return kFuseAll;
  }
  std::uint8_t bits = 0;
  for (const std::string& name : *fuse) {
    std::size_t k = 0;
    while (k < kFuseNames.size() && name != kFuseNames[k]) {
      ++k;
    }
    if (k == kFuseNames.size()) {
      throw InvalidArgument("fuse", quoted(shortened(name, 40)),
                            "names out of 'x', 'y', 'theta', 'vx', 'vy', 'omega'");
    }
    bits = static_cast<std::uint8_t>(bits | 1U << k);
  }
  if (bits == 0) {
    throw InvalidArgument("fuse", "no name", "at least one variable");
  }
  return bits;
}

// (3, 3), or a variance that stands on the diagonal; None is none.
std::optional<Eigen::Matrix3d> read_source_covariance(const OptionalArray& covariance) {
  if (covariance.is_none()) {
    return std::nullopt;
  }
  const Batch any = py::len_hint(covariance) == 0 ? read(covariance, "covariance", {}, false)
                                                  : read(covariance, "covariance", {3, 3}, false);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity() * any.data[0];
  if (any.size == 9) {
    R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(any.data);
  }
  return check_measured_covariance(R, "covariance");
}

void declare(BaseLocalizer& self, const std::string& name,
             const std::optional<std::vector<std::string>>& fuse, const OptionalArray& covariance,
             std::optional<double> gate) {
  naming(name, [&] {
    self.source(name, read_fuse(fuse), read_source_covariance(covariance), gate);
    return 0;
  });
}

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
                        [&] { return read_matrix(covariance, "covariance"); });
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
                        [&] { return read_matrix(covariance, "covariance"); });
    return take(self, m, source, kPoseEntries, 7);
  });
}

PoseFilter read_filter(const std::string& name) {
  if (name == "ekf" || name == "ukf") {
    return name == "ekf" ? PoseFilter::kExtended : PoseFilter::kUnscented;
  }
  throw InvalidArgument("filter", quoted(shortened(name, 40)), "'ekf' or 'ukf'");
}

BaseLocalizer make(const ArrayLike& pose, const OptionalArray& covariance, double gate,
                   const OptionalArray& process_noise, double history, std::optional<double> t,
                   const std::string& filter, const std::optional<py::dict>& sources) {
  BaseLocalizerOptions options;
  options.pose = read_triple(pose, "pose");
  if (!covariance.is_none()) {
    options.covariance = read_matrix(covariance, "covariance");
  }
  if (!process_noise.is_none()) {
    options.process_noise = read_matrix(process_noise, "process_noise");
  }
  options.gate = gate;
  options.history = history;
  options.t = t;
  options.filter = read_filter(filter);
  py::object self = py::cast(BaseLocalizer(options));
  for (const auto& [name, settings] : sources.value_or(py::dict())) {
    if (!py::isinstance<py::str>(name) || !py::isinstance<py::dict>(settings)) {
      throw InvalidArgument("sources", std::string(py::repr(settings)),
                            "a dict of names to dicts of the arguments of source()");
    }
    self.attr("source")(name, **py::reinterpret_borrow<py::dict>(settings));
  }
  return std::move(self.cast<BaseLocalizer&>());
}

Array array_of(const Eigen::Vector3d& v) { return Array(3, v.data()); }
Array array_of(const Eigen::Matrix3d& A) {
  Array out({3, 3});
  write_matrix(A, out.mutable_data());
  return out;
}

// {name: f(value)} of a map by names.
template <typename Map, typename Function>
py::dict dict_of(const Map& map, const Function& function) {
  py::dict out;
  for (const auto& [name, value] : map) {
    out[py::str(name)] = function(value);
  }
  return out;
}

void bind_estimate(py::module_& m) {
  py::class_<BaseEstimate>(m, "BaseEstimate", R"(Where the base is at a time, and how sure that is.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.BaseLocalizer(pose=(1, 2, 0.5), t=0.0).estimate().pose
array([1. , 2. , 0.5])
)")
      .def_readonly("t", &BaseEstimate::t, "Time of the estimate, s.")
      .def_property_readonly(
          "pose", [](const BaseEstimate& e) { return array_of(e.pose); },
          "(3,): x, y, theta in m and rad, theta in (-pi, pi].")
      .def_property_readonly(
          "covariance", [](const BaseEstimate& e) { return array_of(e.covariance); },
          "(3, 3), of the pose, in world axes.")
      .def_property_readonly(
          "twist", [](const BaseEstimate& e) { return array_of(e.twist); },
          R"((3,): vx, vy, omega in the body, m/s and rad/s.

The mean over the stretch that ends at t; zero in what no source measures.)")
      .def_property_readonly(
          "twist_covariance", [](const BaseEstimate& e) { return array_of(e.twist_covariance); },
          "(3, 3), of the twist; zero in what no source measures.")
      .def("__repr__", [](const BaseEstimate& e) {
        return "<BaseEstimate t=" + std::string(py::repr(py::float_(e.t))) + " pose=(" +
               text(e.pose.x()) + ", " + text(e.pose.y()) + ", " + text(e.pose.z()) + ")>";
      });
  py::class_<NisStatistics>(m, "NisStatistics", R"(What a source says of its own covariance.

The normalized innovation squared of its accepted measurements. Where model and covariances are
right, `mean` is `dof` and `within` 0.95; a mean far above says that the source is worse than it
claims, far below that it is better.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(covariance=np.eye(3))
>>> localizer.add_pose(0.0, (1.0, 0.0, 0.0), np.eye(3), source="lidar")
True
>>> round(localizer.nis["lidar"].mean, 9), localizer.nis["lidar"].dof
(0.5, 3.0)
)")
      .def_readonly("count", &NisStatistics::count,
                    "Measurements that there was something to compare with.")
      .def_property_readonly(
          "mean",
          [](const NisStatistics& s) {
            return s.count > 0 ? s.sum / static_cast<double>(s.count) : 0.0;
          },
          "Mean of the NIS; 0 without measurements.")
      .def_property_readonly(
          "dof",
          [](const NisStatistics& s) {
            return s.count > 0 ? static_cast<double>(s.dof) / static_cast<double>(s.count) : 0.0;
          },
          "Mean number of entries compared: what the mean NIS should be.")
      .def_property_readonly(
          "within",
          [](const NisStatistics& s) {
            return s.count > 0 ? static_cast<double>(s.within) / static_cast<double>(s.count) : 0.0;
          },
          "Share in the central 95 % band.");
}

}  // namespace

void bind_base_localizer(py::module_& m) {
  bind_estimate(m);
  const BaseLocalizerOptions defaults;
  const auto counted = [](long SourceCounts::*field) {
    return [field](const BaseLocalizer& self) {
      return dict_of(self.counts(), [&](const SourceCounts& c) { return c.*field; });
    };
  };
  py::class_<BaseLocalizer>(m, "BaseLocalizer",
                            R"(Fuses what any number of sources say of a planar base, in any order.

What robot_localization is run for, without ROS: wheels, gyros, LIDAR odometry and poses from a map,
each by name with a covariance and a gate. Measurements may come late and out of order: the last
seconds are kept, and what follows a late one is computed again, so that the result depends on what
was measured and not on when it came. [M17] 3.3; the model stands in the chapter "Localizing the
base".

Parameters
----------
pose : (3,), m and rad
    Where the base is when time begins.
covariance : (3, 3), optional
    How sure that is, world axes. Default: 1e-6 on the diagonal.
gate : float
    A pose, motion or yaw whose NIS exceeds this quantile of its distribution is rejected; 1 takes
    everything. Sources may have their own.
process_noise : (3, 3), optional
    What is added to the pose's covariance each second, world axes: what no source accounts for.
    Default: 1e-4 on the diagonal.
history : float, s
    How late a measurement may come.
t : float, optional, s
    When time begins. Default: with the first measurement.
filter : {'ekf', 'ukf'}
    How uncertain headings are carried: to first order, or by sigma points (alpha = 1, beta = 0,
    kappa = 0).
sources : dict, optional
    Arguments of `source()` by name.

Raises
------
ValueError
    If an argument is not finite, no covariance or out of its range.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(t=0.0)
>>> for k in range(1, 51):
...     _ = localizer.add_twist(0.02 * k, (0.5, 0.0, 0.0), 1e-3 * np.eye(3), source="wheels")
>>> localizer.estimate().pose.round(9)
array([0.5, 0. , 0. ])
>>> localizer.add_pose(0.5, (0.26, 0.0, 0.0), 1e-6 * np.eye(3), source="lidar")  # half a second late
True
>>> localizer.accepted
{'lidar': 1, 'wheels': 50}
)")
      .def(py::init(&make), py::arg("pose") = py::make_tuple(0.0, 0.0, 0.0),
           py::arg("covariance") = py::none(), py::arg("gate") = defaults.gate, py::kw_only(),
           py::arg("process_noise") = py::none(), py::arg("history") = defaults.history,
           py::arg("t") = py::none(), py::arg("filter") = "ekf", py::arg("sources") = py::none())
      .def("source", &declare, py::arg("name"), py::kw_only(), py::arg("fuse") = py::none(),
           py::arg("covariance") = py::none(), py::arg("gate") = py::none(),
           R"(Declare a source, or change it for measurements to come.

A source that is not declared has all variables, the localizer's gate, and must bring a covariance
with each measurement.

Parameters
----------
name : str
fuse : sequence of str, optional
    Out of 'x', 'y', 'theta', 'vx', 'vy', 'omega'. Default: all that it measures.
covariance : (3, 3) or float, optional
    Where a measurement brings none; a float stands for all variables.
gate : float, optional
    Default: the localizer's, for poses, motions and yaw. Twists are only gated by a source's own:
    they are compared with what other sources measure at the same time.

Raises
------
ValueError

Examples
--------
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer()
>>> localizer.source("imu", fuse=["omega", "theta"], covariance=1e-4, gate=0.99)
>>> localizer.add_yaw_rate(0.0, 0.1, source="imu")
True
)")
      .def(
          "add_twist",
          [](BaseLocalizer& self, double t, const ArrayLike& twist, const OptionalArray& covariance,
             const std::string& source) {
            return add_vector(self, Kind::kTwist, t, twist, "twist", covariance, source);
          },
          py::arg("t"), py::arg("twist"), py::arg("covariance") = py::none(), py::kw_only(),
          py::arg("source"), R"(Take a twist: the mean since the previous stamp of that source.

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
)")
      .def(
          "add_pose",
          [](BaseLocalizer& self, double t, const ArrayLike& pose, const OptionalArray& covariance,
             const std::string& source) {
            return add_vector(self, Kind::kPose, t, pose, "pose", covariance, source);
          },
          py::arg("t"), py::arg("pose"), py::arg("covariance") = py::none(), py::kw_only(),
          py::arg("source"), R"(Take a pose, as of a map, a marker or motion capture.

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
)")
      .def("add_relative_pose", &add_motion, py::arg("t1"), py::arg("t2"), py::arg("motion"),
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
)")
      .def(
          "add_yaw_rate",
          [](BaseLocalizer& self, double t, double rate, const OptionalArray& variance,
             const std::string& source) {
            return add_number(self, Kind::kTwist, t, rate, "rate", variance, source);
          },
          py::arg("t"), py::arg("rate"), py::arg("variance") = py::none(), py::kw_only(),
          py::arg("source"), R"(Take a yaw rate, as of a gyro: a twist of which omega counts.

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
)")
      .def(
          "add_yaw",
          [](BaseLocalizer& self, double t, double yaw, const OptionalArray& variance,
             const std::string& source) {
            return add_number(self, Kind::kYaw, t, yaw, "yaw", variance, source);
          },
          py::arg("t"), py::arg("yaw"), py::arg("variance") = py::none(), py::kw_only(),
          py::arg("source"), R"(Take a heading, as of a compass: a pose of which theta counts.

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
)")
      .def("estimate", &BaseLocalizer::estimate, py::arg("t") = py::none(),
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
)")
      .def(
          "reset",
          [](BaseLocalizer& self, const ArrayLike& pose, const ArrayLike& covariance,
             std::optional<double> t) {
            self.reset(read_triple(pose, "pose"), read_matrix(covariance, "covariance"), t);
          },
          py::arg("pose"), py::arg("covariance"), py::arg("t") = py::none(),
          R"(Begin anew: picked up and put down. Sources stay, and so do their counts.

Parameters
----------
pose : (3,), m and rad
covariance : (3, 3)
t : float, optional, s
    When time begins; what is older is refused from now on. Default: with the next measurement.

Raises
------
ValueError

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer()
>>> localizer.reset((1.0, 2.0, 0.5), 1e-4 * np.eye(3), t=30.0)
>>> localizer.estimate().t
30.0
)")
      .def(
          "save", [](const BaseLocalizer& self) { return py::bytes(self.save()); },
          R"(Return everything as bytes of a versioned format, for `restore`. It also pickles.

Returns
-------
bytes

Examples
--------
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(t=0.0)
>>> est.BaseLocalizer.restore(localizer.save()).estimate().t
0.0
)")
      .def_static(
          "restore",
          [](const py::bytes& state) { return BaseLocalizer::restore(std::string(state)); },
          py::arg("state"), R"(Return the localizer that was saved; it goes on to the same bits.

Parameters
----------
state : bytes
    What `save` returned.

Returns
-------
BaseLocalizer

Raises
------
ValueError
    If the bytes are no such state, of another version, cut or changed.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.BaseLocalizer.restore(est.BaseLocalizer(t=3.0).save()).estimate().t
3.0
)")
      .def_property_readonly("accepted", counted(&SourceCounts::accepted),
                             "Measurements that count, by source: the verdict as it stands now.")
      .def_property_readonly("rejected", counted(&SourceCounts::rejected),
                             "Measurements that a gate holds back, by source.")
      .def_property_readonly(
          "refused",
          [](const BaseLocalizer& self) {
            return dict_of(self.refused(), [](long n) { return n; });
          },
          "Measurements that were older than the history when they came, by source.")
      .def_property_readonly(
          "nis",
          [](const BaseLocalizer& self) {
            return dict_of(self.counts(), [](const SourceCounts& c) {
              NisStatistics sum = c.twists;
              sum.add(c.poses);
              return sum;
            });
          },
          "NisStatistics by source.")
      .def_property_readonly("latest", &BaseLocalizer::latest,
                             "Time of the latest measurement, s; None before the first.")
      .def_property_readonly(
          "history", [](const BaseLocalizer& self) { return self.options().history; },
          "How late a measurement may come, s.")
      .def("__len__", &BaseLocalizer::record_size)
      .def("__repr__",
           [](const BaseLocalizer& self) {
             return "<BaseLocalizer of " + std::to_string(self.refused().size()) + " sources, " +
                    std::to_string(self.record_size()) + " measurements in its history>";
           })
      .def("__copy__", [](const BaseLocalizer& self) { return BaseLocalizer(self); })
      .def(
          "__deepcopy__",
          [](const BaseLocalizer& self, const py::dict&) { return BaseLocalizer(self); },
          py::arg("memo"))
      .def(py::pickle(
          [](const BaseLocalizer& self) { return py::bytes(self.save()); },
          [](const py::bytes& state) { return BaseLocalizer::restore(std::string(state)); }));
}

}  // namespace thing_kin::python
