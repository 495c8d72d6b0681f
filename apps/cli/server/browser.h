// The user's own browser.
#pragma once

#include <string>

namespace bihive::cli {

/// Asks the desktop, if there is one, to show the address. The result is unknown, and does not matter.
void open_browser(const std::string& url);

}  // namespace bihive::cli
