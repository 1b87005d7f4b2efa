#pragma once

// From an array of configurations to an array of results: one after the other or on several
// threads, in a new array or in the caller's.

#include <array>
#include <cstddef>
#include <initializer_list>

#include "array.hpp"
#include "thing_kin/core/parallel.hpp"

namespace thing_kin::python {

/// An argument `out`: None, or the array for the results.
class OutArray : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(OutArray, object, [](PyObject*) { return 1; })
};

/// An argument `threads`: None for as many as pay, or how many at most.
class ThreadCount : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(ThreadCount, object, [](PyObject*) { return 1; })
};

/// Where the results of a batch go and who computes them. A plain value, so that a call with
/// neither argument costs nothing.
struct Run {
  const OutArray& out;
  const ThreadCount& threads;
};

/// 0 for None; throws InvalidArgument for anything but None and whole numbers from 1.
int read_threads(const ThreadCount& threads);

/// The caller's `out` or a new C-ordered array: shape `item`, with a leading axis if the batch has
/// one. Throws InvalidArgument if `out` has another shape, another dtype, another order or is
/// read-only.
Array make_output(const Batch& batch, std::initializer_list<py::ssize_t> item, const OutArray& out);

/// Copies an input that shares memory with the output.
void detach(Batch& batch, const Array& out);

/// Throws InvalidArgument if two outputs of one call share memory.
void check_apart(const Array& first, const Array& second);

/// Rows a thread gets at least where a row costs some microseconds.
inline constexpr std::size_t kCostlyRowsPerThread = 64;
/// The same where it costs some tenths.
inline constexpr std::size_t kCheapRowsPerThread = 1024;

/// Several inputs of one function.
template <std::size_t K>
using Batches = std::array<Batch, K>;

/// out[i] = function(in[i]) for every item of the batches; those that are single go with each.
/// Without the GIL if there is a batch: `function(const std::array<const double*, K>& in, double*
/// out)` must not touch Python.
template <std::size_t K, typename Function>
Array map_together(Batches<K>& batches, std::initializer_list<py::ssize_t> item, const Run& run,
                   const Function& function, std::size_t rows_per_thread = kCheapRowsPerThread) {
  const Batch* longest = batches.data();
  for (const Batch& batch : batches) {
    longest = longest->single ? &batch : longest;
  }
  const int threads = read_threads(run.threads);
  Array out = make_output(*longest, item, run.out);
  if (!run.out.is_none()) {
    for (Batch& batch : batches) {
      detach(batch, out);
    }
  }
  double* const to = out.mutable_data();
  const py::ssize_t stride = longest->count > 0 ? out.size() / longest->count : 0;
  const auto compute = [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      const auto i = static_cast<py::ssize_t>(row);
      std::array<const double*, K> in;
      for (std::size_t k = 0; k < K; ++k) {
        in[k] = batches[k].item(batches[k].single ? 0 : i);
      }
      function(in, to + i * stride);
    }
  };
  if (longest->single) {
    compute(0, 1);
    return out;
  }
  const auto count = static_cast<std::size_t>(longest->count);
  const py::gil_scoped_release release;
  parallel_ranges(count, thread_count(threads, count, rows_per_thread), 1, compute);
  return out;
}

/// As above for one input: `function(const double* in, double* out)`.
template <typename Function>
Array map(const Batch& batch, std::initializer_list<py::ssize_t> item, const Run& run,
          const Function& function, std::size_t rows_per_thread = kCheapRowsPerThread) {
  const auto of_one = [&](const auto& in, double* out) { function(in[0], out); };
  Batches<1> batches{batch};
  return map_together(batches, item, run, of_one, rows_per_thread);
}

/// What stands for `out` and `threads` in functions that have neither: a new array, one thread.
struct Serial {
  OutArray out = py::reinterpret_borrow<OutArray>(py::none());
  ThreadCount threads = py::reinterpret_steal<ThreadCount>(PyLong_FromLong(1));
};

template <typename Function>
Array map(const Batch& batch, std::initializer_list<py::ssize_t> item, const Function& function) {
  const Serial serial;
  return map(batch, item, Run{serial.out, serial.threads}, function);
}

/// As map(), for functions that return one double.
template <typename Function>
FloatOrArray map_scalar(const Batch& batch, const Run& run, const Function& function) {
  if (batch.single && run.out.is_none()) {
    read_threads(run.threads);
    return py::reinterpret_steal<FloatOrArray>(PyFloat_FromDouble(function(batch.data)));
  }
  const auto store = [&](const double* in, double* out) { *out = function(in); };
  return py::reinterpret_steal<FloatOrArray>(
      map(batch, {}, run, store, kCostlyRowsPerThread).release());
}

template <typename Function>
FloatOrArray map_scalar(const Batch& batch, const Function& function) {
  const Serial serial;
  return map_scalar(batch, Run{serial.out, serial.threads}, function);
}

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::OutArray> {
  static constexpr auto name = const_name("numpy.typing.NDArray[numpy.float64] | None");
};

template <>
struct handle_type_name<thing_kin::python::ThreadCount> {
  static constexpr auto name = const_name("typing.SupportsIndex | None");
};

}  // namespace pybind11::detail
