#include "thesis/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "bihive/base/write_file.h"
#include "bihive/image/html_text.h"
#include "support/failure.h"
#include "thesis/report_template.h"

namespace bihive::cli::thesis {
namespace {

// A cell with more characters than this may be broken into lines.
constexpr std::size_t kLongCell = 32;
// A PNG file begins with 16 bytes of signature and chunk header, then width and height in big-endian order.
constexpr std::size_t kPngWidthAt = 16, kPngHeightAt = 20;

std::string steps_text(std::size_t count) {
  return count == 1 ? "1 step" : fmt::format("{} steps", count);
}

// The words of a section's state, by class: agrees (green), differs (red), open (grey).
struct State {
  std::string css_class, text;
};

State state_of(const ReportSection& section) {
  const Verdicts verdicts = count_verdicts(section.section);
  const int all = verdicts.agree + verdicts.differ;
  const std::string missing =
      section.missing_steps.empty() ? "" : "incomplete: " + steps_text(section.missing_steps.size()) + " missing";
  if (verdicts.differ > 0)
    return {"differs", fmt::format("<span class=\"sign\">✗</span> {} of {} differ{}", verdicts.differ, all,
                                   missing.empty() ? "" : "; " + missing)};
  if (!missing.empty()) return {"open", "<span class=\"sign\">–</span> " + missing};
  if (all == 0) return {"open", "<span class=\"sign\">–</span> nothing to compare"};
  return {"agrees", fmt::format("<span class=\"sign\">✓</span> {} of {} agree", all, all)};
}

const char* name_of(Verdict verdict) {
  return verdict == Verdict::agrees ? "agrees" : verdict == Verdict::differs ? "differs" : "none";
}

// A sign beside the colour, with its word for screen readers.
std::string sign_of(Verdict verdict) {
  if (verdict == Verdict::none) return "";
  return fmt::format(" <span class=\"sign {0}\" role=\"img\" aria-label=\"{0}\" title=\"{0}\">{1}</span>",
                     name_of(verdict), verdict == Verdict::agrees ? "✓" : "✗");
}

// Worst first: a row differs if one of its cells does.
Verdict verdict_of(const std::vector<Cell>& row) {
  Verdict verdict = Verdict::none;
  for (const Cell& cell : row) {
    if (cell.verdict == Verdict::differs) return Verdict::differs;
    if (cell.verdict == Verdict::agrees) verdict = Verdict::agrees;
  }
  return verdict;
}

// A number; a unit or a spread may follow.
bool looks_like_number(const std::string& text) {
  const std::size_t at = text.find_first_not_of("+-");
  return at != std::string::npos && text[at] >= '0' && text[at] <= '9' && text.size() <= kLongCell;
}

std::string class_attribute(const std::string& classes) {
  return classes.empty() ? "" : " class=\"" + classes + "\"";
}

// A column of numbers only is set flush right, so that the digits stand under each other.
bool is_number_column(const Table& table, std::size_t column) {
  bool found = false;
  for (const std::vector<Cell>& row : table.rows) {
    if (column >= row.size() || row[column].text.empty()) continue;
    if (!looks_like_number(row[column].text)) return false;
    found = true;
  }
  return found;
}

std::string cell_html(const Cell& cell, bool first, bool number) {
  std::string classes;
  const auto add = [&](const char* name) { classes += (classes.empty() ? "" : " ") + std::string(name); };
  if (cell.verdict != Verdict::none) add(name_of(cell.verdict));
  if (number) add("number");
  if (cell.text.size() > kLongCell) add("long");
  const std::string content = class_attribute(classes) + ">" + escape_html(cell.text) + sign_of(cell.verdict);
  return first ? "<th scope=\"row\"" + content + "</th>" : "<td" + content + "</td>";
}

std::string table_html(const Table& table) {
  std::string head;
  std::vector<bool> numbers;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    numbers.push_back(is_number_column(table, c));
    head += fmt::format("<th scope=\"col\"{}>{}</th>", class_attribute(numbers[c] ? "number" : ""),
                        escape_html(table.columns[c]));
  }
  std::string rows;
  for (const std::vector<Cell>& row : table.rows) {
    const Verdict verdict = verdict_of(row);
    rows += "<tr" + class_attribute(verdict == Verdict::none ? "" : name_of(verdict)) + ">";
    for (std::size_t c = 0; c < row.size(); ++c) rows += cell_html(row[c], c == 0, c < numbers.size() && numbers[c]);
    rows += "</tr>\n";
  }
  // The box scrolls, so the keyboard must be able to reach it.
  const std::string title = escape_html(table.title);
  return fmt::format(
             "<h3>{0}</h3>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table>\n"
             "<thead><tr>{1}</tr></thead>\n<tbody>\n{2}</tbody></table></div>\n",
             title, head, rows) +
         (table.note.empty() ? "" : "<p class=\"note\">" + escape_html(table.note) + "</p>\n");
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

std::string illustration_html(const Illustration& illustration, const std::string& folder) {
  const std::string caption = escape_html(illustration.caption);
  const Result<std::string> bytes = read_file(folder + "/" + illustration.file);
  std::string content;
  if (!bytes)
    content = "<div class=\"absent\">The picture is missing: " + escape_html(bytes.error().to_string()) + "</div>";
  else if (ends_with(illustration.file, ".svg"))
    content = bytes->substr(std::min(bytes->size(), bytes->find("<svg")));
  else if (bytes->size() < kPngHeightAt + 4)
    content = "<div class=\"absent\">The picture is no PNG file: " + escape_html(illustration.file) + "</div>";
  else
    content = fmt::format("<img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">",
                          base64(*bytes), big_endian(*bytes, kPngWidthAt), big_endian(*bytes, kPngHeightAt), caption);
  return "<figure>" + content + "<figcaption>" + caption + "</figcaption></figure>\n";
}

// The thesis's words, and the values that were chosen where the thesis states none.
std::string sentences_html(const Values& values) {
  std::string entries;
  for (const auto& [name, entry] : values.document()["values"].items())
    entries += fmt::format("<dt><code>{}</code> <b>{}</b> <span class=\"from\">{}</span></dt><dd>{}</dd>\n",
                           escape_html(name), escape_html(values.printed(name)),
                           entry.value("chosen", false) ? "chosen here" : "stated", escape_html(values.sentence(name)));
  if (entries.empty()) return "";
  return "<details><summary>The sentences behind the stated values</summary>\n<dl class=\"sentences\">\n" + entries +
         "</dl></details>\n";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + escape_html(name);
  return text;
}

std::string section_html(const ReportSection& section, const std::string& folder) {
  const State state = state_of(section);
  std::string html = fmt::format("<section id=\"{}\" class=\"{}\">\n<h2>{}</h2>\n<p class=\"state\">{}</p>\n",
                                 escape_html(section.id), state.css_class, escape_html(section.title), state.text);
  if (!section.missing_steps.empty())
    html += fmt::format("<p class=\"missing\">Not done yet ({}): {}</p>\n", steps_text(section.missing_steps.size()),
                        joined(section.missing_steps));
  for (const std::string& paragraph : section.section.paragraphs) html += "<p>" + escape_html(paragraph) + "</p>\n";
  if (!section.section.illustrations.empty()) {
    html += section.section.pairs ? "<div class=\"figures pairs\">\n" : "<div class=\"figures\">\n";
    for (const Illustration& illustration : section.section.illustrations)
      html += illustration_html(illustration, folder);
    html += "</div>\n";
  }
  for (const Table& table : section.section.tables) html += table_html(table);
  if (section.values != nullptr) html += sentences_html(*section.values);
  return html + "</section>\n";
}

std::string banner_html(const std::vector<ReportSection>& sections) {
  std::string items;
  for (const ReportSection& section : sections)
    if (!section.missing_steps.empty())
      items += fmt::format("<li><a href=\"#{}\">{}</a>: {} missing</li>\n", escape_html(section.id),
                           escape_html(section.title), steps_text(section.missing_steps.size()));
  if (items.empty()) return "";
  return "<div class=\"banner\" role=\"alert\"><h2>Incomplete: the run was interrupted</h2>\n<p>What is shown was "
         "done before. The same command goes on where it stopped. Missing:</p>\n<ul>\n" +
         items + "</ul></div>\n";
}

std::string run_html(const ReportHeader& header) {
  const Settings& settings = header.settings;
  std::string html = "<dl class=\"run\">\n";
  const auto add = [&](const char* what, const std::string& text) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, escape_html(text));
  };
  add("Run", settings.quick ? "quick: everything small" : "full");
  add("Seed", std::to_string(settings.seed));
  add("Threads", settings.threads > 0 ? std::to_string(settings.threads) : "all");
  add("Machine", header.machine);
  add("Version", "bihive " + header.version + (header.commit.empty() ? "" : ", commit " + header.commit));
  add("Date", header.date);
  return html + "</dl>";
}

// Each place is filled once, from the front, so that braces in a text are never taken for a place.
std::string fill(std::string_view page, const std::vector<std::pair<std::string, std::string>>& places) {
  std::string filled;
  for (const auto& [name, content] : places) {
    const std::size_t at = page.find("{{" + name + "}}");
    BIHIVE_CHECK(at != std::string_view::npos);
    filled += page.substr(0, at);
    filled += content;
    page.remove_prefix(at + name.size() + 4);
  }
  return filled += page;
}

Json table_json(const Table& table) {
  Json rows = Json::array();
  for (const std::vector<Cell>& row : table.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) cells.push_back({{"text", cell.text}, {"verdict", name_of(cell.verdict)}});
    rows.push_back(std::move(cells));
  }
  return {{"title", table.title}, {"columns", table.columns}, {"rows", std::move(rows)}, {"note", table.note}};
}

}  // namespace

Verdicts count_verdicts(const Section& section) {
  Verdicts verdicts;
  for (const Table& table : section.tables)
    for (const std::vector<Cell>& row : table.rows)
      for (const Cell& cell : row) {
        if (cell.verdict == Verdict::agrees) ++verdicts.agree;
        if (cell.verdict == Verdict::differs) ++verdicts.differ;
      }
  return verdicts;
}

std::string report_html(const ReportHeader& header, const std::vector<ReportSection>& sections,
                        const std::string& folder) {
  std::string contents, body;
  for (const ReportSection& section : sections) {
    const State state = state_of(section);
    contents += fmt::format("<li class=\"{}\"><a href=\"#{}\">{}</a> <span class=\"state\">{}</span></li>\n",
                            state.css_class, escape_html(section.id), escape_html(section.title), state.text);
    body += section_html(section, folder);
  }
  return fill(thesis_report_html(), {{"style", std::string(thesis_report_css())},
                                     {"run", run_html(header)},
                                     {"banner", banner_html(sections)},
                                     {"contents", contents},
                                     {"sections", body}});
}

Json results_json(const ReportHeader& header, const std::vector<ReportSection>& sections) {
  bool complete = true;
  Json experiments = Json::array();
  for (const ReportSection& section : sections) {
    complete = complete && section.missing_steps.empty();
    const Verdicts verdicts = count_verdicts(section.section);
    Json tables = Json::array(), illustrations = Json::array();
    for (const Table& table : section.section.tables) tables.push_back(table_json(table));
    for (const Illustration& illustration : section.section.illustrations)
      illustrations.push_back({{"file", illustration.file}, {"caption", illustration.caption}});
    experiments.push_back({{"id", section.id},
                           {"title", section.title},
                           {"missing_steps", section.missing_steps},
                           {"agree", verdicts.agree},
                           {"differ", verdicts.differ},
                           {"paragraphs", section.section.paragraphs},
                           {"tables", std::move(tables)},
                           {"illustrations", std::move(illustrations)},
                           {"data", section.section.data},
                           {"stated", section.values ? section.values->document()["values"] : Json::object()}});
  }
  const Settings& settings = header.settings;
  return {{"bihive_results", 1},
          {"version", header.version},
          {"commit", header.commit},
          {"machine", header.machine},
          {"date", header.date},
          {"settings", {{"quick", settings.quick}, {"seed", settings.seed}, {"threads", settings.threads}}},
          {"complete", complete},
          {"experiments", std::move(experiments)}};
}

}  // namespace bihive::cli::thesis
