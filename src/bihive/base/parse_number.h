// Numbers from text, independent of the locale. The whole text must be the number: nothing before or after it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

/// A decimal number, correctly rounded: "1", "-2.5", "+1e-3", ".5", "nan", "inf", and as Fortran writes it "1.0D+03".
/// Too large gives an infinity.
std::optional<double> parse_double(std::string_view text);

/// A decimal whole number that fits 64 bits, with a sign or without.
std::optional<std::int64_t> parse_int(std::string_view text);

/// In [least, most], or in (least, most) if `open`. Error: the expected and the found text.
Result<double> number_from_text(const std::string& text, double least, double most, bool open = false);
Result<std::int64_t> whole_number_from_text(const std::string& text, std::int64_t least,
                                            std::int64_t most = std::numeric_limits<std::int64_t>::max());

/// Splits at each separator: n separators give n + 1 parts, some of which may be empty.
std::vector<std::string_view> parts_of(std::string_view text, char separator);

/// The numbers between commas; empty if one is none.
std::vector<double> numbers_from_text(std::string_view text);

/// "expected X,Y,Z, found "1,2""
Error unexpected(const std::string& expected, std::string_view found, const std::string& hint = "");

}  // namespace bihive
