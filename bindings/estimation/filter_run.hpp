#pragma once

// The results of a record, and the loop over it.

#include <utility>

#include "filter_arguments.hpp"
#include "thing_kin/estimation/filter_run.hpp"

namespace thing_kin::python {

struct FilterRun {
  /// Arrays for `count` rows of m numbers.
  FilterRun(int n, int m, py::ssize_t count, bool smooth);

  /// Where the core writes.
  RunOutput output();

  Array x, P, innovations, nis;
  py::array_t<bool> accepted;
  std::vector<FilterStatus> status;
  py::object x_smooth, P_smooth;  // None without smoothing
  double log_likelihood = 0.0;
};

/// What every run takes.
struct RunArguments {
  Batch record;
  Rows R;
  double gate;
  bool smooth;
};

/// Runs a copy of the filter, which becomes it where nothing was thrown: predict(filter, i) and
/// update(filter, i, z, R). Without the GIL if the models do not need it.
template <typename Filter, typename Predict, typename Update>
FilterRun run_filter(Filter& filter, const RunArguments& arguments, bool calls_python,
                     const Predict& predict, const Update& update) {
  const auto m = static_cast<int>(arguments.record.size);
  const py::ssize_t count = arguments.record.count;
  FilterRun run(filter.size(), m, count, arguments.smooth);
  RunOutput out = run.output();
  Filter copy = filter;
  StateVector z(m);
  StateMatrix R(m, m);
  const auto predict_row = [&](py::ssize_t i) { return predict(copy, i); };
  const auto update_row = [&](py::ssize_t i, const double* row) {
    std::copy_n(row, m, z.data());
    std::copy_n(arguments.R.at(i), m * m, R.data());
    return update(copy, i, z, R);
  };
  {
    std::optional<py::gil_scoped_release> release;
    if (!calls_python) {
      release.emplace();
    }
    run_record(copy, arguments.record.data, count, m, predict_row, update_row, out);
  }
  run.log_likelihood = out.log_likelihood;
  bool* accepted = run.accepted.mutable_data();
  for (const FilterStatus status : run.status) {
    *accepted++ = status == FilterStatus::kOk;
  }
  filter = copy;
  return run;
}

}  // namespace thing_kin::python
