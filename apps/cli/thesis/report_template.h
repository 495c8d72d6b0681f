// The files in thesis/report, built into the program.
#pragma once

#include <string_view>

namespace bihive {

/// report.html: places to fill are {{style}}, {{run}}, {{banner}}, {{contents}} and {{sections}}.
std::string_view thesis_report_html();
/// report.css: light and dark, desktop and phone.
std::string_view thesis_report_css();

}  // namespace bihive
