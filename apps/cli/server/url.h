// Percent escapes of URLs, and the numeric addresses within them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bihive::cli {

/// Escapes everything except letters, digits and - . _ ~ as %XX.
std::string url_escaped(std::string_view text);

/// The path of a request's target, escapes undone, without query and fragment. Nothing if the target does not begin
/// with '/', or if an escape is broken or means a slash or NUL: no file has such a name.
std::optional<std::string> url_path(std::string_view target);

/// The machine in a Host header, in small letters, a numeric address in its usual spelling, without brackets. Nothing
/// if the header is malformed. "LOCALHOST:8017" is "localhost", "[0:0::1]" is "::1".
std::optional<std::string> host_name(std::string_view header);

}  // namespace bihive::cli
