#include "thing_kin/rmma/world.hpp"

#include <array>

#include "rmma/world.hpp"
#include "search_bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

py::tuple pose_tuple(const Pose2& pose) { return py::make_tuple(pose.x(), pose.y(), pose.z()); }

Pose2 read_run_pose(py::handle result, const char* name) {
  std::array<double, 3> values{};
  if (!read_plain(result, {3}, values.data())) {
    const Batch batch = read(result, name, {3}, false);
    std::copy_n(batch.data, 3, values.data());
  }
  return {values[0], values[1], values[2]};
}

double read_duration(py::handle result, const char* name) {
  const double seconds = read(result, name, {}, false).data[0];
  if (!(seconds >= 0.0)) {
    throw InvalidArgument(name, text(seconds), "seconds >= 0");
  }
  return seconds;
}

py::object point(const Eigen::Vector2d& p) { return to_array(p); }

/// A drive in a world of the user's own.
class PythonRun final : public WorldRun {
 public:
  PythonRun(py::object run, double reach) : run_(std::move(run)), reach_(reach) {}

  Pose2 pose(double t) override { return read_run_pose(run_.attr("pose")(t), "world: pose(t)"); }

  Pose2 odometry(double t) override {
    return read_run_pose(run_.attr("odometry")(t), "world: odometry(t)");
  }

  ArmPlacement place(const Eigen::Vector2d& command) override {
    const py::object result = run_.attr("place")(point(command));
    if (!py::isinstance<py::sequence>(result) || py::len(result) != 2) {
      throw InvalidArgument("world: place(u_command)", std::string(py::repr(result)),
                            "(u_true, u_fk)");
    }
    const auto pair = py::reinterpret_borrow<py::sequence>(result);
    return {read_point(py::object(pair[0]), "world: u_true"),
            read_point(py::object(pair[1]), "world: u_fk")};
  }

  bool detects(const Eigen::Vector2d& tool, const Eigen::Vector2d& fiducial) override {
    return py::bool_(run_.attr("detects")(point(tool), point(fiducial)));
  }

  double move_time(const Eigen::Vector2d& from, const Eigen::Vector2d& to) override {
    return read_duration(run_.attr("move_time")(point(from), point(to)), "world: move_time(a, b)");
  }

  double sample_time(const Eigen::Vector2d& from, const Eigen::Vector2d& to) override {
    return read_duration(run_.attr("sample_time")(point(from), point(to)),
                         "world: sample_time(a, b)");
  }

  bool reaches(const Eigen::Vector2d& command) override { return std::abs(command.x()) <= reach_; }

 private:
  py::object run_;
  double reach_;
};

}  // namespace

std::unique_ptr<WorldRun> python_run(const py::object& run, double reach) {
  return std::make_unique<PythonRun>(run, reach);
}

void check_start(WorldRun& run, const SearchPoints& side) {
  constexpr double kNear = 0.1;
  const Eigen::Vector2d expected = side.front() - first_displacement();
  const Eigen::Vector2d at = run.pose(0.0).head<2>();
  if (!((at - expected).norm() <= kNear)) {
    throw InvalidArgument("world: pose(0)", "(" + text(at.x()) + ", " + text(at.y()) + ", ...)",
                          "near the side's first fiducial - (0.20, 0.60), (" + text(expected.x()) +
                              ", " + text(expected.y()) + ")");
  }
}

void bind_world(py::module_& m) {
  py::class_<World> world(m, "World", "The numbers of thing_kin.rmma.World.");
  world.def(py::init([](const py::kwargs& values) {
    World result;
    const py::object self = py::cast(&result);
    for (const auto& [name, value] : values) {
      py::setattr(self, name, value);
    }
    check_world(result);
    return result;
  }));
#define THING_KIN_WORLD_VALUE(name) world.def_readwrite(#name, &World::name)
  THING_KIN_WORLD_VALUE(slip_mean);
  THING_KIN_WORLD_VALUE(slip_std);
  THING_KIN_WORLD_VALUE(speed_std);
  THING_KIN_WORLD_VALUE(speed_length);
  THING_KIN_WORLD_VALUE(heading_std);
  THING_KIN_WORLD_VALUE(curvature_mean);
  THING_KIN_WORLD_VALUE(curvature_std);
  THING_KIN_WORLD_VALUE(heading_walk);
  THING_KIN_WORLD_VALUE(start_lag);
  THING_KIN_WORLD_VALUE(creep);
  THING_KIN_WORLD_VALUE(arm_std);
  THING_KIN_WORLD_VALUE(arm_hidden_std);
  THING_KIN_WORLD_VALUE(sample_std);
  THING_KIN_WORLD_VALUE(odo_bias_std);
  THING_KIN_WORLD_VALUE(odo_std);
  THING_KIN_WORLD_VALUE(odo_length);
  THING_KIN_WORLD_VALUE(odo_white);
  THING_KIN_WORLD_VALUE(odo_heading_std);
  THING_KIN_WORLD_VALUE(detection_radius);
  THING_KIN_WORLD_VALUE(sample_time);
  THING_KIN_WORLD_VALUE(sample_speed);
  THING_KIN_WORLD_VALUE(move_time);
  THING_KIN_WORLD_VALUE(move_speed);
  THING_KIN_WORLD_VALUE(map_std);
  THING_KIN_WORLD_VALUE(u_max);
  THING_KIN_WORLD_VALUE(reach);
#undef THING_KIN_WORLD_VALUE

  py::class_<WorldRun>(m, "WorldRun", R"(One drive along one side of the artifact, as it happens.

Times are in s since the side's first fiducial was registered and may not fall from call to call of
one method; poses and points are in the side's frame. `rmma.World().start(...)` makes one.

Examples
--------
>>> import numpy as np
>>> from thing_kin import rmma
>>> side = np.array([[0.0, 0.6], [0.2, 0.6]])
>>> run = rmma.World().start(0.02, side, np.random.default_rng(0))
>>> run.pose(0.0)[:2]
(-0.2, 0.0)
)")
      .def(
          "pose", [](WorldRun& run, double t) { return pose_tuple(run.pose(t)); }, py::arg("t"),
          R"((x, y, theta) of the base, m and rad, at time t.

Examples
--------
>>> import numpy as np
>>> from thing_kin import rmma
>>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
>>> run.pose(0.0)[:2]
(-0.2, 0.0)
)")
      .def(
          "odometry", [](WorldRun& run, double t) { return pose_tuple(run.odometry(t)); },
          py::arg("t"), R"((x, y, theta) as the base's localization has it at time t.

Examples
--------
>>> import numpy as np
>>> from thing_kin import rmma
>>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
>>> bool(np.allclose(run.odometry(0.0), run.pose(0.0), atol=0.05))
True
)")
      .def(
          "place",
          [](WorldRun& run, const ArrayLike& command) {
            const ArmPlacement placement = run.place(read_point(command, "u_command"));
            return py::make_tuple(to_array(placement.actual), to_array(placement.seen));
          },
          py::arg("u_command"),
          R"(Stop the arm: where the tool is from the base, (2,) m, and where forward kinematics has it, (2,).

After move_time() it has moved to another place of work.

Examples
--------
>>> import numpy as np
>>> from thing_kin import rmma
>>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
>>> true, seen = run.place((0.2, 0.6))
>>> bool(np.linalg.norm(true - seen) < 0.005)
True
)")
      .def(
          "detects",
          [](WorldRun& run, const ArrayLike& tool, const ArrayLike& fiducial) {
            return run.detects(read_point(tool, "tool_xy"), read_point(fiducial, "fiducial"));
          },
          py::arg("tool_xy"), py::arg("fiducial"),
          R"(Whether the laser, read with the tool at `tool_xy`, sees the fiducial listed at `fiducial`.

Examples
--------
>>> import numpy as np
>>> from thing_kin import rmma
>>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
>>> run.detects((0.0, 0.605), (0.0, 0.6)), run.detects((0.0, 0.65), (0.0, 0.6))
(True, False)
)")
      .def(
          "move_time",
          [](WorldRun& run, const ArrayLike& from, const ArrayLike& to) {
            return run.move_time(read_point(from, "a"), read_point(to, "b"));
          },
          py::arg("a"), py::arg("b"), R"(s of a move of the arm to another place of work.

Examples
--------
>>> import numpy as np
>>> from thing_kin import rmma
>>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
>>> round(run.move_time((0.2, 0.6), (0.2, 0.45)), 9)
1.5
)")
      .def(
          "sample_time",
          [](WorldRun& run, const ArrayLike& from, const ArrayLike& to) {
            return run.sample_time(read_point(from, "a"), read_point(to, "b"));
          },
          py::arg("a"), py::arg("b"), R"(s from one reading of the laser to the next.

Examples
--------
>>> import numpy as np
>>> from thing_kin import rmma
>>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
>>> round(run.sample_time((0.2, 0.6), (0.2, 0.618)), 9)
0.26
)");

  m.def(
      "start_run",
      [](const World& values, double velocity, const ArrayLike& side, std::uint64_t key) {
        return start_run(values, velocity, read_points(side, "side", 1), key);
      },
      py::arg("world"), py::arg("velocity"), py::arg("side"), py::arg("key"));
}

}  // namespace thing_kin::python
