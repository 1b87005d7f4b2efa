#pragma once

#include <memory>

#include "search_arguments.hpp"
#include "thing_kin/rmma/world.hpp"

namespace thing_kin::python {

/// A drive of a world of the user's own, an object with the methods of WorldRun.
std::unique_ptr<WorldRun> python_run(const py::object& run, double reach);

/// Throws InvalidArgument unless the base begins where it is said to.
void check_start(WorldRun& run, const SearchPoints& side);

}  // namespace thing_kin::python
