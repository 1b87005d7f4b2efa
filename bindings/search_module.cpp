#include <pybind11/pybind11.h>

#include "search_bindings.hpp"

PYBIND11_MODULE(_search, m) {
  using namespace thing_kin::python;
  m.doc() = "Search. Private: import its names from thing_kin.search and thing_kin.rmma.";

  bind_spiral(m);
  bind_stochastic(m);
  bind_compensation(m);
  bind_covering(m);
  bind_world(m);
  bind_manipulator_arm(m);
  bind_experiment(m);
}
