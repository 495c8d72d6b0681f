// Measures of the union of spheres.
#pragma once

#include <pybind11/pybind11.h>

namespace bihive::python {

/// Adds them to the module.
void bind_measures(pybind11::module_& module);

}  // namespace bihive::python
