#pragma once

// Methods for control loops. pybind11's dispatcher costs a fifth of a microsecond a call, and as
// much again for each argument that is passed by its name; a filter's step costs no more. A quick
// method is pybind11's, with its signature, docstring and errors, behind one that takes calls whose
// arguments are plainly right by CPython's own convention and hands on all others.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include <pybind11/pybind11.h>

namespace thing_kin::python {

namespace py = pybind11;

/// The object behind a Python one of exactly this class, `type`; nullptr otherwise.
template <typename T>
T* object_of(PyObject* self, const PyTypeObject* type) noexcept {
  if (Py_TYPE(self) != type) {
    return nullptr;
  }
  const auto* held = reinterpret_cast<const py::detail::instance*>(self);
  return held->simple_layout && held->simple_holder_constructed
             ? static_cast<T*>(held->simple_value_holder[0])
             : nullptr;
}

/// How a quick call reads an argument; false leaves the call to pybind11.
template <typename T>
struct QuickArgument {
  static_assert(std::is_base_of_v<py::object, T>);
  T value;
  bool load(PyObject* argument) {
    value = py::reinterpret_borrow<T>(argument);
    return true;
  }
};

template <>
struct QuickArgument<double> {
  double value = 0.0;
  bool load(PyObject* argument) {
    value = PyFloat_CheckExact(argument) ? PyFloat_AS_DOUBLE(argument) : 0.0;
    return PyFloat_CheckExact(argument);
  }
};

template <>
struct QuickArgument<std::optional<double>> {
  std::optional<double> value;
  bool load(PyObject* argument) {
    if (PyFloat_CheckExact(argument)) {
      value = PyFloat_AS_DOUBLE(argument);
    }
    return value || argument == Py_None;
  }
};

template <>
struct QuickArgument<std::string> {
  std::string value;
  bool load(PyObject* argument) {
    Py_ssize_t size = 0;
    const char* text =
        PyUnicode_CheckExact(argument) ? PyUnicode_AsUTF8AndSize(argument, &size) : nullptr;
    if (text != nullptr) {
      value.assign(text, static_cast<std::size_t>(size));
    } else {
      PyErr_Clear();
    }
    return text != nullptr;
  }
};

template <auto function>
class QuickMethod;

/// A method `function(self, arguments...)` of a class. One for each function: what CPython calls
/// has no other place for its state.
template <typename Self, typename Result, typename... Args, Result (*function)(Self&, Args...)>
class QuickMethod<function> {
  static constexpr std::size_t kCount = sizeof...(Args);
  using Values = std::array<PyObject*, kCount>;

 public:
  /// As Class::def(), with py::arg() for every argument.
  template <typename Class, typename... Extra>
  static void define(Class& owner, const char* name, const Extra&... extra) {
    owner.def(name, function, extra...);
    (note(extra), ...);
    most_positional = has_keyword_only ? most_positional : kCount;
    exact_type = reinterpret_cast<PyTypeObject*>(owner.ptr());
    const py::object slow = owner.attr(name);
    // As long as the module: never freed.
    slow_method = slow.inc_ref().ptr();
    docstring = new std::string(slow.attr("__doc__").template cast<std::string>());
    definition = {name, reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&call)),
                  METH_FASTCALL | METH_KEYWORDS, docstring->c_str()};
    owner.attr(name) =
        py::reinterpret_steal<py::object>(PyDescr_NewMethod(exact_type, &definition));
  }

 private:
  static void note(const py::arg& argument) { note(argument.name, nullptr); }
  static void note(const py::arg_v& argument) {
    note(argument.name, argument.value.inc_ref().ptr());
  }
  static void note(const char* /*doc*/) {}
  static void note(py::kw_only /*mark*/) {
    most_positional = noted;
    has_keyword_only = true;
  }
  static void note(const char* name, PyObject* fallback) {
    argument_names[noted] = PyUnicode_InternFromString(name);
    argument_defaults[noted++] = fallback;
  }

  static bool gather(PyObject* const* arguments, std::size_t count, PyObject* names,
                     Values& values) noexcept {
    if (count > most_positional) {
      return false;
    }
    std::size_t k = 0;
    for (; k < count; ++k) {
      values[k] = arguments[k];
    }
    for (; k < kCount; ++k) {
      values[k] = nullptr;
    }
    const Py_ssize_t named = names != nullptr ? PyTuple_GET_SIZE(names) : 0;
    for (Py_ssize_t i = 0; i < named; ++i) {
      k = count;
      while (k < kCount && argument_names[k] != PyTuple_GET_ITEM(names, i)) {
        ++k;
      }
      if (k == kCount || values[k] != nullptr) {
        return false;
      }
      values[k] = arguments[count + static_cast<std::size_t>(i)];
    }
    for (k = count; k < kCount; ++k) {
      values[k] = values[k] != nullptr ? values[k] : argument_defaults[k];
      if (values[k] == nullptr) {
        return false;
      }
    }
    return true;
  }

  static PyObject* call(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                        PyObject* names) noexcept {
    Values values;
    Self* const object = object_of<Self>(self, exact_type);
    if (object != nullptr && gather(arguments, static_cast<std::size_t>(count), names, values)) {
      try {
        PyObject* result = nullptr;
        if (quick(*object, values, std::index_sequence_for<Args...>(), result)) {
          return result;
        }
      } catch (py::error_already_set& error) {
        error.restore();
        return nullptr;
      } catch (...) {
        py::detail::try_translate_exceptions();
        return nullptr;
      }
    }
    return hand_on(self, arguments, count, names);
  }

  template <std::size_t... K>
  static bool quick(Self& object, const Values& values, std::index_sequence<K...> /*each*/,
                    PyObject*& result) {
    std::tuple<QuickArgument<std::decay_t<Args>>...> read;
    if (!(std::get<K>(read).load(values[K]) && ...)) {
      return false;
    }
    if constexpr (std::is_same_v<Result, bool>) {
      result = PyBool_FromLong(function(object, std::get<K>(read).value...));
    } else {
      result = py::cast(function(object, std::get<K>(read).value...)).release().ptr();
    }
    return true;
  }

  static PyObject* hand_on(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                           PyObject* names) noexcept {
    const auto given =
        static_cast<std::size_t>(count + (names != nullptr ? PyTuple_GET_SIZE(names) : 0));
    constexpr std::size_t kMost = 24;  // more than any of them has
    std::array<PyObject*, kMost> all;
    if (given + 1 > kMost) {
      PyErr_SetString(PyExc_TypeError, "too many arguments");
      return nullptr;
    }
    all[0] = self;
    std::copy_n(arguments, given, all.data() + 1);
    return PyObject_Vectorcall(slow_method, all.data(), static_cast<std::size_t>(count) + 1, names);
  }

  inline static std::array<PyObject*, kCount> argument_names{};
  inline static std::array<PyObject*, kCount> argument_defaults{};
  inline static std::size_t noted = 0;
  inline static std::size_t most_positional = 0;
  inline static bool has_keyword_only = false;
  inline static PyTypeObject* exact_type = nullptr;
  inline static PyObject* slow_method = nullptr;
  inline static std::string* docstring = nullptr;
  inline static PyMethodDef definition{};
};

}  // namespace thing_kin::python
