#pragma once

#include <memory>
#include <string>

#include "array.hpp"
#include "thing_kin/optimization/term_recipe.hpp"

namespace thing_kin::python {

/// A term of Python functions. What it makes calls them with the interpreter's lock held, from any
/// thread, and throws on what they raise.
class PythonFunction : public TermRecipe {
 public:
  PythonFunction(std::string name, int size, int n, py::object value, py::object jacobian,
                 py::object hessian);

  std::string name() const override { return name_; }
  std::shared_ptr<const Term> bind(const std::shared_ptr<const Chain>& robot) const override;

  int size() const { return size_; }
  int variables() const { return n_; }

 private:
  std::string name_;
  int size_;
  int n_;
  py::object value_, jacobian_, hessian_;
};

}  // namespace thing_kin::python
