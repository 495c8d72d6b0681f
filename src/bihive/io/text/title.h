// Titles that files have for people.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

/// The text of a file as a title: one_line() of base/readable.h, of at most 300 bytes. Empty if it has neither a letter
/// nor a digit, as names that some programs write for want of one ("*****").
std::string title_from(std::string_view text);

/// The id of an entry: the same, of at most 40 bytes; also empty for what stands for an unknown one in CIF ("?", ".").
std::string entry_id_from(std::string_view text);

}  // namespace bihive
