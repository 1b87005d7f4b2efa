#include "thing_kin/search/compensation.hpp"

#include "search_arguments.hpp"
#include "search_bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

std::vector<double> read_times(const ArrayLike& dwell, std::size_t count) {
  const auto n = static_cast<py::ssize_t>(count);
  const Batch times = read(dwell, "dwell", {});
  if (times.single) {
    std::vector<double> each(count);
    for (std::size_t k = 0; k < count; ++k) {
      each[k] = times.data[0] * static_cast<double>(k);
    }
    return each;
  }
  if (times.count != n) {
    throw InvalidArgument("dwell", "shape " + shape_text(&times.count, 1),
                          "a number or shape " + shape_text(&n, 1));
  }
  return {times.data, times.data + count};
}

}  // namespace

void bind_compensation(py::module_& m) {
  m.def(
      "compensate",
      [](const ArrayLike& points, const ArrayLike& velocity, const ArrayLike& dwell) {
        const SearchPoints from = read_points(points, "points", 0);
        return points_array(compensated_points(from, read_point(velocity, "velocity"),
                                               read_times(dwell, from.size())));
      },
      py::arg("points"), py::arg("velocity"), py::arg("dwell"),
      R"(Points for a base that goes on while it searches, [X21] (2.2).

`points[k] + velocity * t[k]`, with the time since the first point was meant; the thesis prints the
time since the point before.

Parameters
----------
points : (n, 2), m
velocity : (2,), m/s
dwell : float or (n,), s
    Time from each point to the next, or the time of each point.

Returns
-------
(n, 2), m

Raises
------
ValueError
    If an array has another shape or is not finite.

Examples
--------
>>> from thing_kin import search
>>> search.compensate([[0.0, 0.0], [0.0, 0.0]], velocity=(0.02, 0.0), dwell=0.5)
array([[0.  , 0.  ],
       [0.01, 0.  ]])
)");
}

}  // namespace thing_kin::python
