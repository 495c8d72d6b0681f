// How the file of an input is to be read.
#pragma once

#include "bihive/io/read_spheres.h"
#include "support/input.h"

namespace bihive::cli {

ReadOptions read_options(const InputOptions& options);

}  // namespace bihive::cli
