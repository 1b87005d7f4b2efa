#pragma once

#include <string>

#include <pybind11/numpy.h>

#include "thing_kin/inverse/ik_result.hpp"

namespace thing_kin::python {

namespace py = pybind11;

/// A result as Python sees it, with the chain (a Python Chain) that its message speaks of.
struct ExplainedIk {
  IkResult result;
  py::object chain;

  std::string message() const { return thing_kin::message(chain.cast<const Chain&>(), result); }
};

/// The same for many targets: a row a target.
struct ExplainedIkBatch {
  ExplainedIkBatch(py::object of, py::ssize_t targets);

  ExplainedIk at(py::ssize_t i) const;

  py::object chain;
  py::ssize_t count;
  py::array_t<double> q;
  py::array_t<std::uint8_t> status;
  py::array_t<double> position_error, rotation_error;
  py::array_t<std::int8_t> active_limits;
  py::array_t<std::int32_t> iterations, restarts;
  py::array_t<double> time;
};

}  // namespace thing_kin::python
