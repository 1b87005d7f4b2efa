#include "thing_kin/optimization/terms_clearance.hpp"

#include "bindings.hpp"
#include "model/obstacle.hpp"
#include "optimization/term_recipe.hpp"

namespace thing_kin::python {

namespace {

std::vector<std::string> rows(const terms::Clearance& term, const Chain& robot) {
  const Clearances clearances(robot, term.spheres(), term.obstacles());
  std::vector<std::string> texts;
  texts.reserve(static_cast<std::size_t>(clearances.size()));
  for (int i = 0; i < clearances.size(); ++i) {
    texts.push_back(clearances.describe(i));
  }
  return texts;
}

}  // namespace

void bind_terms_clearance(py::module_& m) {
  TermClass<terms::Clearance>(m, "Clearance",
                              R"(How far the robot is from obstacles and from itself, m.

Obstacle by obstacle: of each sphere of the robot, or of the base's reference point if the obstacle
is a Disc. Then of each pair of spheres from each other. Negative where they overlap; for
problem.at_least(tk.terms.Clearance(...), 0.02).

Parameters
----------
spheres : LinkSpheres, optional
    The robot's shape; without it, Discs are all it can meet.
obstacles : sequence of Disc, Sphere, Capsule, Box and HalfSpace
self_collision : bool
    Whether the pairs of `spheres` count.

Raises
------
ValueError
    If an obstacle is none, or there are no spheres to meet it; bound to a robot without the
    spheres' frames, or without a base for a Disc.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> shape = tk.LinkSpheres(robot, [("tool", (0, 0, 0), 0.1)])
>>> term = tk.terms.Clearance(shape, [tk.HalfSpace((0, 0, 1), offset=0.0), tk.Disc((1, 0), 0.4)])
>>> term.rows(robot)
['sphere 0 (tool) and obstacle 0', 'the base and obstacle 1']
>>> term.evaluate(robot, np.zeros(9))[0].round(4)
array([0.5646, 0.6   ])
)")
      .def(py::init([](const std::optional<LinkSpheres>& spheres, const ObstacleList& obstacles,
                       bool self_collision) {
             return terms::Clearance(spheres.value_or(LinkSpheres{}),
                                     read_obstacles(obstacles, "obstacles"), self_collision);
           }),
           py::arg("spheres") = py::none(), py::arg("obstacles") = py::tuple(),
           py::arg("self_collision") = true)
      .def("rows", &rows, py::arg("robot"), R"(What each number is the clearance of, in words.

Parameters
----------
robot : Chain

Returns
-------
list of str

Examples
--------
>>> import thing_kin as tk
>>> term = tk.terms.Clearance(obstacles=[tk.Disc((1, 0), 0.4)])
>>> term.rows(tk.robots.thing())
['the base and obstacle 0']
)")
      .def("__repr__", [](const terms::Clearance& term) {
        return py::str("Clearance({} spheres, {} obstacles, {} pairs)")
            .format(term.spheres().spheres.size(), term.obstacles().size(),
                    term.spheres().pairs.size());
      });
}

}  // namespace thing_kin::python
