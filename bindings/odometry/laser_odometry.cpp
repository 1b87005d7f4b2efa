#include "thing_kin/odometry/laser_odometry.hpp"

#include <mutex>
#include <optional>
#include <vector>

#include "odometry/scan.hpp"
#include "odometry/scan_matching.hpp"
#include "odometry_bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

const char* status_name(LaserStatus status) {
  switch (status) {
    case LaserStatus::kFirst:
      return "first";
    case LaserStatus::kTracking:
      return "tracking";
    case LaserStatus::kStill:
      return "still";
    case LaserStatus::kLost:
      break;
  }
  return "lost";
}

// The odometry and what it has said; one call at a time, from whatever thread.
struct Track {
  LaserOdometry odometry;
  std::vector<Pose2> poses;
  mutable std::mutex busy;

  // A copy, made while nothing changes it.
  template <typename Get>
  auto look(const Get& get) const {
    const std::scoped_lock lock(busy);
    return get();
  }

  Track(const Scanner& scanner, const LaserOdometryOptions& options) : odometry(scanner, options) {}
};

std::optional<PlanarEstimate> read_motion(const OptionalArray& motion,
                                          const OptionalArray& covariance) {
  if (motion.is_none()) {
    if (!covariance.is_none()) {
      throw InvalidArgument("motion_covariance", "a matrix", "None, as there is no motion");
    }
    return std::nullopt;
  }
  PlanarEstimate measured{.pose = read_planar(motion, "motion"),
                          .covariance = Eigen::Vector3d(2.5e-3, 2.5e-3, 1e-2).asDiagonal()};
  if (!covariance.is_none()) {
    measured.covariance = read_planar_covariance(covariance, "motion_covariance");
  }
  return measured;
}

// Rows (first, last), each three moderate numbers.
std::optional<ScanMotion> read_twists(const OptionalArray& twists) {
  if (twists.is_none()) {
    return std::nullopt;
  }
  const Batch rows = read(twists, "twists", {2, 3}, false);
  check_magnitude(rows, "twists");
  ScanMotion during;
  for (int k = 0; k < 3; ++k) {
    during.first[k] = rows.data[k];
    during.last[k] = rows.data[3 + k];
  }
  return during;
}

LaserStep add(Track& self, const ArrayLike& ranges, double t, const OptionalArray& motion,
              const OptionalArray& motion_covariance, const OptionalArray& twists) {
  const std::vector<double> read_in = read_ranges(self.odometry.scanner(), ranges, "ranges");
  const std::optional<PlanarEstimate> measured = read_motion(motion, motion_covariance);
  const std::optional<ScanMotion> during = read_twists(twists);
  const py::gil_scoped_release release;
  const std::scoped_lock lock(self.busy);
  LaserStep step = self.odometry.add(read_in, t, measured, during);
  self.poses.push_back(step.pose);
  return step;
}

// Several of one size, as rows.
template <typename Get>
Array rows(std::size_t count, py::ssize_t size, const Get& get) {
  Array out({static_cast<py::ssize_t>(count), size});
  for (std::size_t i = 0; i < count; ++i) {
    const auto& row = get(i);
    for (py::ssize_t k = 0; k < size; ++k) {
      out.mutable_at(static_cast<py::ssize_t>(i), k) = row[k];
    }
  }
  return out;
}

void bind_step(py::module_& m) {
  py::class_<LaserStep>(m, "LaserStep", R"(What one scan said: the motion since the one before.

Examples
--------
>>> import numpy as np
>>> from thing_kin import odometry
>>> lidar = odometry.LaserOdometry(odometry.Scanner(-np.pi / 2, np.pi / 2, 181))
>>> step = lidar.add(1.0 / np.cos(0.9 * lidar.scanner.angles / 2), t=0.0)
>>> step.status, step.keyframe
('first', True)
)")
      .def_property_readonly(
          "status", [](const LaserStep& s) { return status_name(s.status); },
          "'first', 'tracking', 'still' (found, and no motion is seen: the pose "
          "is held) or 'lost' (not found: the pose goes on with the guess).")
      .def_property_readonly(
          "pose", [](const LaserStep& s) { return to_array(s.pose); },
          "(3,), m and rad: of the robot when the scan began; the first one's "
          "is zero.")
      .def_property_readonly(
          "motion", [](const LaserStep& s) { return to_array(s.motion); },
          "(3,), m and rad: the pose as the robot before saw it.")
      .def_property_readonly(
          "covariance", [](const LaserStep& s) { return to_array(s.covariance); },
          "(3, 3): of the motion, in the axes of the robot before.")
      .def_property_readonly(
          "scan_covariance", [](const LaserStep& s) { return to_array(s.scan_covariance); },
          "(3, 3): the same from the scans alone, 1e4 along what they don't tell: to fuse with "
          "the wheels that the guess came from.")
      .def_readonly("t", &LaserStep::t, "s: when the scan began.")
      .def_readonly("t_from", &LaserStep::t_from, "s: when the scan before began.")
      .def_property_readonly(
          "degenerate", [](const LaserStep& s) { return s.match.degenerate > 0; },
          "Whether the scan leaves a direction untold.")
      .def_readonly("keyframe", &LaserStep::keyframe, "Whether the scan went into the map.")
      .def_readonly("match", &LaserStep::match, "How the scan lay in the map, in its axes.")
      .def("__repr__", [](const LaserStep& s) {
        return "<LaserStep " + std::string(status_name(s.status)) + " t=" + text(s.t) + " pose=" +
               std::string(py::repr(py::make_tuple(s.pose.x(), s.pose.y(), s.pose.z()))) + ">";
      });
}

}  // namespace

void bind_laser_odometry(py::module_& m) {
  bind_step(m);
  const LaserOdometryOptions standard;
  py::class_<Track>(m, "LaserOdometry", R"(Follows a robot by its laser scans.

Each scan is matched (see `match`) to a map of what was seen on the last metres of the way. No loop
is closed: what lies further back is forgotten, so that motions stay independent of where the robot
has been before. Hand the scans of keyframes to a SLAM system for that.

Parameters
----------
scanner : Scanner
keyframe_distance, keyframe_angle : float, m and rad
    A scan goes into the map after so much motion.
memory : float, m
    Way after which what was not seen again is forgotten.
radius : float, m
    Around the robot; what is further away is forgotten.
still_distance, still_angle : float, m and rad
    Within both, and within its noise, no motion is seen and the pose is held.
lost_limit : int
    So many scans in a row that are lost begin a new map at the pose that was guessed.
fitness_min, search_below, degenerate_share, max_iterations, max_points
    As those of `match`.

Raises
------
ValueError
    If an option is out of its range.

Examples
--------
>>> import numpy as np
>>> from thing_kin import odometry
>>> scanner = odometry.Scanner(-np.pi / 2, np.pi / 2, 181)
>>> def square(x):  # what a robot sees that looks along x in a square room of 4 m
...     c, s = np.cos(scanner.angles), np.abs(np.sin(scanner.angles))
...     return np.minimum((2 - x) / np.maximum(c, 1e-9), 2 / np.maximum(s, 1e-9))
>>> lidar = odometry.LaserOdometry(scanner)
>>> for k in range(5):
...     step = lidar.add(square(0.05 * k), t=0.1 * k)
>>> step.status, lidar.poses.shape
('tracking', (5, 3))
>>> bool(np.allclose(lidar.poses[-1], [0.2, 0.0, 0.0], atol=5e-3))
True
)")
      .def(py::init([](const Scanner& scanner, double keyframe_distance, double keyframe_angle,
                       double memory, double radius, double still_distance, double still_angle,
                       int lost_limit, double fitness_min, double search_below,
                       double degenerate_share, int max_iterations, int max_points) {
             return std::make_unique<Track>(
                 scanner, LaserOdometryOptions{.keyframe_distance = keyframe_distance,
                                               .keyframe_angle = keyframe_angle,
                                               .memory = memory,
                                               .radius = radius,
                                               .still_distance = still_distance,
                                               .still_angle = still_angle,
                                               .lost_limit = lost_limit,
                                               .match = {.fitness_min = fitness_min,
                                                         .search_below = search_below,
                                                         .degenerate_share = degenerate_share,
                                                         .max_iterations = max_iterations,
                                                         .max_points = max_points}});
           }),
           py::arg("scanner"), py::kw_only(),
           py::arg("keyframe_distance") = standard.keyframe_distance,
           py::arg("keyframe_angle") = standard.keyframe_angle, py::arg("memory") = standard.memory,
           py::arg("radius") = standard.radius, py::arg("still_distance") = standard.still_distance,
           py::arg("still_angle") = standard.still_angle,
           py::arg("lost_limit") = standard.lost_limit,
           py::arg("fitness_min") = standard.match.fitness_min,
           py::arg("search_below") = standard.match.search_below,
           py::arg("degenerate_share") = standard.match.degenerate_share,
           py::arg("max_iterations") = standard.match.max_iterations,
           py::arg("max_points") = standard.match.max_points)
      .def("add", &add, py::arg("ranges"), py::kw_only(), py::arg("t"),
           py::arg("motion") = py::none(), py::arg("motion_covariance") = py::none(),
           py::arg("twists") = py::none(),
           R"(Takes the next scan.

Parameters
----------
ranges : (n,), m
    One for each beam; inf and NaN are no returns.
t : float, s
    When the scan began; later than the one before.
motion : (3,), m and rad, optional
    Pose now as the robot before saw it, as wheels measured it; else velocity is taken as constant.
motion_covariance : (3, 3), optional
    Of `motion`, in the axes of the robot before; default diag(0.05^2, 0.05^2, 0.1^2).
twists : (2, 3), m/s and rad/s, optional
    Of the robot at the first beam and at the last, in its own axes; in between they change evenly.
    Else the mean twist since the scan before is taken to go on, which is wrong for a slow scanner
    (`scan_time`) on a robot that brakes.

Returns
-------
LaserStep

Raises
------
ValueError
    If an array has another shape, `t` is not after the scan before, or a covariance is none. The
    state is as it was.

Examples
--------
>>> import numpy as np
>>> from thing_kin import odometry
>>> lidar = odometry.LaserOdometry(odometry.Scanner(-np.pi / 2, np.pi / 2, 181))
>>> first = lidar.add(1.0 / np.cos(0.9 * lidar.scanner.angles / 2), t=0.0)
>>> blind = lidar.add(np.full(181, np.inf), t=0.1, motion=(0.05, 0.0, 0.0))
>>> blind.status, blind.pose
('lost', array([0.05, 0.  , 0.  ]))
)")
      .def_property_readonly(
          "poses",
          [](const Track& self) {
            const std::vector<Pose2> poses = self.look([&] { return self.poses; });
            return rows(poses.size(), 3, [&](std::size_t i) -> const Pose2& { return poses[i]; });
          },
          "(k, 3), m and rad: of the robot at each scan; the first is zero.")
      .def_property_readonly(
          "pose",
          [](const Track& self) {
            return to_array(self.look([&] { return Pose2(self.odometry.pose()); }));
          },
          "(3,), m and rad: the last.")
      .def_property_readonly(
          "map_points",
          [](const Track& self) {
            const std::vector<Surfel> surfels =
                self.look([&] { return self.odometry.map().surfels(); });
            return rows(surfels.size(), 2,
                        [&](std::size_t i) -> const Eigen::Vector2d& { return surfels[i].p; });
          },
          "(k, 2), m: what is remembered, in the first pose's frame.")
      .def_property_readonly(
          "map_normals",
          [](const Track& self) {
            const std::vector<Surfel> surfels =
                self.look([&] { return self.odometry.map().surfels(); });
            return rows(surfels.size(), 2,
                        [&](std::size_t i) -> const Eigen::Vector2d& { return surfels[i].normal; });
          },
          "(k, 2): unit normals of the remembered surfaces; zero for places that are none.")
      .def_property_readonly(
          "scanner", [](const Track& self) { return self.odometry.scanner(); }, "The scanner.")
      .def("__repr__", [](const Track& self) {
        const std::size_t scans = self.look([&] { return self.poses.size(); });
        return "<LaserOdometry of " + std::to_string(scans) + " scans>";
      });
}

}  // namespace thing_kin::python
