#pragma once

// One function a concept; module.cpp calls them in the order of the layers.

#include <pybind11/pybind11.h>

#include "thing_kin/model/chain.hpp"

namespace thing_kin::python {

namespace py = pybind11;

using ChainClass = py::class_<Chain>;

void bind_simd(py::module_& m);

void bind_so3(py::module_& lie);
void bind_se2(py::module_& lie);
void bind_se3(py::module_& lie, py::module_& top);

void bind_singular_value_filter(py::module_& m);
void bind_pseudoinverse(py::module_& m);
void bind_selectively_damped(py::module_& m);
void bind_null_space(py::module_& m);

void bind_dh(py::module_& m);
ChainClass bind_chain(py::module_& m);
void bind_chain_description(ChainClass& chain);
void bind_joint_difference(ChainClass& chain);
void bind_urdf(ChainClass& chain);
void bind_omni_base(py::module_& m);
void bind_obstacle(py::module_& m);
void bind_robots(py::module_& m);

void bind_posture(ChainClass& chain);
void bind_jacobian(ChainClass& chain);
void bind_hessian(ChainClass& chain);
void bind_jacobian_dot(ChainClass& chain);
void bind_acceleration(ChainClass& chain);
void bind_analytic_jacobian(ChainClass& chain);
void bind_manipulability(ChainClass& chain);
void bind_pose_error(py::module_& m);
void bind_task_vector(ChainClass& chain);
void bind_link_spheres(py::module_& m);

void bind_differential_inverse(py::module_& m);
void bind_task(py::module_& m);
void bind_set_task(py::module_& m);
void bind_limits(py::module_& m);
void bind_limited_step(py::module_& m);
void bind_task_priority(py::module_& m);
void bind_closed_form_ik(py::module_& m);
void bind_ik_result(py::module_& m);
void bind_numeric_ik(py::module_& m);

void bind_pose_plan(py::module_& m);
void bind_term_recipe(py::module_& terms);
void bind_terms_pose(py::module_& m);
void bind_terms_orientation_cone(py::module_& m);
void bind_terms_base(py::module_& m);
void bind_terms_clearance(py::module_& m);
void bind_terms_dexterity(py::module_& m);
void bind_terms_joints(py::module_& m);
void bind_function_term(py::module_& terms);
void bind_problem(py::module_& m);
void bind_derivative_check(py::module_& m);
void bind_sqp(py::module_& m);

void bind_path_plan(py::module_& m);
void bind_path_follower(py::module_& m);

}  // namespace thing_kin::python
