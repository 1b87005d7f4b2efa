#include "thing_kin/kinematics/manipulability.hpp"

#include "bindings.hpp"
#include "map.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

Dexterity dexterity_at(const Chain& chain, const double* q, int frame, Posture& posture) {
  place_joints(chain, q, posture);
  return {chain, posture, frame};
}

template <typename Measure>
FloatOrArray measure(const Chain& c, const ArrayLike& q, const FrameLike& of, const Run& run,
                     Measure of_dexterity) {
  const int frame = read_frame(c, of, "of");
  return map_scalar(read_vectors(q, "q", c.dof()), run, [&](const double* in) {
    Posture posture;
    return of_dexterity(dexterity_at(c, in, frame, posture));
  });
}

template <typename Gradient>
Array gradient(const Chain& c, const ArrayLike& q, const FrameLike& of, const Run& run,
               bool anywhere, Gradient of_dexterity) {
  const int frame = read_frame(c, of, "of");
  const Batch batch = read_vectors(q, "q", c.dof());
  const auto compute = [&](const double* in, double* out) {
    Posture posture;
    const Dexterity dexterity = dexterity_at(c, in, frame, posture);
    if (!anywhere && !dexterity.has_gradient()) {
      throw InvalidArgument("q", "a posture with a zero or repeated extreme singular value",
                            "one where the condition number can be differentiated");
    }
    Hessian H;
    geometric_hessian(c, posture, frame, ReferenceFrame::kWorldAligned, H);
    Eigen::Map<Eigen::VectorXd>(out, c.dof()) = of_dexterity(dexterity, H);
  };
  return map(batch, {c.dof()}, run, compute, kCostlyRowsPerThread);
}

}  // namespace

void bind_manipulability(ChainClass& chain) {
  chain.def(
      "manipulability",
      [](const Chain& c, const ArrayLike& q, const FrameLike& of, const OutArray& out,
         const ThreadCount& threads) {
        return measure(c, q, of, {out, threads},
                       [](const Dexterity& d) { return d.manipulability(); });
      },
      py::arg("q"), py::arg("of") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Manipulability M = sqrt(det(J J^T)), [M17] (4.30).

Parameters
----------
q : (n,) or (N, n), rad and m
of : str or int, optional
    The frame that moves; default: the tool.
out : () or (N,) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
float or (N,)
    0 with fewer than six joints or a lost rank.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = robot.random(rng=0)
>>> J = robot.jacobian(q)
>>> bool(np.isclose(robot.manipulability(q), np.sqrt(np.linalg.det(J @ J.T))))
True
)");
  chain.def(
      "manipulability_gradient",
      [](const Chain& c, const ArrayLike& q, const FrameLike& of, const OutArray& out,
         const ThreadCount& threads) {
        return gradient(c, q, of, {out, threads}, true, [](const Dexterity& d, const Hessian& H) {
          return d.manipulability_gradient(H);
        });
      },
      py::arg("q"), py::arg("of") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Gradient of the manipulability, [M17] (4.31): (M/2) tr((J J^T)^-1 d(J J^T)/dq).

Parameters
----------
q : (n,) or (N, n), rad and m
of : str or int, optional
    The frame that moves; default: the tool.
out : (n,) or (N, n) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(n,) or (N, n)
    Zero with fewer than six joints or a lost rank.

Examples
--------
>>> import thing_kin as tk
>>> tk.robots.thing().manipulability_gradient([0, -1, 1, 0, 1, 0, 0, 0, 0]).shape
(9,)
)");
  chain.def(
      "condition_number",
      [](const Chain& c, const ArrayLike& q, const FrameLike& of, const OutArray& out,
         const ThreadCount& threads) {
        return measure(c, q, of, {out, threads},
                       [](const Dexterity& d) { return d.condition_number(); });
      },
      py::arg("q"), py::arg("of") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(Condition number kappa = sigma_max/sigma_min of the Jacobian, [M17] (4.32).

Parameters
----------
q : (n,) or (N, n), rad and m
of : str or int, optional
    The frame that moves; default: the tool.
out : () or (N,) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
float or (N,)
    inf with fewer than six joints or a lost rank.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = robot.random(rng=0)
>>> bool(np.isclose(robot.condition_number(q), np.linalg.cond(robot.jacobian(q))))
True
)");
  chain.def(
      "condition_number_gradient",
      [](const Chain& c, const ArrayLike& q, const FrameLike& of, const OutArray& out,
         const ThreadCount& threads) {
        return gradient(c, q, of, {out, threads}, false, [](const Dexterity& d, const Hessian& H) {
          return d.condition_number_gradient(H);
        });
      },
      py::arg("q"), py::arg("of") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(), R"(Gradient of the condition number (4.32).

Parameters
----------
q : (n,) or (N, n), rad and m
of : str or int, optional
    The frame that moves; default: the tool.
out : (n,) or (N, n) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(n,) or (N, n)

Raises
------
ValueError
    Where the largest or smallest singular value is repeated or zero: no gradient exists there.
    What `out` holds is undefined then.

Examples
--------
>>> import thing_kin as tk
>>> tk.robots.thing().condition_number_gradient([0, -1, 1, 0, 1, 0, 0, 0, 0]).shape
(9,)
)");
  chain.def(
      "dexterity",
      [](const Chain& c, const ArrayLike& q, const FrameLike& of, const OutArray& out,
         const ThreadCount& threads) {
        return measure(c, q, of, {out, threads}, [](const Dexterity& d) { return d.dexterity(); });
      },
      py::arg("q"), py::arg("of") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(),
      R"(The combined measure sqrt(kappa/M), [M17] (4.33): small is good.

Parameters
----------
q : (n,) or (N, n), rad and m
of : str or int, optional
    The frame that moves; default: the tool.
out : () or (N,) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
float or (N,)
    inf with fewer than six joints or a lost rank.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> q = robot.random(rng=0)
>>> f = np.sqrt(robot.condition_number(q) / robot.manipulability(q))
>>> bool(np.isclose(robot.dexterity(q), f))
True
)");
  chain.def(
      "dexterity_gradient",
      [](const Chain& c, const ArrayLike& q, const FrameLike& of, const OutArray& out,
         const ThreadCount& threads) {
        return gradient(c, q, of, {out, threads}, false, [](const Dexterity& d, const Hessian& H) {
          return d.dexterity_gradient(H);
        });
      },
      py::arg("q"), py::arg("of") = py::none(), py::kw_only(), py::arg("out") = py::none(),
      py::arg("threads") = py::none(), R"(Gradient of sqrt(kappa/M), [M17] (4.33).

Parameters
----------
q : (n,) or (N, n), rad and m
of : str or int, optional
    The frame that moves; default: the tool.
out : (n,) or (N, n) float64 array in C order, optional
    Where the result goes, and what is returned then.
threads : int, optional
    At most so many; default: one, and for large batches all processors. The result is the same.

Returns
-------
(n,) or (N, n)

Raises
------
ValueError
    Where the largest or smallest singular value is repeated or zero: no gradient exists there.
    What `out` holds is undefined then.

Examples
--------
>>> import thing_kin as tk
>>> tk.robots.thing().dexterity_gradient([0, -1, 1, 0, 1, 0, 0, 0, 0]).shape
(9,)
)");
}

}  // namespace thing_kin::python
