#pragma once

// Arguments of the differential kinematics: the point that moves; q, qd and qdd, which belong
// together.

#include <array>
#include <cstddef>
#include <string>

#include "map.hpp"
#include "model/chain.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/kinematics/jacobian.hpp"

namespace thing_kin::python {

/// An argument `point`.
class PointLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(PointLike, object, [](PyObject*) { return 1; })
};

/// `of` is a frame (None: the tool), `point` three coordinates in it (None: its origin).
inline MovingPoint read_point(const Chain& chain, const FrameLike& of, const PointLike& point) {
  const int frame = read_frame(chain, of, "of");
  if (point.is_none()) {
    return frame;
  }
  const Batch batch = read(point, "point", {3}, false);
  check_magnitude(batch, "point");
  return {frame, Eigen::Map<const Eigen::Vector3d>(batch.data)};
}

struct JointArgument {
  const ArrayLike& value;
  const char* name;
};

/// Each (n) or (N, n); all batches have the same N, a single vector goes with every item of them.
template <std::size_t K>
Batches<K> read_together(const Chain& chain, const std::array<JointArgument, K>& arguments) {
  Batches<K> batches;
  std::size_t first = K;  // the first that is a batch
  for (std::size_t i = 0; i < K; ++i) {
    Batch& batch = batches[i];
    batch = read_vectors(arguments[i].value, arguments[i].name, chain.dof());
    check_magnitude(batch, arguments[i].name);
    if (batch.single) {
      continue;
    }
    first = first == K ? i : first;
    if (batch.count != batches[first].count) {
      throw InvalidArgument(arguments[i].name, std::to_string(batch.count) + " items",
                            std::to_string(batches[first].count) + ", as many as " +
                                arguments[first].name + ", or one without a leading axis");
    }
  }
  return batches;
}

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::PointLike> {
  static constexpr auto name = const_name("numpy.typing.ArrayLike | None");
};

}  // namespace pybind11::detail
