// Numbers from text, independent of the locale. The whole text must be the number: nothing before or after it.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace bihive {

/// A decimal number, correctly rounded: "1", "-2.5", "+1e-3", ".5", "nan", "inf". Too large gives an infinity.
std::optional<double> parse_double(std::string_view text);

/// A decimal whole number that fits 64 bits, with a sign or without.
std::optional<std::int64_t> parse_int(std::string_view text);

}  // namespace bihive
