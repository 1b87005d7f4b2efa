#pragma once

// Borders between numpy and the core: every array argument is checked here, once, and named in the
// error if it is wrong. C-ordered float64 input is read in place; anything else is converted.

#include <array>
#include <initializer_list>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "thing_kin/core/types.hpp"
#include "thing_kin/lie/se3.hpp"

namespace thing_kin::python {

namespace py = pybind11;

/// Any argument that numpy can make an array of. Takes no part in overload resolution: the checks
/// below say what is wrong with it.
class ArrayLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(ArrayLike, object, [](PyObject*) { return 1; })
};

/// The same, or None.
class OptionalArray : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(OptionalArray, object, [](PyObject*) { return 1; })
};

/// Results that are a float for one configuration and an array for a batch.
class FloatOrArray : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(FloatOrArray, object, [](PyObject*) { return 1; })
};

using Array = py::array_t<double>;

/// An array argument in C order: `count` items of `size` doubles each.
struct Batch {
  const double* data = nullptr;
  py::ssize_t count = 1;
  py::ssize_t size = 1;
  bool single = true;  ///< no leading batch axis
  py::object owner;    ///< keeps the data alive

  const double* item(py::ssize_t i) const { return data + i * size; }
};

/// Limits may be infinite, nothing else.
enum class Finite : bool { kNo, kYes };

/// What users have instead of a matrix, known by what it offers, so that nothing is imported:
/// rotations and rigid transforms of SciPy, quaternions of Pinocchio, several poses of spatialmath.
/// (Pinocchio's SE3 and a single pose of spatialmath are arrays to numpy already.) Else as it is.
py::object as_matrix(py::handle argument);

/// Reads one item of shape `item` or, if `batches`, a stack of them. Throws InvalidArgument for a
/// wrong shape, a dtype that is not real numbers, NaN or inf.
Batch read(py::handle argument, const char* name, const std::vector<py::ssize_t>& item,
           bool batches = true, Finite finite = Finite::kYes);

/// The quick way for a control loop: copies a C-ordered float64 array of exactly this shape, or a
/// list or tuple of floats for a vector. False, and `out` is anything, if it is something else or
/// not finite: then read() knows what to do or to say.
bool read_plain(py::handle argument, std::initializer_list<py::ssize_t> shape,
                double* out) noexcept;

/// The same for an array that is checked elsewhere: it may have NaN or inf.
bool copy_plain(py::handle argument, std::initializer_list<py::ssize_t> shape,
                double* out) noexcept;

/// n numbers, or one that stands for all.
SmallVector read_number_or_vector(py::handle argument, const char* name, py::ssize_t n,
                                  Finite finite);

/// Throws InvalidArgument if an entry is so large that products of a few would overflow.
void check_magnitude(const Batch& batch, const char* name);

/// As read(), for the hot path of one (n) vector or an (N, n) batch.
Batch read_vectors(py::handle argument, const char* name, py::ssize_t n);

/// One matrix of any shape up to kMaxDof on a side, or a stack of them; `rows`, `cols` are set.
Batch read_matrices(py::handle argument, const char* name, py::ssize_t& rows, py::ssize_t& cols);

/// The shape of a batch's results.
struct Shape {
  std::array<py::ssize_t, 5> lengths{};
  int dimensions = 0;
};

/// `item`, with a leading axis if the batch has one.
Shape shape_of(const Batch& batch, std::initializer_list<py::ssize_t> item);

/// As Python writes it; a stack's begins with N.
std::string shape_text(const py::ssize_t* lengths, py::ssize_t dimensions, bool stack = false);

/// A new C-ordered array for the results of a batch, shaped as shape_of() says.
Array make_array(const Batch& batch, std::initializer_list<py::ssize_t> item);

/// A new C-ordered array.
Array make_array(const py::ssize_t* shape, int dimensions);

/// A read-only copy, so that an immutable object's arrays can't be mistaken for its state.
Array frozen(const JointVector& v);

/// Rigid transform from 16 row-major numbers; throws InvalidArgument naming `name` if it is none.
SE3 read_pose(const double* row_major, const char* name);
Eigen::Matrix3d read_rotation(const double* row_major, const char* name);

void write_pose(const SE3& T, double* row_major);

template <typename Matrix>
void write_matrix(const Matrix& matrix, double* row_major) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor>(row_major, matrix.rows(), matrix.cols()) = matrix;
}

/// A copy: a vector as (n), a matrix as (rows, columns).
template <typename Derived>
Array to_array(const Eigen::MatrixBase<Derived>& M) {
  const py::ssize_t shape[] = {M.rows(), M.cols()};
  Array array = make_array(shape, Derived::IsVectorAtCompileTime ? 1 : 2);
  write_matrix(M.derived(), array.mutable_data());
  return array;
}

inline SmallMatrix matrix_at(const Batch& batch, py::ssize_t i, py::ssize_t rows,
                             py::ssize_t cols) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(batch.item(i), rows, cols);
}

inline SmallVector vector_at(const Batch& batch, py::ssize_t i) {
  return Eigen::Map<const Eigen::VectorXd>(batch.item(i), batch.size);
}

}  // namespace thing_kin::python

namespace pybind11::detail {

template <>
struct handle_type_name<thing_kin::python::ArrayLike> {
  static constexpr auto name = const_name("numpy.typing.ArrayLike");
};

template <>
struct handle_type_name<thing_kin::python::OptionalArray> {
  static constexpr auto name = const_name("numpy.typing.ArrayLike | None");
};

template <>
struct handle_type_name<thing_kin::python::FloatOrArray> {
  static constexpr auto name = const_name("float | numpy.typing.NDArray[numpy.float64]");
};

}  // namespace pybind11::detail
