// The spheres of a Spheres object: those of a file, or of arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "bihive/io/read_spheres.h"
#include "bihive/job/picture_options.h"

namespace bihive::python {

/// Immutable, so that pictures and trees may share it.
struct Spheres {
  SphereFile file;
  std::string name;  ///< for messages
};
using SharedSpheres = std::shared_ptr<const Spheres>;

/// The request of arguments such as "--light-points=4"; job/picture_options.h.
PictureRequest request_of(const std::vector<std::string>& words);

/// Adds them to the module.
void bind_spheres(pybind11::module_& module);

}  // namespace bihive::python
