#include "thing_kin/model/urdf.hpp"

#include <optional>

#include <pybind11/stl.h>

#include "model/urdf_source.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin::python {

namespace {

std::string type_name(py::handle object) { return py::str(py::type::of(object).attr("__name__")); }

// As the file system has it; os.fspath and os.fsencode raise what the argument deserves.
std::string path_of(py::handle path, const char* argument) {
  const py::module_ os = py::module_::import("os");
  try {
    return os.attr("fsencode")(path).cast<py::bytes>();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) {
      throw;
    }
    throw InvalidArgument(argument, type_name(path), "a path");
  }
}

PackageFolders folders_of(const Packages& packages) {
  PackageFolders folders;
  if (packages.is_none()) {
    return folders;
  }
  if (!py::hasattr(packages, "items")) {
    throw InvalidArgument("packages", type_name(packages), "a mapping from names to paths");
  }
  for (const py::handle item : packages.attr("items")()) {
    const auto pair = py::reinterpret_borrow<py::tuple>(item);
    folders.emplace(path_of(pair[0], "packages"), path_of(pair[1], "packages"));
  }
  return folders;
}

// The text of a str that is XML, not a path; without the byte order mark it may begin with.
std::optional<std::string> xml_of(const py::object& source) {
  if (py::isinstance<py::bytes>(source)) {
    return source.cast<std::string>();
  }
  if (!py::isinstance<py::str>(source)) {
    return std::nullopt;
  }
  const py::object text = source.attr("lstrip")("\xEF\xBB\xBF \t\r\n");
  if (!text.attr("startswith")("<").cast<bool>()) {
    return std::nullopt;
  }
  py::ssize_t size = 0;
  const char* utf8 = PyUnicode_AsUTF8AndSize(source.ptr(), &size);
  if (utf8 == nullptr) {
    PyErr_Clear();
    throw InvalidArgument("source", "a str with lone surrogates", "text");
  }
  const std::string all(utf8, static_cast<std::size_t>(size));
  return all.substr(all.find('<'));
}

Chain from_source(const UrdfSource& source, std::optional<std::string> base,
                  std::optional<std::string> tip, const Packages& packages,
                  std::optional<std::string> name) {
  const PackageFolders folders = folders_of(packages);
  const std::optional<std::string> xml = xml_of(source);
  UrdfOptions options{std::move(base).value_or(""), std::move(tip).value_or(""),
                      std::move(name).value_or(""), py::isinstance<py::str>(source)};
  if (xml) {
    const py::gil_scoped_release release;
    return from_urdf(*xml, options);
  }
  const std::string path = path_of(source, "source");
  options.is_utf8 = false;
  const py::gil_scoped_release release;
  return from_urdf_file(path, options, folders);
}

}  // namespace

}  // namespace thing_kin::python

PYBIND11_MODULE(_urdf, m) {
  using namespace thing_kin::python;
  py::module_::import("thing_kin._core");  // brings the type of Chain
  m.doc() = "The URDF reader. Private: use thing_kin.Chain.from_urdf.";
  m.def("from_urdf", &from_source, py::arg("source"), py::arg("base"), py::arg("tip"),
        py::arg("packages"), py::arg("name"), "See thing_kin.Chain.from_urdf.");
}
