// Readable numbers.
#pragma once

#include <cstddef>
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
/// "1.5 to 20", with as many digits as tell the ends of a narrow range far from 0 apart: six of its extent.
std::string range_text(double low, double high);

/// The text as one line that is safe for a terminal. Escaped, as "\n", "\x1b" or "\u009b", are: control characters (C0,
/// C1, DEL), line and paragraph separators, marks that change the writing direction, invisible characters (of zero
/// width, tags, soft hyphens), and bytes that are not UTF-8. The two joiners stay, because scripts need them.
std::string escaped(std::string_view text);
/// The same for a text of several lines: newlines and tabs stay.
std::string escaped_lines(std::string_view text);
/// The same with one '?' for each such character or byte, so that columns still count.
std::string masked(std::string_view text);
/// The text as one line without such characters and bytes: each run of blanks and of what is left out is one blank,
/// none is at the ends. A longer text ends in "…" before its byte `most_bytes`, which is at least 8.
std::string one_line(std::string_view text, std::size_t most_bytes);

}  // namespace bihive
