#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>  // std::variant

#include "thing_kin/core/error.hpp"
#include "thing_kin/model/obstacle.hpp"

namespace thing_kin::python {

/// An argument of obstacles: any number of Disc, Sphere, Capsule, Box and HalfSpace.
class ObstacleList : public pybind11::object {
 public:
  PYBIND11_OBJECT_DEFAULT(ObstacleList, object, [](PyObject*) { return 1; })
};

/// Throws InvalidArgument, naming the entry, for anything else.
inline std::vector<Obstacle> read_obstacles(const pybind11::object& argument, const char* name) {
  namespace py = pybind11;
  if (!py::isinstance<py::sequence>(argument) || py::isinstance<py::str>(argument)) {
    throw InvalidArgument(name, py::str(py::type::of(argument).attr("__name__")),
                          "a list of obstacles");
  }
  std::vector<Obstacle> obstacles;
  for (const py::handle entry : argument) {
    try {
      obstacles.push_back(entry.cast<Obstacle>());
    } catch (const py::cast_error&) {
      throw InvalidArgument(
          std::string(name).append("[").append(std::to_string(obstacles.size())).append("]"),
          py::str(py::type::of(entry).attr("__name__")),
          "a Disc, Sphere, Capsule, Box or HalfSpace");
    }
  }
  return obstacles;
}

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::ObstacleList> {
  static constexpr auto name = const_name(
      "collections.abc.Sequence[thing_kin._core.Disc | thing_kin._core.Sphere | "
      "thing_kin._core.Capsule | thing_kin._core.Box | thing_kin._core.HalfSpace]");
};

}  // namespace pybind11::detail
