#include "column_weights.hpp"

#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

JointVector read_column_weights(const JacobianColumns& argument, const Chain& chain) {
  if (!py::isinstance<py::str>(argument)) {
    const Batch numbers = read(argument, "jacobian", {chain.dof()}, false);
    JointVector weights = vector_at(numbers, 0);
    constexpr double kLargest = 1e6;  // a product of twelve does not overflow
    for (const double weight : weights) {
      if (!(weight >= 0.0 && weight <= kLargest)) {
        throw InvalidArgument("jacobian", text(weight), "weights from 0 to 1e6");
      }
    }
    return weights;
  }
  const auto name = argument.cast<std::string>();
  if (name == "whole_body") {
    return {};
  }
  if (name != "arm") {
    throw InvalidArgument("jacobian", quoted(name), "'whole_body', 'arm' or a weight a joint");
  }
  JointVector weights = JointVector::Ones(chain.dof());
  if (const auto& base = chain.base_joints()) {
    for (const int joint : *base) {
      weights[joint] = 0.0;
    }
  }
  return weights;
}

}  // namespace thing_kin::python
