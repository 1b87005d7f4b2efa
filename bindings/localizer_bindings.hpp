#pragma once

// What the localizer's bindings share.

#include <string>

#include "array.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/estimation/base_localizer.hpp"

namespace thing_kin::python {

Eigen::Vector3d read_triple(const ArrayLike& argument, const char* name);
Eigen::Matrix3d read_triple_matrix(py::handle argument, const char* name);

/// A message begins with the argument; it also names the source.
template <typename Work>
auto naming(const std::string& source, const Work& work) {
  try {
    return work();
  } catch (const InvalidArgument& error) {
    throw py::value_error(std::string(error.what()) + " (source " + quoted(source) + ")");
  }
}

/// The methods that take measurements, and estimate().
void bind_localizer_measurements(py::class_<BaseLocalizer>& localizer);

/// BaseEstimate and NisStatistics.
void bind_localizer_results(py::module_& m);

}  // namespace thing_kin::python
