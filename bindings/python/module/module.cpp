// The module _bihive: the library for the Python package in ../bihive, which names things and checks arguments.

#include <pybind11/pybind11.h>

#include <string>

#include "bihive/base/version.h"
#include "bihive/simd/target.h"
#include "compare.h"
#include "errors.h"
#include "film_file.h"
#include "measures.h"
#include "picture.h"
#include "spheres.h"
#include "tree.h"

namespace py = pybind11;

PYBIND11_MODULE(_bihive, module) {
  module.doc() = "The compiled part of the package bihive.";
  bihive::python::translate_failures();
  bihive::python::bind_spheres(module);
  bihive::python::bind_pictures(module);
  bihive::python::bind_trees(module);
  bihive::python::bind_film_files(module);
  bihive::python::bind_measures(module);
  bihive::python::bind_comparisons(module);
  module.def("check_environment", [] { bihive::python::value_of(bihive::check_target_environment()); });
  module.def("target", [] { return std::string(bihive::active_target()); });
  module.attr("__version__") = std::string(bihive::version());
}
