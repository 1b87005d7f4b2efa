#include <pybind11/pybind11.h>

#include "odometry_bindings.hpp"

PYBIND11_MODULE(_odometry, m) {
  using namespace thing_kin::python;
  m.doc() = "LIDAR odometry. Private: import its names from thing_kin.odometry.";

  bind_scan(m);
  bind_scan_matching(m);
  bind_laser_odometry(m);
}
