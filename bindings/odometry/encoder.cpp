#include "thing_kin/odometry/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimation_bindings.hpp"
#include "odometry/dead_reckoning.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

void check_ticks(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0.0)) {
    throw InvalidArgument(name, text(value), "a finite number > 0");
  }
}

Batch read_ticks(const ArrayLike& ticks) {
  const std::vector<py::ssize_t> shape = shape_of_any(ticks, "ticks");
  const py::ssize_t wheels = shape.size() == 2 ? shape[1] : 4;
  if (wheels < 1 || wheels > 64) {
    throw InvalidArgument("ticks", std::to_string(wheels) + " columns", "from 1 to 64");
  }
  Batch batch = read(ticks, "ticks", {wheels});
  check_magnitude(batch, "ticks");
  if (batch.single) {
    throw InvalidArgument("ticks", "a single row", "(N, wheels)");
  }
  return batch;
}

}  // namespace

void bind_encoder(py::module_& m) {
  m.def(
      "angles_from_ticks",
      [](const ArrayLike& ticks, double ticks_per_turn, const py::object& counter_range) {
        check_ticks(ticks_per_turn, "ticks_per_turn");
        const Batch counted = read_ticks(ticks);
        const py::ssize_t shape[] = {counted.count, counted.size};
        Array angles = make_array(shape, 2);
        const auto size = static_cast<std::size_t>(counted.count * counted.size);
        const std::span<double> numbers(angles.mutable_data(), size);
        std::copy_n(counted.data, size, numbers.begin());
        if (!counter_range.is_none()) {
          const double range = *read(counter_range, "counter_range", {}, false).data;
          check_ticks(range, "counter_range");
          unwrap_ticks(numbers, static_cast<std::size_t>(counted.size), range);
        }
        for (double& number : numbers) {
          number *= 2.0 * std::numbers::pi / ticks_per_turn;
        }
        return angles;
      },
      py::arg("ticks"), py::arg("ticks_per_turn"), py::kw_only(),
      py::arg("counter_range") = py::none(), R"(Wheel angles from encoder counts.

Parameters
----------
ticks : (N, wheels)
ticks_per_turn : float
    Of the wheel: an encoder's on the motor times the gear's ratio.
counter_range : float, optional
    How many values the counter has, if it starts anew after the last one: 65536 for 16 bits. No
    wheel may turn by half of it from one row to the next. Default: it does not overflow.

Returns
-------
(N, wheels), rad
    Whole turns included.

Raises
------
ValueError
    If the shape does not fit or a number is not finite, or not positive.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.angles_from_ticks([[65530], [10]], ticks_per_turn=360, counter_range=65536).round(3)
array([[1143.714],
       [1143.994]])
)");
}

}  // namespace thing_kin::python
