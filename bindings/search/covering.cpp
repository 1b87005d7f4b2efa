#include "thing_kin/search/covering.hpp"

#include <cmath>
#include <optional>

#include <pybind11/stl.h>

#include "search_arguments.hpp"
#include "search_bindings.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin::python {

namespace {

Array times_array(const std::vector<double>& values) {
  return to_array(
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

double in_range(double value, const char* name, double least, bool open) {
  if (!(value > least || (!open && value == least))) {
    throw InvalidArgument(name, text(value),
                          std::string(open ? "a number > " : "a number >= ").append(text(least)));
  }
  return value;
}

PlanarNormal read_belief(const ArrayLike& center, const ArrayLike& covariance) {
  PlanarNormal belief;
  belief.mean = read_point(center, "center");
  const Batch matrix = read(covariance, "covariance", {2, 2}, false);
  belief.covariance = matrix_at(matrix, 0, 2, 2);
  check_covariance(belief.covariance, 2, "covariance");
  return belief;
}

CoveringPlan plan(const ArrayLike& center, const ArrayLike& covariance, double radius,
                  double stop_time, double speed, std::optional<double> extent,
                  const OptionalArray& within, const OptionalArray& reach_center,
                  std::optional<double> reach_radius, const ArrayLike& velocity,
                  std::optional<double> deadline, double least_rate, const py::object& count) {
  const PlanarNormal belief = read_belief(center, covariance);
  const double deviation = std::sqrt(belief.covariance.diagonal().maxCoeff());
  const Sight sight{.radius = in_range(radius, "radius", 0.0, true)};
  const StopTime time{.stop = in_range(stop_time, "stop_time", 0.0, true),
                      .per_metre = 1.0 / in_range(speed, "speed", 0.0, true)};
  constexpr double kDeviations = 5.0;
  const double most =
      extent ? in_range(*extent, "extent", 0.0, true) : kDeviations * deviation + 2.0 * radius;
  for (const auto& [value, name] : {std::pair{radius, "radius"}, std::pair{most, "extent"}}) {
    if (!std::isfinite(value)) {
      throw InvalidArgument(name, text(value), "a finite number of metres");
    }
  }
  constexpr double kMostRadii = 500.0;
  if (most > kMostRadii * radius) {
    throw InvalidArgument("extent", text(most), "at most 500 times the radius");
  }
  CoveringWindow window;
  if (!within.is_none()) {
    window.within = read_points(within, "within", 3);
  }
  window.reach_center =
      reach_center.is_none() ? belief.mean : read_point(reach_center, "reach_center");
  window.reach_radius =
      reach_radius ? in_range(*reach_radius, "reach_radius", 0.0, true) : CoveringWindow::kNoEnd;
  window.velocity = read_point(velocity, "velocity");
  window.deadline = deadline ? in_range(*deadline, "deadline", 0.0, false) : CoveringWindow::kNoEnd;
  in_range(least_rate, "least_rate", 0.0, true);
  const std::size_t stops = read_count(count, "count", kMostSearchPoints);
  const py::gil_scoped_release release;
  return plan_covering(std::array{belief}, sight, time, most, window, least_rate, stops);
}

}  // namespace

void bind_covering(py::module_& m) {
  py::class_<CoveringPlan>(m, "CoveringPlan",
                           R"(A search in advance, as it goes while nothing is found.

Examples
--------
>>> import numpy as np
>>> from thing_kin import search
>>> plan = search.covering((0.0, 0.0), 1e-4 * np.eye(2), radius=0.006)
>>> bool(plan.found[-1] > 0.99)
True
)")
      .def_property_readonly(
          "points", [](const CoveringPlan& plan) { return points_array(plan.points); },
          "(n, 2), m: stops, in their order.")
      .def_property_readonly(
          "times", [](const CoveringPlan& plan) { return times_array(plan.times); },
          "(n,), s: of the stops; the first is at 0.")
      .def_property_readonly(
          "found", [](const CoveringPlan& plan) { return times_array(plan.found); },
          "(n,): probability that it has been seen by then.")
      .def("__len__", [](const CoveringPlan& plan) { return plan.points.size(); })
      .def("__repr__", [](const CoveringPlan& plan) {
        const bool empty = plan.points.empty();
        return "<CoveringPlan of " + std::to_string(plan.points.size()) + " stops, " +
               text(empty ? 0.0 : plan.times.back()) + " s, finds " +
               text(empty ? 0.0 : plan.found.back()) + ">";
      });

  m.def("covering", &plan, py::arg("center"), py::arg("covariance"), py::arg("radius"),
        py::kw_only(), py::arg("stop_time") = 0.16, py::arg("speed") = 0.18,
        py::arg("extent") = py::none(), py::arg("within") = py::none(),
        py::arg("reach_center") = py::none(), py::arg("reach_radius") = py::none(),
        py::arg("velocity") = py::make_tuple(0.0, 0.0), py::arg("deadline") = py::none(),
        py::arg("least_rate") = 1e-4, py::arg("count") = py::none(),
        R"(Stops that cover the plane, those first that find most probability per second.

A hexagonal lattice of discs, and the points between them for a second look. Each stop lowers what
is believed of where it looked: surely within 0.8 of the radius, less out to 1.1, and never wholly.

Parameters
----------
center : (2,), m
covariance : (2, 2), m^2
    What is believed of where it is.
radius : float
    m: how far a stop sees. Better too small than too large.
stop_time, speed : float
    s for each stop, and m/s between stops.
extent : float, optional
    m from the center: nothing is looked for beyond; default 5 deviations and 2 radii.
within : (k, 2), m, optional
    A polygon: stops lie in it.
reach_center : (2,), m, optional
reach_radius : float, optional
    m: stops lie within it of `reach_center + velocity * time`; default everywhere.
velocity : (2,), m/s
    Of what carries the arm.
deadline : float, optional
    s: no stop is later.
least_rate : float
    1/s: the search ends where the best stop finds less per second.
count : int, optional
    Stops at most.

Returns
-------
CoveringPlan

Raises
------
ValueError
    If an argument has another shape or is out of its range.

Examples
--------
>>> import numpy as np
>>> from thing_kin import search
>>> plan = search.covering((0.0, 0.0), np.diag([4e-4, 1e-4]), radius=0.012, deadline=5.0)
>>> bool(plan.times[-1] <= 5.0), bool(np.all(np.diff(plan.found) >= 0))
(True, True)
)");
}

}  // namespace thing_kin::python
