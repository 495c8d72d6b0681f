#include "report.h"

namespace bihive::cli::thesis {

std::string report_html(const ReportHeader&, const std::vector<ReportSection>&, const std::string&) {
  return "";
}

Json results_json(const ReportHeader&, const std::vector<ReportSection>&) {
  return Json::object();
}

}  // namespace bihive::cli::thesis
