// The file of a film whose pictures come from Python.
#pragma once

#include <pybind11/pybind11.h>

namespace bihive::python {

/// Defines FilmFile.
void bind_film_files(pybind11::module_& module);

}  // namespace bihive::python
