// Text and bytes in the form that HTML and SVG need.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

/// With & < > " ' escaped: safe as an element's text and inside a quoted attribute.
std::string escape_html(std::string_view text);

/// RFC 4648 [RFC4648], with padding.
std::string base64(std::string_view bytes);

}  // namespace bihive
