#include "thing_kin/search/stochastic.hpp"

#include "search_arguments.hpp"
#include "search_bindings.hpp"

namespace thing_kin::python {

void bind_stochastic(py::module_& m) {
  m.def(
      "stochastic",
      [](const ArrayLike& center, const ArrayLike& covariance, double sample_gap,
         const py::object& count, const py::object& keep, const Randomness& rng) {
        const StochasticOptions standard;
        const Batch matrix = read(covariance, "covariance", {2, 2}, false);
        const Eigen::Vector2d middle = read_point(center, "center");
        RandomStream random(read_seed(rng));
        return points_array(stochastic_points(middle, Eigen::Matrix2d(matrix_at(matrix, 0, 2, 2)),
                                              {.sample_gap = sample_gap,
                                               .count = read_count(count, "count", standard.count),
                                               .keep = read_count(keep, "keep", standard.keep)},
                                              random));
      },
      py::arg("center"), py::arg("covariance"), py::arg("sample_gap"), py::arg("count") = 200,
      py::arg("keep") = 50, py::arg("rng") = py::none(),
      R"(Draws from a normal distribution on a grid, the most probable first, [X21] (2.1).

Parameters
----------
center : (2,), m
    The mean.
covariance : (2, 2), m^2
    It may be singular.
sample_gap : float
    m: pitch of the grid, which lies along the axes about the center.
count : int
    Draws.
keep : int
    Points at most.
rng : int or numpy.random.Generator, optional
    Where the draws come from; None for others each time.

Returns
-------
(n, 2), m
    Each cell that was drawn once, by falling density (ties by x, then y). The center is always the
    first.

Raises
------
ValueError
    If an argument has another shape or is out of its range.

Examples
--------
>>> import numpy as np
>>> from thing_kin import search
>>> points = search.stochastic((1.0, 2.0), np.diag([4e-6, 1e-6]), sample_gap=5e-4, keep=5, rng=0)
>>> points.shape, points[0]
((5, 2), array([1., 2.]))
)");
}

}  // namespace thing_kin::python
