#pragma once

#include <memory>

#include "array.hpp"
#include "thing_kin/optimization/problem.hpp"
#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::python {

/// A robot as terms keep it; null for None.
std::shared_ptr<const Chain> read_robot(const py::object& robot);

/// numpy's ndim; -1 for what it takes for no array.
int dimensions_of(const py::object& array);

/// A problem that Python's user fills.
using PyProblem = py::class_<Problem, std::shared_ptr<Problem>>;

}  // namespace thing_kin::python
