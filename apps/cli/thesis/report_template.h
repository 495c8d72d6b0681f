// The files in thesis/report, built into the program.
#pragma once

#include <string_view>

namespace bihive {

/// report.html: places to fill are {{style}}, {{run}}, {{banner}}, {{contents}}, {{fronts}} and {{sections}}.
std::string_view thesis_report_html();
/// report.css: light and dark, desktop and phone.
std::string_view thesis_report_css();
/// claims.json: what the thesis claims, one line a claim, with the findings that decide it.
std::string_view thesis_claims_json();

}  // namespace bihive
