#include "thing_kin/optimization/ceres_minimizer.hpp"

#include <memory>
#include <string>

#include <pybind11/pybind11.h>

PYBIND11_MODULE(_ceres, m) {
  using namespace thing_kin;
  namespace py = pybind11;
  py::module_::import("thing_kin._core");  // brings the type of the minimizer
  m.doc() = "The minimizers that use Ceres. Private: use thing_kin.sqp.";
  m.def(
      "minimizer",
      [](const std::string& name) {
        return std::shared_ptr<ConvexMinimizer>(
            make_ceres_minimizer(ceres_method_from_string(name)));
      },
      py::arg("name"), "See thing_kin.sqp.");
}
