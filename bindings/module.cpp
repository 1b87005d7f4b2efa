#include <pybind11/pybind11.h>

#include "bindings.hpp"
#include "thing_kin/core/types.hpp"
#include "thing_kin/core/version.hpp"

PYBIND11_MODULE(_core, m) {
  using namespace thing_kin::python;
  m.doc() = "The C++ core of thing_kin. Private: import its names from thing_kin.";
  m.attr("__version__") = thing_kin::kVersion;
  m.attr("MAX_DOF") = thing_kin::kMaxDof;

  bind_simd(m);

  py::module_ lie =
      m.def_submodule("lie", "Rotations SO(3), planar poses SE(2) and rigid transforms SE(3).");
  bind_so3(lie);
  bind_se2(lie);
  bind_se3(lie, m);

  bind_singular_value_filter(m);
  bind_pseudoinverse(m);
  bind_selectively_damped(m);
  bind_null_space(m);

  bind_dh(m);
  ChainClass chain = bind_chain(m);
  bind_chain_description(chain);
  bind_joint_difference(chain);
  bind_urdf(chain);
  bind_omni_base(m);
  bind_obstacle(m);
  py::module_ robots = m.def_submodule("robots", "The robots of the two theses.");
  bind_robots(robots);

  bind_posture(chain);
  bind_jacobian(chain);
  bind_hessian(chain);
  bind_jacobian_dot(chain);
  bind_acceleration(chain);
  bind_manipulability(chain);
  bind_pose_error(m);
  bind_task_vector(chain);
  bind_analytic_jacobian(chain);
  bind_link_spheres(m);

  bind_differential_inverse(m);
  bind_task(m);
  bind_set_task(m);
  bind_limits(m);
  bind_limited_step(m);
  bind_task_priority(m);
  bind_closed_form_ik(m);
  bind_ik_result(m);
  bind_numeric_ik(m);

  bind_pose_plan(m);
  py::module_ terms = m.def_submodule("terms", "What problems are made of.");
  bind_term_recipe(terms);
  bind_terms_pose(terms);
  bind_terms_orientation_cone(terms);
  bind_terms_base(terms);
  bind_terms_clearance(terms);
  bind_terms_dexterity(terms);
  bind_terms_joints(terms);
  bind_function_term(terms);
  bind_problem(m);
  bind_derivative_check(m);
  bind_sqp(m);
  bind_path_plan(m);
  bind_path_follower(m);
}
