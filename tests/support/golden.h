// Compares a picture with the one kept in tests/golden/pictures.
#pragma once

#include <string>

#include "bihive/image/image.h"

namespace bihive::testing {

/// Expects the same pixels as in tests/golden/pictures/<name>.png. On a failure writes <name>.output.png,
/// .reference.png and .difference.png to golden_failures/ in the current folder and names them. With
/// BIHIVE_UPDATE_GOLDEN=1 in the environment (scripts/update_golden) it writes the picture instead, and fails, so that
/// an update never counts as a pass.
void expect_golden(const std::string& name, const Image& image);

}  // namespace bihive::testing
