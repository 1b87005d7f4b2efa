#include "thing_kin/model/urdf_writer.hpp"

#include <optional>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "model/urdf_source.hpp"

namespace thing_kin::python {

namespace {

// urdfdom is in an extension of its own, loaded when the first URDF is read.
Chain from_urdf(const UrdfSource& source, const std::optional<std::string>& base,
                const std::optional<std::string>& tip, const Packages& packages,
                const std::optional<std::string>& name) {
  try {
    const py::module_ urdf = py::module_::import("thing_kin._urdf");
    return urdf.attr("from_urdf")(source, base, tip, packages, name).cast<Chain>();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ImportError)) {
      throw;
    }
    py::raise_from(error, PyExc_ImportError,
                   "thing_kin was built without urdfdom, or one of its libraries is missing; on "
                   "Debian install liburdfdom-dev and libexpat1-dev, then build with "
                   "-DTHING_KIN_URDF=ON (the default)");
    throw py::error_already_set();
  }
}

}  // namespace

void bind_urdf(ChainClass& chain) {
  chain.def_static("from_urdf", &from_urdf, py::arg("source"), py::arg("base") = py::none(),
                   py::arg("tip") = py::none(), py::arg("packages") = py::none(),
                   py::arg("name") = py::none(), R"(Chain between two links of a URDF.

Its frames are the links from base to tip, its joints the revolute, continuous and prismatic ones
between them, in that order, with any axis and origin. Where the way leads up to a common ancestor
first, joints are run through backwards; they keep the sign of q and their limits.

A velocity limit that is absent, zero or negative means unlimited, and so does any limit of the
largest double. Efforts, soft limits, inertias, meshes and what is not on the chain are not read.

Parameters
----------
source : path, str or bytes
    A file, `package://name/rest`, or the XML itself: bytes, or a str that begins with '<'.
base, tip : str, optional
    Names of links; default: the root, and the only leaf below the base.
packages : mapping from str to path, optional
    Folders of ROS packages by name; others are looked for in ROS_PACKAGE_PATH and
    AMENT_PREFIX_PATH.
name : str, optional
    Of the chain; default: the robot's.

Returns
-------
Chain

Raises
------
ValueError
    If there is no such file, the text is no URDF, it leaves base or tip open, a joint of the chain
    mimics another, is planar or floating or has a limit or axis that is none, or there are none or
    more than 32 joints.
ImportError
    If thing_kin was built without urdfdom.

Examples
--------
>>> import thing_kin as tk
>>> arm = tk.Chain.from_urdf('''
... <robot name="turntable">
...   <link name="floor"/> <link name="plate"/>
...   <joint name="turn" type="continuous">
...     <parent link="floor"/> <child link="plate"/>
...     <origin xyz="0 0 0.2"/> <axis xyz="0 0 1"/>
...   </joint>
... </robot>''')
>>> arm.names, arm.joint_types, arm.frames
(('turn',), ('continuous',), ('floor', 'plate'))
)");
  chain.def(
      "to_urdf",
      [](const Chain& c, const std::optional<std::string>& name) {
        return to_urdf(c, name.value_or(""));
      },
      py::arg("name") = py::none(), R"(The chain as the text of a URDF: joints, limits and frames.

Chain.from_urdf gives its kinematics back to rounding. Each frame is a link of its name; where a
joint's frame is not on its axis, as in most Denavit-Hartenberg rows, there is one more link,
'<frame>_joint'. A URDF cannot say everything: q is in the order of the joints from the root
outwards, acceleration limits are left out, a base is three joints like any others, and a revolute
joint without limits becomes continuous. Other infinite limits are written as the largest double.

Parameters
----------
name : str, optional
    Of the robot; default: the chain's.

Returns
-------
str

Raises
------
ValueError
    If a name has control characters, which XML cannot hold.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> ur5 = tk.robots.ur5()
>>> again = tk.Chain.from_urdf(ur5.to_urdf())
>>> again.names == ur5.names, np.allclose(again.fk(np.ones(6)), ur5.fk(np.ones(6)), atol=1e-14)
(True, True)
)");
}

}  // namespace thing_kin::python
