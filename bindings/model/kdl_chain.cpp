#include "thing_kin/model/kdl_chain.hpp"

#include <mutex>

#include "inverse/kdl_ik.hpp"
#include "map.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

// KDL's solvers keep their state: a lock makes one object safe for several threads.
class LockedKdlChain {
 public:
  explicit LockedKdlChain(const Chain& chain) : chain_(chain), kdl_(chain) {}

  Array fk(const ArrayLike& q, const std::string& frame) {
    const int index = frame.empty() ? chain_.tool() : chain_.frame_index(frame);
    const Batch batch = read_vectors(q, "q", kdl_.dof());
    return map(batch, {4, 4}, [&](const double* in, double* out) {
      const std::scoped_lock lock(mutex_);
      write_pose(kdl_.fk(Eigen::Map<const Eigen::VectorXd>(in, kdl_.dof()), index), out);
    });
  }

  Array jacobian(const ArrayLike& q) {
    const Batch batch = read_vectors(q, "q", kdl_.dof());
    return map(batch, {6, kdl_.dof()}, [&](const double* in, double* out) {
      const std::scoped_lock lock(mutex_);
      write_matrix(kdl_.jacobian(Eigen::Map<const Eigen::VectorXd>(in, kdl_.dof())), out);
    });
  }

 private:
  Chain chain_;
  KdlChain kdl_;
  std::mutex mutex_;
};

}  // namespace

}  // namespace thing_kin::python

PYBIND11_MODULE(_kdl, m) {
  using namespace thing_kin::python;
  py::module_::import("thing_kin._core");  // brings the type of Chain
  m.doc() = "The KDL back end. Private: use thing_kin.kdl.";
  py::class_<LockedKdlChain>(m, "KdlChain",
                             R"(A chain as KDL sees it, computed by KDL's own solvers.

For users who come from KDL, and as an independent check. Conventions are thing_kin's.

Parameters
----------
chain : Chain

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> from thing_kin.kdl import KdlChain
>>> robot = tk.robots.thing()
>>> q = robot.random(rng=0)
>>> np.allclose(KdlChain(robot).fk(q), robot.fk(q))
True
)")
      .def(py::init<const thing_kin::Chain&>(), py::arg("chain"))
      .def("fk", &LockedKdlChain::fk, py::arg("q"), py::arg("frame") = "",
           R"(Pose of a frame by ChainFkSolverPos_recursive.

Parameters
----------
q : (n,) or (N, n), rad and m
frame : str
    Default: the last, the tool.

Returns
-------
(4, 4) or (N, 4, 4)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> from thing_kin.kdl import KdlChain
>>> KdlChain(tk.robots.ur5()).fk(np.zeros(6)).shape
(4, 4)
)")
      .def("jacobian", &LockedKdlChain::jacobian, py::arg("q"),
           R"(Jacobian of the tool by ChainJntToJacSolver, axes of the world, [linear; angular].

Parameters
----------
q : (n,) or (N, n), rad and m

Returns
-------
(6, n) or (N, 6, n)

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> from thing_kin.kdl import KdlChain
>>> KdlChain(tk.robots.ur5()).jacobian(np.zeros(6)).shape
(6, 6)
)");
  bind_kdl_ik(m);
}
