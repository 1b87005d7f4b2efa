#include "thing_kin/odometry/scan_matching.hpp"

#include <optional>

#include "odometry/scan.hpp"
#include "odometry/scan_matching.hpp"
#include "odometry_bindings.hpp"

namespace thing_kin::python {

namespace {

constexpr double kDefaultDeviation = 0.5;      // m
constexpr double kDefaultTurnDeviation = 0.8;  // rad

Eigen::Matrix3d default_covariance() {
  const double move = kDefaultDeviation * kDefaultDeviation;
  return Eigen::Vector3d(move, move, kDefaultTurnDeviation * kDefaultTurnDeviation).asDiagonal();
}

ScanMatch match(const Scanner& scanner, const ArrayLike& ranges_a, const ArrayLike& ranges_b,
                const ArrayLike& guess, const OptionalArray& guess_covariance,
                const MatchOptions& options) {
  const std::vector<double> first = read_ranges(scanner, ranges_a, "ranges_a");
  const std::vector<double> second = read_ranges(scanner, ranges_b, "ranges_b");
  MatchGuess start{.pose = read_planar(guess, "guess"), .covariance = default_covariance()};
  if (!guess_covariance.is_none()) {
    start.covariance = read_planar_covariance(guess_covariance, "guess_covariance");
  }
  check_match_options(options);
  const py::gil_scoped_release release;
  // Kept from call to call: their memory would cost more than the match.
  thread_local PlanarScan scan;
  thread_local LocalMap map;
  read_scan(scanner, first, Twist2::Zero(), scan);
  map.clear();
  map.insert(scan, Pose2::Zero(), 0.0);
  read_scan(scanner, second, Twist2::Zero(), scan);
  return match_scan(map, scan, start, {}, scanner.noise, options);
}

}  // namespace

const char* status_name(MatchStatus status) {
  switch (status) {
    case MatchStatus::kConverged:
      return "converged";
    case MatchStatus::kIterationLimit:
      return "iteration_limit";
    case MatchStatus::kPoorFit:
      return "poor_fit";
    case MatchStatus::kTooFewPoints:
      break;
  }
  return "too_few_points";
}

void bind_scan_matching(py::module_& m) {
  const MatchOptions standard;
  py::class_<ScanMatch>(m, "ScanMatch", R"(How one scan lies to another, or in a map.

The pose to go by where `status` is "converged" (or, nearly, "iteration_limit"); with "poor_fit"
and "too_few_points" it is the guess, and the covariance the guess's.

Examples
--------
>>> import numpy as np
>>> from thing_kin import odometry
>>> scanner = odometry.Scanner(-np.pi / 2, np.pi / 2, 181)
>>> nothing = np.full(181, np.inf)
>>> match = odometry.match(scanner, nothing, nothing, guess=(0.1, 0.0, 0.0))
>>> match.status, match.degenerate, match.pose
('too_few_points', True, array([0.1, 0. , 0. ]))
)")
      .def_property_readonly(
          "pose", [](const ScanMatch& s) { return to_array(s.pose); },
          "(3,), m and rad: of the second scan's robot in the first's frame.")
      .def_property_readonly(
          "covariance", [](const ScanMatch& s) { return to_array(s.covariance); },
          "(3, 3): of the pose, (x, y, theta) in the first's axes. Along what "
          "the scans don't tell it is the guess's.")
      .def_property_readonly(
          "scan_covariance", [](const ScanMatch& s) { return to_array(s.scan_covariance); },
          "(3, 3): the same from the scans alone: variances of 1e4 along what they don't tell. To "
          "fuse with what the guess came from.")
      .def_property_readonly(
          "status", [](const ScanMatch& s) { return status_name(s.status); },
          "'converged', 'iteration_limit', 'poor_fit' or 'too_few_points'.")
      .def_property_readonly(
          "degenerate", [](const ScanMatch& s) { return s.degenerate > 0; },
          "Whether the scans leave a direction untold: a corridor, one wall, a "
          "round room.")
      .def_property_readonly(
          "directions",
          [](const ScanMatch& s) {
            return to_array(s.untold.leftCols(s.degenerate).transpose().eval());
          },
          "(k, 3): directions that the scans don't tell, (x, y, theta) in the first's axes; theta "
          "in units in which the mean point moves by a metre.")
      .def_readonly("fitness", &ScanMatch::fitness,
                    "0 to 1: how well the points agree with the map, on the mean.")
      .def_readonly("inliers", &ScanMatch::inliers, "Share of the points within 0.1 m of the map.")
      .def_readonly("residual", &ScanMatch::residual,
                    "m: root mean square distance of the inliers from the map.")
      .def_readonly("points", &ScanMatch::points, "How many points were matched.")
      .def_readonly("iterations", &ScanMatch::iterations, "Steps, over all starts.")
      .def_readonly("searched", &ScanMatch::searched,
                    "Whether the fit from the guess was poor and the correlative search was asked.")
      .def_readonly(
          "ambiguous", &ScanMatch::ambiguous,
          "Whether another pose fits nearly as well: the covariance spans both. People who "
          "walk may make a wrong fit the better one.")
      .def("__repr__", [](const ScanMatch& s) {
        return "<ScanMatch " + std::string(status_name(s.status)) +
               (s.degenerate > 0 ? " degenerate" : "") + (s.ambiguous ? " ambiguous" : "") +
               " pose=" +
               std::string(py::repr(py::make_tuple(s.pose.x(), s.pose.y(), s.pose.z()))) + ">";
      });

  m.def(
      "match",
      [](const Scanner& scanner, const ArrayLike& ranges_a, const ArrayLike& ranges_b,
         const ArrayLike& guess, const OptionalArray& guess_covariance, double fitness_min,
         double search_below, double degenerate_share, int max_iterations, int max_points) {
        return match(scanner, ranges_a, ranges_b, guess, guess_covariance,
                     {.fitness_min = fitness_min,
                      .search_below = search_below,
                      .degenerate_share = degenerate_share,
                      .max_iterations = max_iterations,
                      .max_points = max_points});
      },
      py::arg("scanner"), py::arg("ranges_a"), py::arg("ranges_b"),
      py::arg("guess") = py::make_tuple(0, 0, 0), py::kw_only(),
      py::arg("guess_covariance") = py::none(), py::arg("fitness_min") = standard.fitness_min,
      py::arg("search_below") = standard.search_below,
      py::arg("degenerate_share") = standard.degenerate_share,
      py::arg("max_iterations") = standard.max_iterations,
      py::arg("max_points") = standard.max_points,
      R"(The motion between two scans: where the robot of the second was, seen from the first's.

Point to line (Censi 2008) under a robust loss; where the fit from the guess is poor a correlative
search (Olson 2009) looks through the window that `guess_covariance` spans. Along directions that
the scans don't tell (a corridor's) the pose stays as guessed, and the covariance says so.

Parameters
----------
scanner : Scanner
ranges_a, ranges_b : (n,), m
    One range for each beam; inf and NaN are no returns.
guess : (3,), m and rad
    Pose of b in a, from wheels or a constant velocity.
guess_covariance : (3, 3), optional
    Of the guess, axes of a; default diag(0.5^2, 0.5^2, 0.8^2). Three deviations are searched.
fitness_min : float
    Below this fitness (0 to 1) a match is a "poor_fit".
search_below : float
    Below this fitness the correlative search is asked; 0 never asks it, 1 always.
degenerate_share : float
    A direction that less than this share of the points tells is taken as untold.
max_iterations : int
    For each start.
max_points : int
    A scan of more points is thinned evenly.

Returns
-------
ScanMatch

Raises
------
ValueError
    If an array has another shape, a covariance is none, or an option is out of its range.

Examples
--------
>>> import numpy as np
>>> from thing_kin import odometry
>>> scanner = odometry.Scanner(-np.pi / 2, np.pi / 2, 181)
>>> def square(x):  # what a robot sees that looks along x in a square room of 4 m
...     c, s = np.cos(scanner.angles), np.abs(np.sin(scanner.angles))
...     return np.minimum((2 - x) / np.maximum(c, 1e-9), 2 / np.maximum(s, 1e-9))
>>> match = odometry.match(scanner, square(0.0), square(0.3))
>>> match.status, match.degenerate
('converged', False)
>>> bool(np.allclose(match.pose, [0.3, 0.0, 0.0], atol=2e-3))
True
)");
}

}  // namespace thing_kin::python
