#include "thing_kin/search/spiral.hpp"

#include <optional>

#include <pybind11/stl.h>

#include "search_arguments.hpp"
#include "search_bindings.hpp"

namespace thing_kin::python {

void bind_spiral(py::module_& m) {
  m.def(
      "spiral",
      [](const ArrayLike& center, double gap, std::optional<double> spacing,
         std::optional<double> radius, const py::object& count) {
        const SpiralOptions standard;
        return points_array(spiral_points(read_point(center, "center"),
                                          {.gap = gap,
                                           .spacing = spacing.value_or(gap),
                                           .radius = radius.value_or(standard.radius),
                                           .count = read_count(count, "count", standard.count)}));
      },
      py::arg("center"), py::arg("gap"), py::arg("spacing") = py::none(),
      py::arg("radius") = py::none(), py::arg("count") = py::none(),
      R"(Evenly spaced points on an Archimedean spiral, [X21] 2.2.

Parameters
----------
center : (2,), m
    The first point.
gap : float
    m between neighbouring turns.
spacing : float, optional
    m along the spiral from point to point; default `gap`.
radius : float, optional
    m from the center: points beyond are dropped.
count : int, optional
    At most so many points. One of `radius` and `count` is needed.

Returns
-------
(n, 2), m
    The center, then counter-clockwise outwards.

Raises
------
ValueError
    If a length is not positive, or neither `radius` nor `count` ends the spiral.

Examples
--------
>>> from thing_kin import search
>>> search.spiral((0.0, 0.0), gap=0.006, count=3).round(4)
array([[ 0.    ,  0.    ],
       [ 0.0044, -0.0032],
       [ 0.0058,  0.0029]])
)");
}

}  // namespace thing_kin::python
