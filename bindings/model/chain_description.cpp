#include "thing_kin/model/chain_description.hpp"

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

// A chain is pickled as its description, in plain tuples.

namespace {

py::tuple to_state(const SE3& T) {
  py::list numbers;
  for (const double x : T.rotation.reshaped()) {
    numbers.append(x);
  }
  for (const double x : T.translation) {
    numbers.append(x);
  }
  return py::tuple(numbers);
}

SE3 se3_from_state(const py::handle& state) {
  const auto numbers = state.cast<std::vector<double>>();
  if (numbers.size() != 12) {
    throw InvalidArgument("state", std::to_string(numbers.size()) + " numbers", "12");
  }
  SE3 T;
  T.rotation = Eigen::Map<const Eigen::Matrix3d>(numbers.data());
  T.translation = Eigen::Map<const Eigen::Vector3d>(numbers.data() + 9);
  return T;
}

py::tuple to_state(const Segment& s) {
  return py::make_tuple(s.frame, s.joint, to_string(s.type), to_state(s.before), to_state(s.after),
                        s.limits.lower, s.limits.upper, s.limits.velocity, s.limits.acceleration);
}

Segment segment_from_state(const py::tuple& s) {
  return {s[0].cast<std::string>(),
          s[1].cast<std::string>(),
          joint_type_from_string(s[2].cast<std::string>()),
          se3_from_state(s[3]),
          se3_from_state(s[4]),
          {s[5].cast<double>(), s[6].cast<double>(), s[7].cast<double>(), s[8].cast<double>()}};
}

py::tuple to_state(const ChainDescription& d) {
  py::list segments;
  for (const Segment& segment : d.segments) {
    segments.append(to_state(segment));
  }
  return py::make_tuple(d.name, d.root, segments, d.order, d.has_omni_base);
}

ChainDescription description_from_state(const py::tuple& state) {
  ChainDescription d;
  d.name = state[0].cast<std::string>();
  d.root = state[1].cast<std::string>();
  for (const py::handle segment : state[2]) {
    d.segments.push_back(segment_from_state(segment.cast<py::tuple>()));
  }
  d.order = state[3].cast<std::vector<int>>();
  d.has_omni_base = state[4].cast<bool>();
  return d;
}

}  // namespace

void bind_chain_description(ChainClass& chain) {
  chain.def(
      py::pickle([](const Chain& c) { return to_state(c.description()); },
                 [](const py::tuple& state) { return Chain(description_from_state(state)); }));
}

}  // namespace thing_kin::python
