// Structures compared on a set of spheres.
#pragma once

#include <pybind11/pybind11.h>

namespace bihive::python {

/// Adds the function and the names that it knows to the module.
void bind_comparisons(pybind11::module_& module);

}  // namespace bihive::python
