// The user's own browser.
#pragma once

#include <string>

namespace bihive::cli {

/// Asks the desktop, where there is one, to show the address. Whether it does is not known, and does not matter.
void open_browser(const std::string& url);

}  // namespace bihive::cli
