#include "thing_kin/core/simd.hpp"

#include "bindings.hpp"

namespace thing_kin::python {

void bind_simd(py::module_& m) {
  m.def(
      "simd_level", [] { return to_string(simd_level()); },
      R"(Which instructions the kinematics use: 'baseline', 'avx2' or 'avx512'.

The best of this processor, unless use_simd_level() chose another.

Examples
--------
>>> import thing_kin as tk
>>> tk.simd_level() in ("baseline", "avx2", "avx512")
True
)");
  m.def(
      "use_simd_level",
      [](const std::string& level) { use_simd_level(simd_level_from_string(level)); },
      py::arg("level"),
      R"(Choose the instructions that the kinematics use, in all threads.

For comparing results and speeds; all levels agree to a few units in the last place.

Parameters
----------
level : str
    'baseline', 'avx2' or 'avx512'.

Raises
------
ValueError
    If this processor does not have it.

Examples
--------
>>> import thing_kin as tk
>>> best = tk.simd_level()
>>> tk.use_simd_level("baseline")
>>> tk.simd_level()
'baseline'
>>> tk.use_simd_level(best)
)");
}

}  // namespace thing_kin::python
