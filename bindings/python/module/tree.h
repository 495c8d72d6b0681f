// Trees that answer what rays of arrays hit.
#pragma once

#include <pybind11/pybind11.h>

namespace bihive::python {

/// Adds Tree to the module.
void bind_trees(pybind11::module_& module);

}  // namespace bihive::python
