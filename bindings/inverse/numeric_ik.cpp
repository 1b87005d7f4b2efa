#include "thing_kin/inverse/numeric_ik.hpp"

#include <optional>
#include <vector>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "inverse/ik_result.hpp"
#include "map.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

/// A whole number or a numpy.random.Generator.
class RandomLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(RandomLike, object, [](PyObject*) { return 1; })
};

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::RandomLike> {
  static constexpr auto name = const_name("typing.SupportsIndex | numpy.random.Generator");
};

}  // namespace pybind11::detail

namespace thing_kin::python {

namespace {

std::uint64_t read_rng(const RandomLike& rng) {
  try {
    if (py::isinstance<py::int_>(rng)) {
      return rng.cast<std::uint64_t>();
    }
    if (py::hasattr(rng, "integers")) {
      return rng.attr("integers")(std::uint64_t{1} << 63U).cast<std::uint64_t>();
    }
    const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(rng.ptr()));
    if (index) {
      return index.cast<std::uint64_t>();
    }
    throw py::error_already_set();
  } catch (const std::exception&) {
    throw InvalidArgument("rng", py::repr(rng),
                          "a whole number from 0 to 2^64 - 1 or a numpy.random.Generator");
  }
}

// What a target is: which of a pose's parts are asked for, and how they are written.
enum class Part : std::uint8_t { kPose, kPosition, kOrientation };

Part part_from_string(const std::string& name) {
  if (name == "pose") {
    return Part::kPose;
  }
  if (name == "position") {
    return Part::kPosition;
  }
  if (name == "orientation") {
    return Part::kOrientation;
  }
  throw InvalidArgument("task", quoted(name), "'pose', 'position' or 'orientation'");
}

void read_weights(const OptionalArray& argument, Part part, PoseWeights& weights) {
  if (!argument.is_none()) {
    const Batch numbers = read(argument, "weights", {6}, false);
    std::copy_n(numbers.data, 6, weights.weight.begin());
  }
  if (part == Part::kPosition) {
    std::fill_n(weights.weight.begin() + 3, 3, 0.0);
  } else if (part == Part::kOrientation) {
    std::fill_n(weights.weight.begin(), 3, 0.0);
  }
}

JointVector read_joints(const OptionalArray& argument, const char* name, const Chain& chain) {
  return argument.is_none() ? JointVector()
                            : read_number_or_vector(argument, name, chain.dof(), Finite::kNo);
}

// The options of one solver in the order of the arguments below.
struct Arguments {
  Part part;
  IkOptions options;

  Arguments(const Chain& chain, const std::string& task, const OptionalArray& weights,
            const std::string& weight_axes, double position_tolerance, double rotation_tolerance,
            const OptionalArray& joint_weights, const OptionalArray& max_step, bool nearest,
            const std::string& objective, int max_iterations, int max_restarts,
            std::optional<double> deadline, const RandomLike& rng)
      : part(part_from_string(task)) {
    options.weights.axes = weight_axes_from_string(weight_axes);
    read_weights(weights, part, options.weights);
    options.position_tolerance = position_tolerance;
    options.rotation_tolerance = rotation_tolerance;
    options.joint_weights = read_joints(joint_weights, "joint_weights", chain);
    options.max_step = read_joints(max_step, "max_step", chain);
    options.nearest = nearest;
    options.objective = ik_objective_from_string(objective);
    options.max_iterations = max_iterations;
    options.max_restarts = max_restarts;
    options.deadline = deadline.value_or(options.deadline);
    options.rng = read_rng(rng);
  }
};

// A solver with the Python object of its chain, which it refers to.
struct BoundIk {
  BoundIk(const Chain& of, const FrameLike& frame, const Arguments& arguments)
      : chain(py::cast(&of, py::return_value_policy::reference)),
        part(arguments.part),
        solver(of, read_frame(of, frame, "frame"), arguments.options) {}

  py::object chain;
  Part part;
  NumericIk solver;
};

Batch read_targets(Part part, const py::object& target) {
  switch (part) {
    case Part::kPosition:
      return read(target, "target", {3});
    case Part::kOrientation:
      return read(target, "target", {3, 3});
    case Part::kPose:
      break;
  }
  return read(target, "target", {4, 4});
}

SE3 target_at(Part part, const double* numbers) {
  switch (part) {
    case Part::kPosition:
      return {Eigen::Matrix3d::Identity(), Eigen::Map<const Eigen::Vector3d>(numbers)};
    case Part::kOrientation:
      return {read_rotation(numbers, "target"), Eigen::Vector3d::Zero()};
    case Part::kPose:
      break;
  }
  return read_pose(numbers, "target");
}

Batch read_seeds(const IkOptions& options, const OptionalArray& seed, py::ssize_t n,
                 const Batch& targets) {
  if (seed.is_none()) {
    if (options.nearest || options.max_step.size() > 0 || options.objective == IkObjective::kSeed) {
      throw InvalidArgument("seed", "None",
                            "a configuration, for nearest, max_step or objective='seed'");
    }
    return {};
  }
  const Batch seeds = read_vectors(seed, "seed", n);
  if (!seeds.single && (targets.single || seeds.count != targets.count)) {
    throw InvalidArgument("seed", std::to_string(seeds.count).append(" configurations"),
                          "one, or one a target");
  }
  return seeds;
}

py::object solve_many(const BoundIk& ik, const Batch& targets, const Batch& seeds, int threads) {
  std::vector<SE3> poses;
  poses.reserve(static_cast<std::size_t>(targets.count));
  for (py::ssize_t i = 0; i < targets.count; ++i) {
    poses.push_back(target_at(ik.part, targets.item(i)));
  }
  ExplainedIkBatch out(ik.chain, targets.count);
  const IkBatchResult results{out.q.mutable_data(),
                              out.status.mutable_data(),
                              out.position_error.mutable_data(),
                              out.rotation_error.mutable_data(),
                              out.active_limits.mutable_data(),
                              out.iterations.mutable_data(),
                              out.restarts.mutable_data(),
                              out.time.mutable_data()};
  {
    const py::gil_scoped_release release;
    ik.solver.solve({poses.data(), seeds.data, seeds.single, poses.size(), threads}, results);
  }
  return py::cast(std::move(out));
}

py::object solve(const BoundIk& ik, const ArrayLike& target, const OptionalArray& seed,
                 const ThreadCount& threads) {
  const int most = read_threads(threads);
  const Batch targets = read_targets(ik.part, target);
  const Batch seeds = read_seeds(ik.solver.options(), seed, ik.solver.chain().dof(), targets);
  if (!targets.single) {
    return solve_many(ik, targets, seeds, most);
  }
  const SE3 pose = target_at(ik.part, targets.data);
  ExplainedIk out{{}, ik.chain};
  JointVector start;
  if (seeds.data != nullptr) {
    start = vector_at(seeds, 0);
  }
  {
    const py::gil_scoped_release release;
    out.result = ik.solver.solve(pose, seeds.data == nullptr ? nullptr : start.data());
  }
  return py::cast(std::move(out));
}

}  // namespace

void bind_numeric_ik(py::module_& m) {
  const IkOptions defaults;
  const auto none = py::none();
  const auto options = [&](auto&& define) {
    define(py::arg("frame") = none, py::arg("task") = "pose", py::arg("weights") = none,
           py::arg("weight_axes") = "target",
           py::arg("position_tolerance") = defaults.position_tolerance,
           py::arg("rotation_tolerance") = defaults.rotation_tolerance,
           py::arg("joint_weights") = none, py::arg("max_step") = none,
           py::arg("nearest") = defaults.nearest,
           py::arg("objective") = to_string(defaults.objective),
           py::arg("max_iterations") = defaults.max_iterations,
           py::arg("max_restarts") = defaults.max_restarts, py::arg("deadline") = none,
           py::arg("rng") = defaults.rng);
  };

  py::class_<BoundIk> solver(m, "NumericIk", R"(Numerical inverse kinematics of any chain.

A damped Gauss-Newton descent (Levenberg-Marquardt with the damping in proportion to the cost,
Sugihara 2011) on the exact Jacobian of the log error (4.28). It never leaves the joint limits, gives
up early where it stalls and begins anew, from the best of a few low-discrepancy samples. What it
calls a success is checked by forward kinematics. The result depends on target, seed and options
alone.

Immutable: any number of threads may share one. For a control loop: tk.ik makes one a call.

Parameters
----------
chain : Chain
frame : str or int, optional
    The frame that is to reach the target; default the last.
task : str
    'pose': targets (4, 4). 'position': targets (3,), m, any orientation. 'orientation': targets
    (3, 3), any position.
weights : (6,), optional
    How much each coordinate [x, y, z, rx, ry, rz] matters; 0: it is free. Default ones.
weight_axes : str
    The axes they are of: 'target' or 'world'. Weights (1, 1, 1, 1, 1, 0) of the target leave the
    hand's turn about its own z free.
position_tolerance, rotation_tolerance : float > 0
    m and rad, of the coordinates that count.
joint_weights : float or (n,), optional
    Cost of each joint's motion: a joint with a larger weight moves less. Default ones.
max_step : float or (n,), optional
    How far from the seed each joint may be, rad and m. Fails rather than jumps. Needs a seed.
nearest : bool
    Search on for the solution nearest to the seed, by joint_weights. Needs a seed.
objective : str
    What to do with freedom that is left: 'none'; 'seed': stay near it; 'limits': keep to the middle
    of the joint ranges; 'manipulability': (4.30). A local optimum.
max_iterations, max_restarts : int
    Of one target, all attempts together.
deadline : float, optional
    Seconds for one target. With it, results are no longer the same on any machine.
rng : int or numpy.random.Generator
    Which restarts are tried.

Raises
------
ValueError
    If an option does not fit the chain.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> arm = tk.robots.ur10()
>>> solver = tk.NumericIk(arm, max_step=0.1)
>>> q = np.array([0.1, -1.0, 1.2, -0.5, 0.8, 0.0])
>>> result = solver.solve(arm.fk(q + 0.05), seed=q)
>>> result.success, bool(np.abs(result.q - q).max() < 0.1)
(True, True)
)");
  options([&](auto&&... extra) {
    solver.def(
        py::init([](const Chain& chain, const FrameLike& frame, const std::string& task,
                    const OptionalArray& weights, const std::string& weight_axes,
                    double position_tolerance, double rotation_tolerance,
                    const OptionalArray& joint_weights, const OptionalArray& max_step, bool nearest,
                    const std::string& objective, int max_iterations, int max_restarts,
                    std::optional<double> deadline, const RandomLike& rng) {
          return std::make_unique<BoundIk>(
              chain, frame,
              Arguments(chain, task, weights, weight_axes, position_tolerance, rotation_tolerance,
                        joint_weights, max_step, nearest, objective, max_iterations, max_restarts,
                        deadline, rng));
        }),
        py::arg("chain"), py::kw_only(), extra...);
  });
  solver.def_property_readonly(
            "chain", [](const BoundIk& ik) { return ik.chain; }, "The chain.")
      .def("solve", &solve, py::arg("target"), py::arg("seed") = none, py::kw_only(),
           py::arg("threads") = none, R"(Solves one target or many.

Parameters
----------
target : (4, 4), (3,) or (3, 3), or N of them
    As the task says, in the root.
seed : (n,) or (N, n), optional
    Where to begin; brought into the limits first. One for all targets, or one a target.
threads : int, optional
    At most; by default as many as pay. The result does not depend on it.

Returns
-------
IkResult or IkBatchResult

Raises
------
ValueError
    If a shape does not fit, a number is not finite or a pose is not rigid; if the options need a
    seed and there is none.

Examples
--------
>>> import thing_kin as tk
>>> robot = tk.robots.thing()
>>> targets = robot.fk(robot.random(4, rng=1))
>>> tk.NumericIk(robot).solve(targets)
IkBatchResult(4 of 4 reached)
)")
      .def("__repr__", [](const BoundIk& ik) {
        return py::str("NumericIk({!r})").format(ik.solver.chain().name());
      });

  options([&](auto&&... extra) {
    m.def(
        "ik",
        [](const Chain& chain, const ArrayLike& target, const OptionalArray& seed,
           const FrameLike& frame, const std::string& task, const OptionalArray& weights,
           const std::string& weight_axes, double position_tolerance, double rotation_tolerance,
           const OptionalArray& joint_weights, const OptionalArray& max_step, bool nearest,
           const std::string& objective, int max_iterations, int max_restarts,
           std::optional<double> deadline, const RandomLike& rng, const ThreadCount& threads) {
          const BoundIk ik(chain, frame,
                           Arguments(chain, task, weights, weight_axes, position_tolerance,
                                     rotation_tolerance, joint_weights, max_step, nearest,
                                     objective, max_iterations, max_restarts, deadline, rng));
          return solve(ik, target, seed, threads);
        },
        py::arg("chain"), py::arg("target"), py::arg("seed") = none, py::kw_only(), extra...,
        py::arg("threads") = none, R"(Joint angles that bring a frame to a target.

Never raises because there is no solution: the result says why, and is as near as could be.

Parameters
----------
chain : Chain
target : (4, 4) or (N, 4, 4)
    In the root; (3,) for task='position', (3, 3) for task='orientation'.
seed : (n,) or (N, n), optional
    Where to begin; brought into the limits first.
frame, task, weights, weight_axes, position_tolerance, rotation_tolerance, joint_weights, max_step, nearest, objective, max_iterations, max_restarts, deadline, rng
    See NumericIk.
threads : int, optional
    At most, for many targets; by default as many as pay. The result does not depend on it.

Returns
-------
IkResult or IkBatchResult

Raises
------
ValueError
    If an argument does not fit the chain; if nearest, max_step or objective='seed' have no seed.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> T = robot.fk(robot.random(rng=5))
>>> result = tk.ik(robot, T, seed=np.zeros(9))
>>> result.success, bool(np.allclose(robot.fk(result.q), T, atol=1e-6))
(True, True)
>>> tk.ik(robot, (1.0, 2.0, 50.0), task="position").message
'48.1... m beyond reach'
)");
  });
}

}  // namespace thing_kin::python
