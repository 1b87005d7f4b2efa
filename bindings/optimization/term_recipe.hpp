#pragma once

// What the bindings of terms share. Each term is a class of thing_kin.terms.

#include <memory>
#include <optional>
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "array.hpp"
#include "thing_kin/core/error.hpp"
#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::python {

template <typename T>
using TermClass = py::class_<T, TermRecipe, std::shared_ptr<T>>;

/// The argument `frame`: a name, or None for the tool.
using FrameName = std::optional<std::string>;

inline std::optional<std::string> frame_or_none(const std::string& frame) {
  return frame.empty() ? std::nullopt : std::optional<std::string>(frame);
}

/// A vector of any length, finite.
inline Eigen::VectorXd read_any_vector(const py::object& values, const char* name) {
  const auto array = py::array::ensure(values);
  if (!array || array.ndim() != 1) {
    PyErr_Clear();
    throw InvalidArgument(name,
                          array ? "shape " + shape_text(array.shape(), array.ndim())
                                : std::string(py::str(py::type::of(values).attr("__name__"))),
                          "a vector of real numbers");
  }
  const Batch batch = read(values, name, {array.shape(0)}, false);
  return Eigen::Map<const Eigen::VectorXd>(batch.data, batch.size);
}

/// The same, or one number that stands for all; none: an empty one.
inline Eigen::VectorXd read_weights(const py::object& values, const char* name, Eigen::Index n) {
  if (values.is_none()) {
    return {};
  }
  const auto array = py::array::ensure(values);
  if (array && array.ndim() == 0) {
    return Eigen::VectorXd::Constant(n, *read(values, name, {}, false).data);
  }
  return read_any_vector(values, name);
}

/// A read-only copy.
inline Array frozen_copy(const Eigen::VectorXd& vector) {
  Array array(vector.size(), vector.data());
  array.attr("flags").attr("writeable") = false;
  return array;
}

template <int n>
Eigen::Matrix<double, n, 1> read_vector(const py::handle& argument, const char* name) {
  const Batch batch = read(argument, name, {n}, false);
  return Eigen::Map<const Eigen::Matrix<double, n, 1>>(batch.data);
}

/// (1.0, 2.0) as Python writes it.
inline py::tuple numbers_of(const Eigen::Ref<const Eigen::VectorXd>& vector) {
  py::tuple numbers(static_cast<std::size_t>(vector.size()));
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    numbers[static_cast<std::size_t>(i)] = vector[i] + 0.0;  // -0 becomes 0
  }
  return numbers;
}

}  // namespace thing_kin::python
