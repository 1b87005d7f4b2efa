#include <pybind11/stl.h>

#include "localizer_bindings.hpp"

namespace thing_kin::python {

namespace {

Array array_of(const Eigen::Vector3d& v) { return Array(3, v.data()); }
Array array_of(const Eigen::Matrix3d& A) {
  Array out({3, 3});
  write_matrix(A, out.mutable_data());
  return out;
}

double per_measurement(double sum, const NisStatistics& of) {
  return of.count > 0 ? sum / static_cast<double>(of.count) : 0.0;
}

}  // namespace

void bind_localizer_results(py::module_& m) {
  py::class_<BaseEstimate>(m, "BaseEstimate", R"(Where the base is at a time, and how sure that is.

Examples
--------
>>> from thing_kin import estimation as est
>>> est.BaseLocalizer(pose=(1, 2, 0.5), t=0.0).estimate().pose
array([1. , 2. , 0.5])
)")
      .def_readonly("t", &BaseEstimate::t, "Time of the estimate, s.")
      .def_property_readonly(
          "pose", [](const BaseEstimate& e) { return array_of(e.pose); },
          "(3,): x, y, theta in m and rad, theta in (-pi, pi].")
      .def_property_readonly(
          "covariance", [](const BaseEstimate& e) { return array_of(e.covariance); },
          "(3, 3), of the pose, in world axes.")
      .def_property_readonly(
          "twist", [](const BaseEstimate& e) { return array_of(e.twist); },
          R"((3,): vx, vy, omega in the body, m/s and rad/s.

The mean over the stretch that ends at t; zero in what no source measures.)")
      .def_property_readonly(
          "twist_covariance", [](const BaseEstimate& e) { return array_of(e.twist_covariance); },
          "(3, 3), of the twist; zero in what no source measures.")
      .def("__repr__", [](const BaseEstimate& e) {
        return "<BaseEstimate t=" + std::string(py::repr(py::float_(e.t))) + " pose=(" +
               text(e.pose.x()) + ", " + text(e.pose.y()) + ", " + text(e.pose.z()) + ")>";
      });
  py::class_<NisStatistics>(m, "NisStatistics", R"(What a source says of its own covariance.

The normalized innovation squared of its accepted measurements. Where model and covariances are
right, `mean` is `dof` and `within` 0.95; a mean far above says that the source is worse than it
claims, far below that it is better.

Examples
--------
>>> import numpy as np
>>> from thing_kin import estimation as est
>>> localizer = est.BaseLocalizer(covariance=np.eye(3))
>>> localizer.add_pose(0.0, (1.0, 0.0, 0.0), np.eye(3), source="lidar")
True
>>> round(localizer.nis["lidar"].mean, 9), localizer.nis["lidar"].dof
(0.5, 3.0)
)")
      .def_readonly("count", &NisStatistics::count,
                    "Measurements that there was something to compare with.")
      .def_property_readonly(
          "mean", [](const NisStatistics& s) { return per_measurement(s.sum, s); },
          "Mean of the NIS; 0 without measurements.")
      .def_property_readonly(
          "dof",
          [](const NisStatistics& s) { return per_measurement(static_cast<double>(s.dof), s); },
          "Mean number of entries compared: what the mean NIS should be.")
      .def_property_readonly(
          "within",
          [](const NisStatistics& s) { return per_measurement(static_cast<double>(s.within), s); },
          "Share in the central 95 % band.");
}

}  // namespace thing_kin::python
