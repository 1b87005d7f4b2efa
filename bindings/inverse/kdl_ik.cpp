#include "thing_kin/inverse/kdl_ik.hpp"

#include <optional>
#include <vector>

#include <pybind11/stl.h>

#include "inverse/ik_result.hpp"
#include "inverse/kdl_ik.hpp"
#include "map.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/core/parallel.hpp"

namespace thing_kin::python {

namespace {

// A target costs hundreds of microseconds, a thread some tens.
constexpr std::size_t kTargetsPerThread = 4;

Batch read_seeds(const OptionalArray& seed, py::ssize_t n, const Batch& targets) {
  if (seed.is_none()) {
    return {};
  }
  const Batch seeds = read_vectors(seed, "seed", n);
  if (!seeds.single && (targets.single || seeds.count != targets.count)) {
    throw InvalidArgument("seed", std::to_string(seeds.count).append(" configurations"),
                          "one, or one a target");
  }
  return seeds;
}

std::vector<SE3> read_targets(const Batch& targets) {
  std::vector<SE3> poses;
  poses.reserve(static_cast<std::size_t>(targets.count));
  for (py::ssize_t i = 0; i < targets.count; ++i) {
    poses.push_back(read_pose(targets.item(i), "target"));
  }
  return poses;
}

// Without the GIL. KDL's solvers keep their state: each thread has its own.
std::vector<IkResult> solve(const Chain& chain, const std::vector<SE3>& targets, const Batch& seeds,
                            const KdlIkOptions& options, int most) {
  std::vector<IkResult> results(targets.size());
  const int threads = thread_count(most, targets.size(), kTargetsPerThread);
  parallel_ranges(targets.size(), threads, 1, [&](std::size_t first, std::size_t last) {
    KdlIk solver(chain);
    for (std::size_t i = first; i < last; ++i) {
      const auto row = static_cast<py::ssize_t>(seeds.single ? 0 : i);
      results[i] =
          solver.solve(targets[i], seeds.data == nullptr ? nullptr : seeds.item(row), options);
    }
  });
  return results;
}

ExplainedIkBatch to_batch(const py::object& chain, const std::vector<IkResult>& results) {
  ExplainedIkBatch batch(chain, static_cast<py::ssize_t>(results.size()));
  const auto n = batch.q.shape(1);
  for (std::size_t row = 0; row < results.size(); ++row) {
    const auto i = static_cast<py::ssize_t>(row);
    const IkResult& result = results[row];
    std::copy_n(result.q.data(), n, batch.q.mutable_data() + i * n);
    std::copy_n(result.active_limits.data(), n, batch.active_limits.mutable_data() + i * n);
    batch.status.mutable_at(i) = static_cast<std::uint8_t>(result.status);
    batch.position_error.mutable_at(i) = result.position_error;
    batch.rotation_error.mutable_at(i) = result.rotation_error;
    batch.iterations.mutable_at(i) = result.iterations;
    batch.restarts.mutable_at(i) = result.restarts;
    batch.time.mutable_at(i) = result.time;
  }
  return batch;
}

py::object ik(const Chain& chain, const ArrayLike& target, const OptionalArray& seed,
              double position_tolerance, double rotation_tolerance, int max_iterations,
              int max_restarts, std::optional<double> deadline, std::uint64_t rng,
              const ThreadCount& threads) {
  KdlIkOptions options{position_tolerance, rotation_tolerance, max_iterations, max_restarts};
  options.deadline = deadline.value_or(options.deadline);
  options.rng = rng;
  options.check(chain);
  const int most = read_threads(threads);
  const Batch targets = read(target, "target", {4, 4});
  const Batch seeds = read_seeds(seed, chain.dof(), targets);
  const std::vector<SE3> poses = read_targets(targets);
  std::vector<IkResult> results;
  {
    const py::gil_scoped_release release;
    results = solve(chain, poses, seeds, options, most);
  }
  const py::object owner = py::cast(&chain, py::return_value_policy::reference);
  return targets.single ? py::cast(ExplainedIk{results.front(), owner})
                        : py::cast(to_batch(owner, results));
}

}  // namespace

void bind_kdl_ik(py::module_& m) {
  const KdlIkOptions defaults;
  m.def("ik", &ik, py::arg("chain"), py::arg("target"), py::arg("seed") = py::none(), py::kw_only(),
        py::arg("position_tolerance") = defaults.position_tolerance,
        py::arg("rotation_tolerance") = defaults.rotation_tolerance,
        py::arg("max_iterations") = defaults.max_iterations,
        py::arg("max_restarts") = defaults.max_restarts, py::arg("deadline") = py::none(),
        py::arg("rng") = defaults.rng, py::arg("threads") = py::none(),
        "See thing_kin.kdl.ik, which reads rng.");
}

}  // namespace thing_kin::python
