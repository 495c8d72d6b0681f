// The options of periodic cells from text, for command lines.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "bihive/base/result.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The most copies along one vector of a cell.
constexpr std::int32_t kMostCopies = 1000000;

/// "3x3x1": three whole numbers from 1 to kMostCopies. Error: the text is none; the message says what was expected.
Result<std::array<std::int32_t, 3>> copies_from_text(const std::string& text);

/// "AX,AY,AZ,BX,BY,BZ,CX,CY,CZ": three vectors of finite numbers. Errors as above.
Result<std::array<Vec3d, 3>> cell_vectors_from_text(const std::string& text);

/// "X,Y,Z". Errors as above.
Result<Vec3d> cell_origin_from_text(const std::string& text);

}  // namespace bihive
