// The report's templates, built into the program.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

std::string_view thesis_template_report();      ///< thesis/report/report.html
std::string_view thesis_template_css();         ///< thesis/report/report.css
std::string_view thesis_template_findings();    ///< thesis/report/findings.html
std::string_view thesis_template_figure_4_1();  ///< thesis/figure-4.1/report.html, and so on
std::string_view thesis_template_figure_4_2();
std::string_view thesis_template_figure_4_3();
std::string_view thesis_template_section_d();
std::string_view thesis_template_table_4_2();
std::string_view thesis_template_figure_4_4();
std::string_view thesis_template_figure_4_5();

}  // namespace bihive
