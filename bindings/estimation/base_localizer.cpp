#include "thing_kin/estimation/base_localizer.hpp"

#include <memory>
#include <optional>

#include <pybind11/stl.h>

#include "estimation_bindings.hpp"
#include "localizer_bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

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
    options.covariance = read_triple_matrix(covariance, "covariance");
  }
  if (!process_noise.is_none()) {
    options.process_noise = read_triple_matrix(process_noise, "process_noise");
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

// {name: f(value)} of a map by names.
template <typename Map, typename Function>
py::dict dict_of(const Map& map, const Function& function) {
  py::dict out;
  for (const auto& [name, value] : map) {
    out[py::str(name)] = function(value);
  }
  return out;
}

}  // namespace

void bind_base_localizer(py::module_& m) {
  bind_localizer_results(m);
  const BaseLocalizerOptions defaults;
  const auto counted = [](long SourceCounts::*field) {
    return [field](const BaseLocalizer& self) {
      return dict_of(self.counts(), [&](const SourceCounts& c) { return c.*field; });
    };
  };
  py::class_<BaseLocalizer> localizer(
      m, "BaseLocalizer",
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
)");
  localizer
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
)");
  bind_localizer_measurements(localizer);
  localizer
      .def(
          "reset",
          [](BaseLocalizer& self, const ArrayLike& pose, const ArrayLike& covariance,
             std::optional<double> t) {
            self.reset(read_triple(pose, "pose"), read_triple_matrix(covariance, "covariance"), t);
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
