#include "thing_kin/rmma/experiment.hpp"

#include <pybind11/stl.h>

#include "map.hpp"
#include "rmma/world.hpp"
#include "search_bindings.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/rmma/manipulator_arm.hpp"

namespace thing_kin::python {

namespace {

using ArmPointer = std::shared_ptr<const ManipulatorArm>;

/// World of a drive: the core's own, or one that Python makes; with an arm, or with its own.
StartDrive start_drive(const py::object& world, const ArmPointer& arm, std::uint64_t seed,
                       double reach) {
  const auto armed = [arm](std::unique_ptr<WorldRun> run) {
    return arm ? with_arm(std::move(run), arm) : std::move(run);
  };
  if (py::isinstance<World>(world)) {
    return [values = world.cast<World>(), seed, armed](double velocity, const SearchPoints& side,
                                                       const DriveIndex& index) {
      return armed(start_run(values, velocity, side, drive_key(seed, index)));
    };
  }
  return [world, seed, reach, armed](double velocity, const SearchPoints& side,
                                     const DriveIndex& index) {
    std::unique_ptr<WorldRun> run =
        python_run(world(velocity, points_array(side), drive_key(seed, index)), reach);
    check_start(*run, side);
    return armed(std::move(run));
  };
}

py::array_t<double> attempts_array(const std::vector<Attempt>& attempts, py::ssize_t velocities,
                                   py::ssize_t runs) {
  constexpr py::ssize_t kColumns = 5;
  const auto fiducials = static_cast<py::ssize_t>(attempts.size()) / (velocities * runs);
  const py::ssize_t shape[] = {kColumns, velocities, runs, fiducials};
  Array array = make_array(shape, 4);
  double* const to = array.mutable_data();
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const Attempt& attempt = attempts[i];
    const std::array values{attempt.intercepted ? 1.0 : 0.0, attempt.searched ? 1.0 : 0.0,
                            attempt.search_time, attempt.position_error,
                            static_cast<double>(attempt.samples)};
    for (std::size_t k = 0; k < values.size(); ++k) {
      to[k * attempts.size() + i] = values[k];
    }
  }
  return array;
}

std::vector<SearchPoints> read_sides(const py::list& sides) {
  std::vector<SearchPoints> result;
  for (const py::handle& side : sides) {
    result.push_back(read_points(side, "arrangement", 1));
  }
  return result;
}

py::list trace_list(const std::vector<SearchTrace>& searches) {
  py::list list;
  for (const SearchTrace& search : searches) {
    list.append(
        py::make_tuple(search.fiducial, search.start, search.end, search.hit, search.position_error,
                       to_array(search.predicted), to_array(search.covariance),
                       to_array(Eigen::Map<const Eigen::VectorXd>(
                           search.times.data(), static_cast<Eigen::Index>(search.times.size()))),
                       points_array(search.tools)));
  }
  return list;
}

}  // namespace

void bind_experiment(py::module_& m) {
  py::enum_<SearchMethod>(m, "SearchMethod")
      .value("spiral", SearchMethod::kSpiral)
      .value("linear_kf", SearchMethod::kLinearKf)
      .value("ukf", SearchMethod::kUkf)
      .value("covering", SearchMethod::kCovering);
  py::enum_<OdometryUse>(m, "OdometryUse")
      .value("continuous", OdometryUse::kContinuous)
      .value("failure", OdometryUse::kFailure)
      .value("none", OdometryUse::kNone);
  py::class_<SearchOptions>(m, "SearchOptions")
      .def(py::init([](SearchMethod method, double sample_gap, double q, double r_hit,
                       double r_fail, double p0, double spiral_gap, std::size_t spiral_count,
                       OdometryUse odometry, double detection_radius, double u_max, double reach) {
             SearchOptions options;
             options.method = method;
             options.thesis.sample_gap = sample_gap;
             options.thesis.q = q;
             options.thesis.r_hit = r_hit;
             options.thesis.r_fail = r_fail;
             options.thesis.p0 = p0;
             options.thesis.spiral_gap = spiral_gap;
             options.thesis.spiral_count = spiral_count;
             options.thesis.u_max = u_max;
             options.covering = {.odometry = odometry,
                                 .detection_radius = detection_radius,
                                 .u_max = u_max,
                                 .reach = reach};
             return options;
           }),
           py::kw_only(), py::arg("method"), py::arg("sample_gap"), py::arg("q"), py::arg("r_hit"),
           py::arg("r_fail"), py::arg("p0"), py::arg("spiral_gap"), py::arg("spiral_count"),
           py::arg("odometry"), py::arg("detection_radius"), py::arg("u_max"), py::arg("reach"));

  m.def(
      "run_experiment",
      [](const py::list& sides, const ArrayLike& velocities, std::size_t runs,
         const SearchOptions& options, std::uint64_t seed, const py::object& world,
         const std::optional<ArmPointer>& arm, const ThreadCount& threads) {
        const std::vector<SearchPoints> read_in = read_sides(sides);
        const Batch speeds = read(velocities, "velocities", {});
        const std::span<const double> each(speeds.data, static_cast<std::size_t>(speeds.count));
        const StartDrive start =
            start_drive(world, arm.value_or(nullptr), seed, options.covering.reach);
        const bool own = py::isinstance<World>(world);
        std::vector<Attempt> attempts;
        if (own) {
          const int count = thread_count(read_threads(threads), each.size() * runs, 1);
          const py::gil_scoped_release release;
          attempts = run_experiment(read_in, each, runs, options, seed, start, count);
        } else {
          attempts = run_experiment(read_in, each, runs, options, seed, start, 1);
        }
        return attempts_array(attempts, speeds.count, static_cast<py::ssize_t>(runs));
      },
      py::arg("sides"), py::arg("velocities"), py::arg("runs"), py::arg("options"), py::arg("seed"),
      py::arg("world"), py::arg("arm"), py::arg("threads"));

  m.def(
      "trace_run",
      [](const py::list& sides, double velocity, const SearchOptions& options, std::uint64_t seed,
         std::uint64_t run, const py::object& world, const std::optional<ArmPointer>& arm) {
        const std::vector<SearchPoints> read_in = read_sides(sides);
        std::size_t fiducials = 0;
        for (const SearchPoints& side : read_in) {
          fiducials += side.size();
        }
        std::vector<Attempt> attempts(fiducials);
        std::vector<std::vector<SearchTrace>> traces;
        run_once(read_in, velocity, options, seed, {.velocity = 0, .run = run, .side = 0},
                 start_drive(world, arm.value_or(nullptr), seed, options.covering.reach), attempts,
                 &traces);
        py::list list;
        for (const std::vector<SearchTrace>& side : traces) {
          list.append(trace_list(side));
        }
        return py::make_tuple(attempts_array(attempts, 1, 1), list);
      },
      py::arg("sides"), py::arg("velocity"), py::arg("options"), py::arg("seed"), py::arg("run"),
      py::arg("world"), py::arg("arm"));

  m.def(
      "drive_key",
      [](std::uint64_t seed, std::uint64_t velocity, std::uint64_t run, std::uint64_t side) {
        return drive_key(seed, {.velocity = velocity, .run = run, .side = side});
      },
      py::arg("seed"), py::arg("velocity"), py::arg("run"), py::arg("side"));

  m.def("read_seed", &read_seed, py::arg("rng"));
  m.def(
      "next_fiducial",
      [](const ArrayLike& x, std::size_t previous, double travelled) {
        const Batch along = read(x, "x", {});
        SearchPoints side;
        for (py::ssize_t i = 0; i < along.count; ++i) {
          side.emplace_back(along.data[i], 0.0);
        }
        return next_fiducial(side, previous, travelled);
      },
      py::arg("x"), py::arg("previous"), py::arg("travelled"));
}

}  // namespace thing_kin::python
