#include "thing_kin/model/joint_difference.hpp"

#include "array.hpp"
#include "bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

Array difference(const Chain& chain, const ArrayLike& q_from, const ArrayLike& q_to) {
  const Batch from = read_vectors(q_from, "q_from", chain.dof());
  const Batch to = read_vectors(q_to, "q_to", chain.dof());
  if (!from.single && !to.single && from.count != to.count) {
    throw InvalidArgument("q_to", std::to_string(to.count) + " configurations",
                          "as many as q_from has, " + std::to_string(from.count) + ", or one");
  }
  check_magnitude(from, "q_from");
  check_magnitude(to, "q_to");
  const Batch& longer = from.single ? to : from;
  Array out = make_array(longer, {chain.dof()});
  double* result = out.mutable_data();
  const py::gil_scoped_release release;
  for (py::ssize_t i = 0; i < longer.count; ++i) {
    joint_difference(chain, from.item(from.single ? 0 : i), to.item(to.single ? 0 : i),
                     result + i * chain.dof());
  }
  return out;
}

}  // namespace

void bind_joint_difference(ChainClass& chain) {
  chain.def("difference", &difference, py::arg("q_from"), py::arg("q_to"),
            R"(The way from one configuration to another: q_to - q_from, the shorter way round.

The difference of a continuous joint, for which q and q + 2 pi are the same place, is in [-pi, pi),
exact to rounding after thousands of turns too. Other joints have limits, and cannot take the other
way round: theirs is the plain difference. Where both are batches, row by row.

Parameters
----------
q_from, q_to : (n,) or (N, n), rad and m

Returns
-------
(n,) or (N, n)

Raises
------
ValueError
    If a shape is wrong, the batches' lengths differ, or an entry is not finite.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_dh([tk.DH(joint="continuous"), tk.DH(a=1.0, joint="revolute")])
>>> arm.difference([3.0, 3.0], [-3.0, -3.0]).round(4)
array([ 0.2832, -6.    ])
)");
}

}  // namespace thing_kin::python
