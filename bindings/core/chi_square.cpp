#include "thing_kin/core/chi_square.hpp"

#include "estimation_bindings.hpp"
#include "map.hpp"

namespace thing_kin::python {

void bind_chi_square(py::module_& m) {
  m.def(
      "chi_square_quantile",
      [](const ArrayLike& probability, int dof) {
        const Batch batch = read(probability, "probability", {});
        return map_scalar(batch, [dof](const double* p) { return chi_square_quantile(*p, dof); });
      },
      py::arg("probability"), py::arg("dof"),
      R"(What a chi-square variable stays below with a probability.

A gate of 0.99 on a measurement of two numbers is chi_square_quantile(0.99, 2) of its NIS.

Parameters
----------
probability : float, or (N,)
    From 0 to 1.
dof : int
    Degrees of freedom, 1 to 10^6.

Returns
-------
float, or (N,)
    Relative error about 1e-14; inf for 1.

Raises
------
ValueError
    If an argument is out of range.

Examples
--------
>>> from thing_kin import estimation as est
>>> round(est.chi_square_quantile(0.95, 3), 12)
7.814727903251
)");
}

}  // namespace thing_kin::python
