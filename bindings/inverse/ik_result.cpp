#include "inverse/ik_result.hpp"

#include <algorithm>

#include "array.hpp"
#include "bindings.hpp"

namespace thing_kin::python {

namespace {

const Chain& chain_of(const py::object& chain) { return chain.cast<const Chain&>(); }

py::array_t<std::int8_t> limits_of(const ExplainedIk& ik) {
  return py::array_t<std::int8_t>(ik.result.q.size(), ik.result.active_limits.data());
}

py::str describe(const ExplainedIk& ik) {
  return py::str("IkResult({}: {}; {} iterations, {} restarts, {:.1f} us, q={})")
      .format(to_string(ik.result.status), ik.message(), ik.result.iterations, ik.result.restarts,
              1e6 * ik.result.time, to_array(ik.result.q));
}

py::object statuses(const ExplainedIkBatch& batch) {
  py::list names;
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    names.append(to_string(static_cast<IkStatus>(batch.status.at(i))));
  }
  return py::module_::import("numpy").attr("array")(names, py::arg("dtype") = "<U11");
}

py::array_t<bool> successes(const ExplainedIkBatch& batch) {
  py::array_t<bool> success(batch.count);
  std::transform(batch.status.data(), batch.status.data() + batch.count, success.mutable_data(),
                 [](std::uint8_t s) { return static_cast<IkStatus>(s) == IkStatus::kSuccess; });
  return success;
}

py::list messages(const ExplainedIkBatch& batch) {
  py::list list;
  for (py::ssize_t i = 0; i < batch.count; ++i) {
    list.append(batch.at(i).message());
  }
  return list;
}

ExplainedIk item(const ExplainedIkBatch& batch, py::ssize_t i) {
  const py::ssize_t row = i < 0 ? i + batch.count : i;
  if (row < 0 || row >= batch.count) {
    throw py::index_error(std::to_string(i));
  }
  return batch.at(row);
}

void bind_one(py::module_& m) {
  py::class_<ExplainedIk>(m, "IkResult",
                          R"(What an inverse kinematics solver found, and why not more.

q is always finite and within the limits, also without success: then it is the best that was found.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> arm = tk.robots.ur10()
>>> result = tk.ik(arm, tk.transform(xyz=(0.0, 0.0, 5.0)))
>>> result.success, result.status
(False, 'unreachable')
>>> bool(result.position_error > 3.5)
True
)")
      .def_property_readonly(
          "q", [](const ExplainedIk& ik) { return to_array(ik.result.q); }, "(n,), rad and m.")
      .def_property_readonly(
          "success", [](const ExplainedIk& ik) { return ik.result.success(); },
          "Whether the target is met within tolerance and limits, by forward kinematics of q.")
      .def_property_readonly(
          "status", [](const ExplainedIk& ik) { return to_string(ik.result.status); },
          R"(How it ended.

'success'; 'unreachable': no pose found is nearer, and no limit holds the robot back; 'limited': joint
limits do; 'step_bound': max_step does; 'budget' or 'deadline': ran out.)")
      .def_property_readonly("message", &ExplainedIk::message, "The status in a sentence.")
      .def_property_readonly(
          "position_error", [](const ExplainedIk& ik) { return ik.result.position_error; },
          "Distance from the target, m, of the coordinates that count.")
      .def_property_readonly(
          "rotation_error", [](const ExplainedIk& ik) { return ik.result.rotation_error; },
          "Angle from the target, rad, of the coordinates that count.")
      .def_property_readonly("active_limits", &limits_of,
                             "(n,) int8: -1 where the joint is at its lower limit, 1 at its upper.")
      .def_property_readonly(
          "iterations", [](const ExplainedIk& ik) { return ik.result.iterations; },
          "Of all attempts together.")
      .def_property_readonly(
          "restarts", [](const ExplainedIk& ik) { return ik.result.restarts; },
          "Attempts after the first.")
      .def_property_readonly(
          "time", [](const ExplainedIk& ik) { return ik.result.time; }, "Seconds.")
      .def("__repr__", &describe);
}

void bind_many(py::module_& m) {
  using Batch = ExplainedIkBatch;
  py::class_<Batch>(m, "IkBatchResult", R"(The results for many targets: an array a field.

len(results) targets; results[i] is the IkResult of target i.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.robots.ur5()
>>> results = tk.ik(arm, arm.fk(arm.random(3, rng=0)))
>>> results.q.shape, bool(results.success.all()), results[0].status
((3, 6), True, 'success')
)")
      .def_readonly("q", &Batch::q, "(N, n), rad and m.")
      .def_property_readonly("success", &successes, "(N,) bool.")
      .def_property_readonly("status", &statuses, "(N,) str: see IkResult.")
      .def_property_readonly("message", &messages, "A list of N sentences.")
      .def_readonly("position_error", &Batch::position_error, "(N,), m.")
      .def_readonly("rotation_error", &Batch::rotation_error, "(N,), rad.")
      .def_readonly("active_limits", &Batch::active_limits, "(N, n) int8, -1, 0 or 1.")
      .def_readonly("iterations", &Batch::iterations, "(N,).")
      .def_readonly("restarts", &Batch::restarts, "(N,).")
      .def_readonly("time", &Batch::time, "(N,), seconds.")
      .def("__len__", [](const Batch& batch) { return batch.count; })
      .def("__getitem__", &item, py::arg("i"))
      .def("__repr__", [](const Batch& batch) {
        const auto reached = std::count(batch.status.data(), batch.status.data() + batch.count,
                                        static_cast<std::uint8_t>(IkStatus::kSuccess));
        return py::str("IkBatchResult({} of {} reached)").format(reached, batch.count);
      });
}

}  // namespace

ExplainedIkBatch::ExplainedIkBatch(py::object of, py::ssize_t targets)
    : chain(std::move(of)),
      count(targets),
      q({targets, static_cast<py::ssize_t>(chain_of(chain).dof())}),
      status(targets),
      position_error(targets),
      rotation_error(targets),
      active_limits({targets, static_cast<py::ssize_t>(chain_of(chain).dof())}),
      iterations(targets),
      restarts(targets),
      time(targets) {}

ExplainedIk ExplainedIkBatch::at(py::ssize_t i) const {
  const py::ssize_t n = q.shape(1);
  IkResult result;
  result.q = Eigen::Map<const Eigen::VectorXd>(q.data() + i * n, n);
  std::copy_n(active_limits.data() + i * n, n, result.active_limits.begin());
  result.status = static_cast<IkStatus>(status.at(i));
  result.position_error = position_error.at(i);
  result.rotation_error = rotation_error.at(i);
  result.iterations = iterations.at(i);
  result.restarts = restarts.at(i);
  result.time = time.at(i);
  return {result, chain};
}

void bind_ik_result(py::module_& m) {
  bind_one(m);
  bind_many(m);
}

}  // namespace thing_kin::python
