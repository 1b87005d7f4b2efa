#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "calibration_arguments.hpp"
#include "calibration_bindings.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin::python {

Array pose_to_array(const SE3& T) {
  const py::ssize_t shape[] = {4, 4};
  Array array = make_array(shape, 2);
  write_pose(T, array.mutable_data());
  return array;
}

}  // namespace thing_kin::python

PYBIND11_MODULE(_calibration, m) {
  using namespace thing_kin;
  using namespace thing_kin::python;
  py::module_::import("thing_kin._core");  // brings the type of the chain
  m.doc() = "Calibration. Private: use thing_kin.estimation.calibrate.";
  bind_calibration(m);
  bind_calibration_problem(m);
  m.def("numbers", &read_numbers, py::arg("argument"), py::arg("name"), py::arg("item"),
        py::arg("several"), py::arg("is_covariance"),
        "The argument as float64, of shape `item` or, if `several`, (N, *item); else ValueError.");
  m.def(
      "joint_origins",
      [](const Chain& chain) {
        const py::ssize_t shape[] = {chain.dof(), 4, 4};
        Array origins = make_array(shape, 3);
        for (int i = 0; i < chain.dof(); ++i) {
          write_pose(chain.joints()[static_cast<std::size_t>(i)].fixed,
                     origins.mutable_data() + 16 * i);
        }
        return py::make_tuple(origins, pose_to_array(chain.frames().back().offset));
      },
      py::arg("chain"),
      "Of each joint in the one before, (n, 4, 4), and the last frame in the last joint.");
}
