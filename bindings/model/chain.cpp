#include "thing_kin/model/chain.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include "array.hpp"
#include "bindings.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

py::object random(const Chain& chain, const std::optional<py::ssize_t>& count,
                  const py::object& rng) {
  if (count && *count < 0) {
    throw InvalidArgument("n", std::to_string(*count), "a number >= 0");
  }
  JointVector lower = chain.lower();
  JointVector upper = chain.upper();
  for (int i = 0; i < chain.dof(); ++i) {
    const bool below = std::isfinite(lower[i]);
    const bool above = std::isfinite(upper[i]);
    if (below && above) {
      continue;
    }
    const auto k = static_cast<std::size_t>(i);
    if (chain.joint_types()[k] == JointType::kPrismatic) {
      throw InvalidArgument(chain.joint_names()[k], "a joint without limits",
                            "limits to draw from (Chain.with_limits)");
    }
    // Every angle once: in +-pi, or from the one limit there is.
    if (below) {
      upper[i] = lower[i] + 2 * std::numbers::pi;
    } else {
      upper[i] = above ? upper[i] : std::numbers::pi;
      lower[i] = upper[i] - 2 * std::numbers::pi;
    }
  }
  const py::object generator = py::module_::import("numpy.random").attr("default_rng")(rng);
  const py::object size = count ? py::object(py::make_tuple(*count, chain.dof()))
                                : py::object(py::make_tuple(chain.dof()));
  return generator.attr("uniform")(Array(lower.size(), lower.data()),
                                   Array(upper.size(), upper.data()), size);
}

Chain with_limits(const Chain& chain, const py::object& lower, const py::object& upper,
                  const py::object& velocity, const py::object& acceleration) {
  std::vector<JointLimits> limits = chain.limits();
  const auto set = [&](const py::object& values, const char* name, double JointLimits::*member,
                       auto read_numbers) {
    if (values.is_none()) {
      return;
    }
    const SmallVector numbers = read_numbers(values, name, chain.dof());
    for (std::size_t i = 0; i < limits.size(); ++i) {
      limits[i].*member = numbers[static_cast<Eigen::Index>(i)];
    }
  };
  set(lower, "lower", &JointLimits::lower, read_limits);
  set(upper, "upper", &JointLimits::upper, read_limits);
  set(velocity, "velocity_limits", &JointLimits::velocity, read_rates);
  set(acceleration, "acceleration_limits", &JointLimits::acceleration, read_rates);
  return chain.with_limits(limits);
}

}  // namespace

int read_frame(const Chain& chain, const py::object& frame, const char* name) {
  if (frame.is_none()) {
    return chain.tool();
  }
  // The C API, because a cast would throw for what does not fit: a huge int, a lone surrogate.
  if (PyUnicode_Check(frame.ptr())) {
    if (const char* utf8 = PyUnicode_AsUTF8(frame.ptr())) {
      return chain.frame_index(utf8, name);
    }
  }
  const auto count = static_cast<py::ssize_t>(chain.frames().size());
  if (PyLong_Check(frame.ptr())) {
    const py::ssize_t index = PyLong_AsSsize_t(frame.ptr());
    if (PyErr_Occurred() == nullptr && index >= 0 && index < count) {
      return static_cast<int>(index);
    }
  }
  PyErr_Clear();
  throw InvalidArgument(name, std::string(py::repr(frame)),
                        "the name of a frame or an index from 0 to " + std::to_string(count - 1));
}

void check_omni_base(const Chain& chain) {
  if (!chain.base_joints()) {
    throw InvalidArgument("robot", quoted(chain.name()).append(" without a base"),
                          "a robot on an omnidirectional base (on_omni_base)");
  }
}

SmallVector read_limits(const py::object& values, const char* name, int n) {
  return vector_at(read(values, name, {n}, false, Finite::kNo), 0);
}

SmallVector read_rates(const py::object& values, const char* name, int n) {
  const SmallVector rates = read_limits(values, name, n);
  for (const double rate : rates) {
    if (!(rate > 0.0)) {
      throw InvalidArgument(name, text(rate), "numbers > 0 (inf: unlimited)");
    }
  }
  return rates;
}

ChainClass bind_chain(py::module_& m) {
  ChainClass chain(m, "Chain", R"(An immutable serial chain of joints, and its kinematics.

Made by Chain.from_dh, Chain.from_urdf, on_omni_base or the functions of thing_kin.robots.
Configurations q are (n,) in the order of `names`, rad and m; a leading axis is a batch. Two chains
of equal content are equal; a chain can be hashed, copied, pickled and shared between threads.

Examples
--------
>>> import thing_kin as tk
>>> robot = tk.robots.ur5()
>>> robot
Chain('ur5', n=6)
>>> robot.names
('q0', 'q1', 'q2', 'q3', 'q4', 'q5')
)");
  chain
      .def_static(
          "from_dh",
          [](const std::vector<DhRow>& rows, const std::string& name) {
            return Chain::from_dh(rows, name);
          },
          py::arg("rows"), py::kw_only(), py::arg("name") = "chain",
          R"(Chain from standard Denavit-Hartenberg rows, [M17] (3.7), (3.8).

Parameters
----------
rows : sequence of DH
    At least one joint, at most 32.
name : str

Raises
------
ValueError
    If there is no row or no joint, or two joints or frames have one name.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_dh([tk.DH(a=1.0, joint="revolute"), tk.DH(a=0.5, joint="revolute")])
>>> arm.fk([0.0, 0.0])[:3, 3]
array([1.5, 0. , 0. ])
)")
      .def_property_readonly("name", &Chain::name, "Name of the robot.")
      .def_property_readonly("n", &Chain::dof, "Number of joints.")
      .def_property_readonly(
          "names", [](const Chain& c) { return py::tuple(py::cast(c.joint_names())); },
          "Names of the joints, in the order of q.")
      .def_property_readonly(
          "joint_types",
          [](const Chain& c) {
            py::list types;
            for (const JointType type : c.joint_types()) {
              types.append(to_string(type));
            }
            return py::tuple(types);
          },
          "'revolute', 'continuous' or 'prismatic', in the order of q.")
      .def_property_readonly(
          "frames",
          [](const Chain& c) {
            py::list names;
            for (const Chain::Frame& frame : c.frames()) {
              names.append(frame.name);
            }
            return py::tuple(names);
          },
          "Names of all frames, from the root to the tool.")
      .def_property_readonly(
          "lower", [](const Chain& c) { return frozen(c.lower()); },
          "Lower position limits, (n,), rad or m.")
      .def_property_readonly(
          "upper", [](const Chain& c) { return frozen(c.upper()); },
          "Upper position limits, (n,), rad or m.")
      .def_property_readonly(
          "velocity_limits", [](const Chain& c) { return frozen(c.velocity_limits()); },
          "Velocity limits, (n,), rad/s or m/s; inf: unlimited.")
      .def_property_readonly(
          "acceleration_limits", [](const Chain& c) { return frozen(c.acceleration_limits()); },
          "Acceleration limits, (n,), rad/s^2 or m/s^2; inf: unlimited.")
      .def_property_readonly(
          "base_joints",
          [](const Chain& c) -> std::optional<std::tuple<int, int, int>> {
            if (!c.base_joints()) {
              return std::nullopt;
            }
            const auto& [x, y, theta] = *c.base_joints();
            return std::tuple(x, y, theta);
          },
          "Places in q of the base's x, y and theta; None without an omnidirectional base.")
      .def("random", &random, py::arg("n") = py::none(), py::arg("rng") = py::none(),
           R"(Configurations drawn uniformly within the limits.

Exactly np.random.default_rng(rng).uniform(lower, upper, size); a joint that turns without limits,
as a continuous one does, is drawn in +-pi, one with a single limit in the turn next to it.

Parameters
----------
n : int, optional
    How many; default: one, without a batch axis.
rng : int or numpy.random.Generator, optional
    Seed or generator.

Returns
-------
(dof,) or (n, dof)

Raises
------
ValueError
    If a prismatic joint has no limits.

Examples
--------
>>> import thing_kin as tk
>>> tk.robots.ur5().random(3, rng=0).shape
(3, 6)
)")
      .def(
          "with_tool",
          [](const Chain& c, const ArrayLike& tool, const std::string& frame) {
            const Batch batch = read(tool, "tool", {4, 4}, false);
            return c.with_tool(read_pose(batch.data, "tool"), frame);
          },
          py::arg("tool"), py::kw_only(), py::arg("frame") = "tool",
          R"(The same chain with a fixed frame added at its end.

A frame of the same name at the old end becomes 'flange' (flange2, ... if there is one).

Parameters
----------
tool : (4, 4)
    Pose of the tool in the last frame.
frame : str
    Name of the new frame.

Examples
--------
>>> import thing_kin as tk
>>> robot = tk.robots.ur5().with_tool(tk.transform(xyz=(0, 0, 0.1)))
>>> robot.frames[-2:]
('flange', 'tool')
)")
      .def("with_limits", &with_limits, py::kw_only(), py::arg("lower") = py::none(),
           py::arg("upper") = py::none(), py::arg("velocity_limits") = py::none(),
           py::arg("acceleration_limits") = py::none(), R"(The same chain with other limits.

Parameters
----------
lower, upper, velocity_limits, acceleration_limits : (n,), optional
    Each replaces the chain's own; inf means unlimited.

Raises
------
ValueError
    If a shape is wrong, limits are crossed, rates are not positive or a continuous joint is given
    a position limit.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> tk.robots.ur5().with_limits(upper=np.full(6, 3.0)).upper
array([3., 3., 3., 3., 3., 3.])
)")
      .def(py::self == py::self)
      .def("__hash__",
           [](const Chain& c) {
             return py::hash(py::make_tuple(c.name(), c.dof(), c.frames().size(), c.lower().sum(),
                                            c.frames().back().offset.translation.sum()));
           })
      .def("__str__", [](const Chain& c) { return to_table(c); })
      .def("__repr__",
           [](const Chain& c) { return py::str("Chain({!r}, n={})").format(c.name(), c.dof()); })
      .def("__copy__", [](const Chain& c) { return c; })
      .def("__deepcopy__", [](const Chain& c, const py::dict& /*memo*/) { return c; });
  return chain;
}

}  // namespace thing_kin::python
