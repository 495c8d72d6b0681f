// The value of any setting.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "bihive/math/vec3.h"

namespace bihive {

/// Nothing (JSON's null: no limit, not stated), a flag, a whole number or the position of a choice's name, a number, a
/// text, or a linear colour. A colour may also be a text ("#rrggbb", a name) until the transfer curve is known.
using SettingValue = std::variant<std::monostate, bool, std::int64_t, double, std::string, Vec3d>;

}  // namespace bihive
