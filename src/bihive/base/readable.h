// Numbers as people read them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace bihive {

/// 4096 as "4,096".
std::string grouped(std::int64_t value);
/// 1536 as "1.54 kB"; powers of 1000.
std::string readable_bytes(double bytes);
/// 0.1 as "0.1", 1e20 as "1e+20"; at most six digits, and a decimal point whatever the locale.
std::string readable_number(double value);

/// The text as one line that is safe for a terminal. Control characters (C0, C1, DEL), line and paragraph separators,
/// marks that turn the direction of writing, and bytes that are no UTF-8 are written out: "\n", "\x1b", "\u009b".
std::string escaped(std::string_view text);

}  // namespace bihive
