#include "thing_kin/inverse/closed_form_ik.hpp"

#include <algorithm>
#include <memory>

#include <pybind11/stl.h>

#include "array.hpp"
#include "bindings.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

/// Solutions as Python sees them: those found, or with images many more.
struct IkSolutions {
  ClosedFormSolutions found;
  std::vector<ClosedFormSolution> images;
  bool with_images = false;
  py::ssize_t n = 0;
  std::string limiting_joint;

  const ClosedFormSolution* data() const { return with_images ? images.data() : found.begin(); }
  py::ssize_t count() const {
    return with_images ? static_cast<py::ssize_t>(images.size()) : found.count;
  }
};

Array q_of(const IkSolutions& s) {
  const py::ssize_t shape[] = {s.count(), s.n};
  Array out = make_array(shape, 2);
  double* to = out.mutable_data();
  for (py::ssize_t i = 0; i < s.count(); ++i) {
    std::copy_n(s.data()[i].q.data(), s.n, to + i * s.n);
  }
  return out;
}

Array error_array(const IkSolutions& s, double ClosedFormSolution::*member) {
  const py::ssize_t shape[] = {s.count()};
  Array out = make_array(shape, 1);
  for (py::ssize_t i = 0; i < s.count(); ++i) {
    out.mutable_data()[i] = s.data()[i].*member;
  }
  return out;
}

py::array_t<bool> exact_of(const IkSolutions& s) {
  py::array_t<bool> out(s.count());
  for (py::ssize_t i = 0; i < s.count(); ++i) {
    out.mutable_data()[i] = s.data()[i].exact;
  }
  return out;
}

std::vector<std::optional<std::string>> singular_of(const IkSolutions& s) {
  std::vector<std::optional<std::string>> names;
  for (py::ssize_t i = 0; i < s.count(); ++i) {
    const ArmSingularity which = s.data()[i].singularity;
    names.push_back(which == ArmSingularity::kNone ? std::nullopt
                                                   : std::optional<std::string>(to_string(which)));
  }
  return names;
}

const char* status_of(const IkSolutions& s) {
  switch (s.found.status) {
    case ClosedFormStatus::kSolved:
      return "solved";
    case ClosedFormStatus::kOutsideLimits:
      return "outside_limits";
    case ClosedFormStatus::kUnreachable:
      break;
  }
  return "unreachable";
}

std::string solutions_text(py::ssize_t count) {
  return std::to_string(count).append(count == 1 ? " solution" : " solutions");
}

std::string limit_text(const IkSolutions& s) {
  return text(s.found.beyond_limit).append(" rad beyond a limit of joint ") + s.limiting_joint;
}

std::string message_of(const IkSolutions& s) {
  const ClosedFormSolutions& found = s.found;
  if (found.status == ClosedFormStatus::kSolved) {
    std::string message = solutions_text(s.count());
    if (found.outside > 0) {
      message.append(", ").append(std::to_string(found.outside)).append(" more beyond limits");
    }
    return message;
  }
  if (found.status == ClosedFormStatus::kOutsideLimits) {
    std::string message = "no solution within the joint limits: of ";
    return message.append(solutions_text(found.outside))
        .append(" the nearest is ")
        .append(limit_text(s));
  }
  if (s.count() == 0) {
    return "unreachable, and the closest poses are beyond joint limits: the nearest is " +
           limit_text(s);
  }
  const ClosedFormSolution& closest = s.data()[0];
  return "unreachable: the closest pose is off by " + text(closest.position_error) + " m and " +
         text(closest.rotation_error) + " rad";
}

ClosedFormIk find(const Chain& chain, int frame) {
  std::optional<ClosedFormIk> ik = ClosedFormIk::find(chain, frame);
  if (!ik) {
    throw InvalidArgument(
        "chain", ClosedFormIk::obstacle(chain, frame),
        "six revolute joints to the frame with three parallel axes (2, 3, 4 or "
        "3, 4, 5), or three that meet (4, 5, 6 or 1, 2, 3); see tk.ik for others");
  }
  return *ik;
}

// One (n) vector, by the hot path.
Batch read_vector(const py::object& argument, const char* name, int n) {
  Batch vector = read_vectors(argument, name, n);
  return vector.single ? vector : read(argument, name, {n}, false);
}

// x, y and theta, or nothing for an arm alone.
Batch read_base(const Chain& chain, const py::object& base, bool respect_limits) {
  if (!chain.base_joints()) {
    if (!base.is_none()) {
      throw InvalidArgument("base", "a base pose", "None: the chain has no base");
    }
    return {};
  }
  if (base.is_none()) {
    throw InvalidArgument("base", "None", "(x, y, theta): the chain stands on a base");
  }
  Batch pose = read_vector(base, "base", 3);
  check_magnitude(pose, "base");
  for (std::size_t i = 0; respect_limits && i < 3; ++i) {
    const int joint = (*chain.base_joints())[i];
    const double value = pose.data[i];
    if (value < chain.lower()[joint] || value > chain.upper()[joint]) {
      throw InvalidArgument(
          "base",
          text(value) + " for " + quoted(chain.joint_names()[static_cast<std::size_t>(joint)]),
          "a value within its limits, or respect_limits=False");
    }
  }
  return pose;
}

Batch read_weights(const py::object& weights, int n) {
  Batch read_in = read_vector(weights, "weights", n);
  for (int i = 0; i < n; ++i) {
    if (!(read_in.data[i] >= 0.0)) {
      throw InvalidArgument("weights", text(read_in.data[i]), "numbers of at least 0");
    }
  }
  check_magnitude(read_in, "weights");
  return read_in;
}

std::unique_ptr<IkSolutions> ik_all(const Chain& chain, const ArrayLike& target,
                                    const py::object& seed, const py::object& base,
                                    const FrameLike& frame, bool respect_limits, bool images,
                                    const py::object& weights) {
  const ClosedFormIk ik = find(chain, read_frame(chain, frame, "frame"));
  const Batch pose = read(target, "target", {4, 4}, false);
  check_magnitude(pose, "target");
  const SE3 T = read_pose(pose.data, "target");
  const Batch place = read_base(chain, base, respect_limits);
  ClosedFormOptions options;
  options.respect_limits = respect_limits;
  Batch near, by;
  if (!seed.is_none()) {
    near = read_vector(seed, "seed", chain.dof());
    check_magnitude(near, "seed");
    options.seed = near.data;
  }
  if (!weights.is_none()) {
    by = read_weights(weights, chain.dof());
    options.weights = by.data;
  }
  if (images && !respect_limits) {
    throw InvalidArgument("images", "True with respect_limits=False", "limits to keep within");
  }
  auto result = std::make_unique<IkSolutions>();
  result->n = chain.dof();
  {
    const py::gil_scoped_release release;
    ik.solve(T, place.data, result->found, options);
    if (images) {
      result->images = ik.with_images(T, result->found, options);
      result->with_images = true;
    }
  }
  if (result->found.limiting_joint >= 0) {
    const auto joint = static_cast<std::size_t>(result->found.limiting_joint);
    result->limiting_joint = quoted(chain.joint_names()[joint]);
  }
  return result;
}

void bind_solutions(py::module_& m) {
  py::class_<IkSolutions>(m, "IkSolutions", R"(What ik_all found: a sequence of configurations.

len(), iteration and indexing are those of q, and numpy takes it for q. Which solutions are worth
having, and why there are none, is said beside it.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> arm = tk.robots.ur5()
>>> solutions = tk.ik_all(arm, arm.fk([0.1, -1.2, 1.4, -0.6, 1.2, 0.0]))
>>> solutions
IkSolutions(8 solutions)
>>> np.asarray(solutions).shape, solutions.exact.all().item()
((8, 6), True)
)")
      .def_property_readonly("q", &q_of, "(k, n), rad and m: one solution a row.")
      .def_property_readonly("exact", &exact_of, "(k,) bool: whether both errors are at most 1e-9.")
      .def_property_readonly(
          "position_error",
          [](const IkSolutions& s) { return error_array(s, &ClosedFormSolution::position_error); },
          "(k,), m: distance from the target, by forward kinematics.")
      .def_property_readonly(
          "rotation_error",
          [](const IkSolutions& s) { return error_array(s, &ClosedFormSolution::rotation_error); },
          "(k,), rad: angle from the target, by forward kinematics.")
      .def_property_readonly("singular", &singular_of,
                             "For each solution 'shoulder', 'elbow' or 'wrist' where two branches "
                             "meet, within 1e-6 rad or so; else None.")
      .def_property_readonly("status", &status_of,
                             "'solved'; 'outside_limits': reached, but only beyond joint limits, "
                             "and so empty; 'unreachable': what is here comes closest.")
      .def_property_readonly("message", &message_of, "The same in words, with numbers.")
      .def("__len__", &IkSolutions::count)
      .def("__iter__", [](const IkSolutions& s) { return py::iter(q_of(s)); })
      .def("__getitem__",
           [](const IkSolutions& s, const py::object& index) -> py::object {
             return q_of(s)[index];
           })
      .def(
          "__array__",
          [](const IkSolutions& s, const py::object& dtype, const py::object& copy) -> py::object {
            if (!copy.is_none() && !copy.cast<bool>()) {
              throw InvalidArgument("copy", "False", "None or True: q is made anew");
            }
            const Array q = q_of(s);
            return dtype.is_none() ? py::object(q) : q.attr("astype")(dtype);
          },
          py::arg("dtype") = py::none(), py::arg("copy") = py::none())
      .def("__repr__", [](const IkSolutions& s) { return "IkSolutions(" + message_of(s) + ")"; });
}

}  // namespace

void bind_closed_form_ik(py::module_& m) {
  bind_solutions(m);
  m.def("ik_all", &ik_all, py::arg("chain"), py::arg("target"), py::kw_only(),
        py::arg("seed") = py::none(), py::arg("base") = py::none(), py::arg("frame") = py::none(),
        py::arg("respect_limits") = true, py::arg("images") = false,
        py::arg("weights") = py::none(),
        R"(Every configuration of a six-joint arm for a pose, in closed form.

For arms with three parallel axes (2, 3, 4 or 3, 4, 5), such as those of Universal Robots, and arms
with a spherical wrist (axes 4, 5, 6 meet) or shoulder (1, 2, 3), on a base or not; their axes decide,
not their names. Up to eight branches by subproblems after Pieper (1968), Paden (1986), and Elias and
Wen (2022), each checked by forward kinematics, and polished where rounded dimensions ask for it.

A joint stands at the turn that is within its limits and nearest to the seed's, or without a seed to
the middle of its range (0 if it has none). Where a joint is free, at a singularity, it stays there:
the last of the wrist (in an arm that is solved from its hand, the first), as far as the elbow reaches
if that moves it; joint 1 where the wrist's center is on its axis, joint 2 where it is on that.

Parameters
----------
chain : Chain
target : (4, 4)
    Pose of the frame in the root.
seed : (n,), rad and m, optional
    Solutions come nearest first. Without it: in a fixed order, by shoulder, then wrist, then elbow,
    or for a spherical wrist by shoulder, elbow, wrist.
base : (3,), optional
    x, y (m) and theta (rad) of the base, for a chain on one: solutions are for this place.
frame : str or int, optional
    Name (or index) from `frames`, behind the last joint; default: the last, the tool.
respect_limits : bool
    Leave out what is beyond joint limits in every turn.
images : bool
    All turns of all joints that are within limits, not only the nearest. At most 100 000.
weights : (n,), optional
    Of the squared differences in the distance to the seed; default 1.

Returns
-------
IkSolutions
    Where the arm can't reach the target, the closest it comes (m and rad count alike), marked as
    not exact; where it only can beyond its limits, nothing; the message says so.

Raises
------
ValueError
    If the arm has no closed form here, an argument has a wrong shape or is not finite, the target is
    not rigid, or the base is missing or beyond its limits.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.3, -0.2, 0.4])
>>> solutions = tk.ik_all(robot, robot.fk(q), seed=q, base=q[6:])
>>> len(solutions), np.allclose(solutions[0], q, atol=1e-9)
(8, True)
>>> tk.ik_all(robot, tk.transform(xyz=(0, 0, 3)), base=(0, 0, 0)).status
'unreachable'
)");
  m.def(
      "has_closed_form",
      [](const Chain& chain, const FrameLike& frame) {
        return ClosedFormIk::find(chain, read_frame(chain, frame, "frame")).has_value();
      },
      py::arg("chain"), py::arg("frame") = py::none(),
      R"(Whether ik_all takes this chain.

Parameters
----------
chain : Chain
frame : str or int, optional
    Name (or index) from `frames`; default: the last, the tool.

Returns
-------
bool

Raises
------
ValueError
    If there is no such frame.

Examples
--------
>>> import thing_kin as tk
>>> tk.has_closed_form(tk.robots.ur10()), tk.has_closed_form(tk.robots.ur10(), "forearm")
(True, False)
)");
}

}  // namespace thing_kin::python
