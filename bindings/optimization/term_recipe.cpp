#include "thing_kin/optimization/term_recipe.hpp"

#include "bindings.hpp"

namespace thing_kin::python {

void bind_term_recipe(py::module_& terms) {
  py::class_<TermRecipe, std::shared_ptr<TermRecipe>>(
      terms, "Term",
      R"(What objectives and constraints are made of.

A vector function of the configuration with exact first and second derivatives. Says what is to be
computed; a Problem knows of which robot.

Examples
--------
>>> import thing_kin as tk
>>> isinstance(tk.terms.Function(lambda x: x[0], lambda x: [1.0], n=1), tk.terms.Term)
True
)")
      .def_property_readonly("name", &TermRecipe::name, "For messages and traces.");
}

}  // namespace thing_kin::python
