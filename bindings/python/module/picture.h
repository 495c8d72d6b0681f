// Pictures: pixels from spheres or an input, and the arguments of `bihive render`.
#pragma once

#include <pybind11/pybind11.h>

namespace bihive::python {

/// Adds Picture, and render() that makes them, to the module.
void bind_pictures(pybind11::module_& module);

}  // namespace bihive::python
