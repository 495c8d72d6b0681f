// Numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace bihive {

/// 4096 as "4,096".
std::string grouped(std::int64_t value);
/// 1536 as "1.54 kB"; powers of 1000.
std::string readable_bytes(double bytes);
/// 0.1 as "0.1", 1e20 as "1e+20"; at most six digits, and a decimal point whatever the locale.
std::string readable_number(double value);

}  // namespace bihive
