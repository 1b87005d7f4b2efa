#include "model/ur_calibration.hpp"

#include <set>

#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace py = pybind11;

namespace {

constexpr const char* kShape =
    "{'kinematics': {link: {x, y, z, roll, pitch, yaw}}} for the six links shoulder, upper_arm, "
    "forearm, wrist_1, wrist_2 and wrist_3";

[[noreturn]] void refuse(const std::string& got) {
  throw InvalidArgument("calibration", got, kShape);
}

std::string shown(py::handle object) { return shortened(py::repr(object), 60); }

// Exactly these keys, and perhaps those.
py::dict table_of(py::handle object, const std::string& where, const std::set<std::string>& keys,
                  const std::set<std::string>& optional = {}) {
  if (!py::isinstance(object, py::module_::import("collections.abc").attr("Mapping"))) {
    refuse(where + " that is no mapping: " + shown(object));
  }
  const py::dict table(py::reinterpret_borrow<py::object>(object));
  for (const auto& [key, value] : table) {
    const std::string name = py::isinstance<py::str>(key) ? std::string(py::str(key)) : "";
    if (!keys.contains(name) && !optional.contains(name)) {
      refuse(where + " with " + shown(key));
    }
  }
  for (const std::string& key : keys) {
    if (!table.contains(key)) {
      refuse(where + " without " + quoted(key));
    }
  }
  return table;
}

// PyYAML takes 5e-05, which YAML 1.1 wants to be 5.0e-05, for text.
double number_of(py::handle value, const std::string& where) {
  double number = 0.0;
  try {
    if (!py::isinstance<py::bool_>(value)) {
      number = py::float_(py::reinterpret_borrow<py::object>(value));
      return number;
    }
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError) &&
        !error.matches(PyExc_OverflowError)) {
      throw;
    }
  }
  refuse(std::string(where).append(" = ").append(shown(value)));
}

}  // namespace

UrCalibration read_calibration(const py::object& source) {
  py::object mapping = source;
  if (py::isinstance<py::str>(source) || py::isinstance<py::bytes>(source) ||
      py::hasattr(source, "__fspath__")) {
    mapping = py::module_::import("thing_kin._ur_calibration").attr("load")(source);
  }
  const std::set<std::string> links(UrCalibration::kLinks.begin(), UrCalibration::kLinks.end());
  const py::dict top = table_of(mapping, "a calibration", {"kinematics"});
  const py::dict kinematics = table_of(top["kinematics"], "kinematics", links, {"hash"});
  UrCalibration calibration;
  for (std::size_t i = 0; i < calibration.origins.size(); ++i) {
    const std::string name = UrCalibration::kLinks[i];
    const std::set<std::string> keys{"x", "y", "z", "roll", "pitch", "yaw"};
    const py::dict link = table_of(kinematics[name.c_str()], name, keys);
    const auto number = [&](const char* key) {
      return number_of(link[key], std::string(name).append(".").append(key));
    };
    calibration.origins[i].xyz << number("x"), number("y"), number("z");
    calibration.origins[i].rpy << number("roll"), number("pitch"), number("yaw");
  }
  check(calibration);
  return calibration;
}

}  // namespace thing_kin::python
