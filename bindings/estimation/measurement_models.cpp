#include "thing_kin/estimation/measurement_models.hpp"

#include <memory>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "estimation_bindings.hpp"
#include "filter_arguments.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

using MeasurementHolder = std::shared_ptr<MeasurementModel>;

std::vector<int> read_indices(const Indices& indices, const char* name) {
  try {
    return indices.cast<std::vector<int>>();
  } catch (const py::cast_error&) {
    throw InvalidArgument(name, py::repr(indices), "a sequence of indices");
  }
}

// One state of any size that the model can see.
Batch read_state(const MeasurementModel& model, const ArrayLike& x) {
  const Batch state = read(x, "x", {});
  if (state.single || state.count < model.least_size() || state.count > kMaxState) {
    throw InvalidArgument("x", std::to_string(state.count) + " entries",
                          std::to_string(model.least_size()) + " to " + std::to_string(kMaxState));
  }
  check_magnitude(state, "x");
  return state;
}

Array measured_at(const MeasurementModel& model, const ArrayLike& x) {
  const Batch state = read_state(model, x);
  const py::ssize_t rows = model.rows();
  Array z = make_array(&rows, 1);
  model.evaluate(state.data, z.mutable_data());
  model.angles().wrap(z.mutable_data());
  return z;
}

Array slope(const MeasurementModel& model, const ArrayLike& x) {
  const Batch state = read_state(model, x);
  const std::array<py::ssize_t, 2> shape{model.rows(), state.count};
  Array H = make_array(shape.data(), 2);
  model.jacobian(state.data, static_cast<int>(state.count), H.mutable_data());
  return H;
}

}  // namespace

void bind_measurement_models(py::module_& models, py::module_& m) {
  py::class_<MeasurementModel, MeasurementHolder>(
      m, "MeasurementModel", py::is_final(),
      R"(What is measured of a state, with its exact Jacobian.

Made by the functions of thing_kin.estimation.models. It is passed to a filter in place of a function,
and then runs in the core; or called, model(x).

Examples
--------
>>> from thing_kin import estimation as est
>>> est.models.range_bearing((3.0, 4.0))([0.0, 0.0, 0.0]).round(3)
array([5.   , 0.927])
)")
      .def_property_readonly("name", &MeasurementModel::name,
                             "What the function that made it is called.")
      .def_property_readonly("m", &MeasurementModel::rows, "How many numbers are measured.")
      .def_property_readonly(
          "angles",
          [](const MeasurementModel& model) {
            return py::tuple(py::cast(model.angles().indices()));
          },
          "Which of them are angles.")
      .def("__call__", &measured_at, py::arg("x"), R"(What is expected at a state.

Parameters
----------
x : (n,)

Returns
-------
(m,)
    With angles in (-pi, pi].
)")
      .def("jacobian", &slope, py::arg("x"), R"(Its derivative with respect to the state.

Parameters
----------
x : (n,)

Returns
-------
(m, n)

Raises
------
ValueError
    If x has too few entries or is not finite.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.models.components((2, 0)).jacobian([0.0, 0.0, 0.0])
array([[0., 0., 1.],
       [1., 0., 0.]])
)")
      .def("__repr__", [](const MeasurementModel& model) {
        return model.name() + " of " + std::to_string(model.rows());
      });
  models.def(
      "components",
      [](const Indices& indices, const Indices& angles) {
        return std::const_pointer_cast<MeasurementModel>(
            components(read_indices(indices, "indices"), read_indices(angles, "angles")));
      },
      py::arg("indices"), py::kw_only(), py::arg("angles") = py::tuple(),
      R"(Entries of the state as they are.

Parameters
----------
indices : sequence of int
    Which, in the order of the measurement.
angles : sequence of int
    Which entries of the measurement are angles.

Returns
-------
MeasurementModel

Raises
------
ValueError
    If there is no index or one is out of range.

Examples
--------
>>> from thing_kin import estimation as est
>>> pose = est.models.components((0, 1, 2), angles=(2,))
>>> pose([1.0, 2.0, 3.0, 0.5])
array([1., 2., 3.])
)");
  models.def(
      "range_bearing",
      [](const ArrayLike& landmark) {
        const Batch point = read(landmark, "landmark", {2}, false);
        check_magnitude(point, "landmark");
        return std::const_pointer_cast<MeasurementModel>(
            range_bearing({point.data[0], point.data[1]}));
      },
      py::arg("landmark"),
      R"(Distance and bearing of a landmark from a planar pose, the state's first three entries.

Parameters
----------
landmark : (2,), m

Returns
-------
MeasurementModel
    Of (distance, bearing) in m and rad; the bearing is an angle, zero straight ahead.

Raises
------
ValueError
    If landmark is not two finite numbers.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.models.range_bearing((1.0, 0.0)).angles
(1,)
)");
}

}  // namespace thing_kin::python
