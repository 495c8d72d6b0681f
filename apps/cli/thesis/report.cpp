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

// A class of CSS and a sign for each verdict. Green is what agrees with the text, and nothing else.
struct Look {
  const char *css_class, *sign;
};
Look look_of(Verdict verdict, ValueKind kind) {
  switch (verdict) {
    case Verdict::agrees:
      if (kind == ValueKind::stated) return {"agrees", "✓"};
      return kind == ValueKind::inferred ? Look{"inferred", "≈"} : Look{"check", "="};
    case Verdict::differs:
      return {"differs", "✗"};
    case Verdict::undecided:
      return {"undecided", "?"};
    case Verdict::text_inconsistent:
      return {"inconsistent", "⚡"};
    case Verdict::none:
      break;
  }
  return {"", ""};
}

// The state of a section in words, and its class.
struct State {
  std::string css_class, text;
};

State state_of(const ReportSection& section) {
  const VerdictCounts counts = count_verdicts(section.section);
  std::vector<std::string> parts;
  const auto add = [&](Verdict verdict, ValueKind kind, const std::string& words) {
    const Look look = look_of(verdict, kind);
    parts.push_back(fmt::format("<span class=\"part {}\"><span class=\"sign\">{}</span> {}</span>", look.css_class,
                                look.sign, words));
  };
  const int stated = counts.stated.all();
  if (counts.stated.differs > 0)
    add(Verdict::differs, ValueKind::stated, fmt::format("{} of {} differ", counts.stated.differs, stated));
  if (counts.stated.agrees > 0)
    add(Verdict::agrees, ValueKind::stated, fmt::format("{} of {} agree", counts.stated.agrees, stated));
  const int undecided = counts.stated.undecided + counts.inferred.undecided + counts.own_check.undecided;
  if (undecided > 0) add(Verdict::undecided, ValueKind::stated, fmt::format("{} undecided", undecided));
  if (counts.text_inconsistent > 0)
    add(Verdict::text_inconsistent, ValueKind::stated,
        fmt::format("{} where the text contradicts itself", counts.text_inconsistent));
  if (counts.inferred.agrees > 0)
    add(Verdict::agrees, ValueKind::inferred, fmt::format("{} as inferred", counts.inferred.agrees));
  if (counts.inferred.differs > 0)
    add(Verdict::differs, ValueKind::inferred, fmt::format("{} not as inferred", counts.inferred.differs));
  if (counts.own_check.agrees > 0)
    add(Verdict::agrees, ValueKind::own_check, fmt::format("{} own checks hold", counts.own_check.agrees));
  if (counts.own_check.differs > 0)
    add(Verdict::differs, ValueKind::own_check, fmt::format("{} own checks fail", counts.own_check.differs));
  if (!section.missing_steps.empty())
    parts.push_back("<span class=\"sign\">–</span> incomplete: " + steps_text(section.missing_steps.size()) +
                    " missing");
  if (parts.empty()) return {"open", "<span class=\"sign\">–</span> nothing to compare"};

  State state{"open", fmt::format("{}", fmt::join(parts, "; "))};
  if (counts.stated.differs + counts.inferred.differs + counts.own_check.differs > 0)
    state.css_class = "differs";
  else if (!section.missing_steps.empty())
    state.css_class = "open";
  else if (counts.text_inconsistent > 0)
    state.css_class = "inconsistent";
  else if (undecided > 0)
    state.css_class = "undecided";
  else if (counts.stated.agrees > 0)
    state.css_class = "agrees";
  else if (counts.inferred.agrees > 0)
    state.css_class = "inferred";
  else
    state.css_class = "check";
  return state;
}

// A sign beside the colour, with its word for screen readers.
std::string sign_of(const Cell& cell) {
  if (cell.verdict == Verdict::none) return "";
  const Look look = look_of(cell.verdict, cell.kind);
  return fmt::format(" <span class=\"sign {0}\" role=\"img\" aria-label=\"{1}\" title=\"{1}\">{2}</span>",
                     look.css_class, words_of(cell.verdict, cell.kind), look.sign);
}

// The worst cell is the row's: what differs, then where the text is inconsistent, then what is undecided.
const Cell* worst_of(const std::vector<Cell>& row) {
  const auto rank = [](const Cell& cell) {
    switch (cell.verdict) {
      case Verdict::differs:
        return 4;
      case Verdict::text_inconsistent:
        return 3;
      case Verdict::undecided:
        return 2;
      case Verdict::agrees:
        return 1;
      case Verdict::none:
        break;
    }
    return 0;
  };
  const auto worst =
      std::max_element(row.begin(), row.end(), [&](const Cell& a, const Cell& b) { return rank(a) < rank(b); });
  return worst == row.end() || rank(*worst) == 0 ? nullptr : &*worst;
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
  if (cell.verdict != Verdict::none) add(look_of(cell.verdict, cell.kind).css_class);
  if (number) add("number");
  if (cell.text.size() > kLongCell) add("long");
  const std::string content = class_attribute(classes) + ">" + escape_html(cell.text) + sign_of(cell);
  return first ? "<th scope=\"row\"" + content + "</th>" : "<td" + content + "</td>";
}

// `links` and `row_classes` belong to the rows of a front table; both may be empty.
std::string table_html(const Table& table, const char* heading, const std::vector<std::string>& links = {},
                       const std::vector<std::string>& row_classes = {}) {
  std::string head;
  std::vector<bool> numbers;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    numbers.push_back(is_number_column(table, c));
    head += fmt::format("<th scope=\"col\"{}>{}</th>", class_attribute(numbers[c] ? "number" : ""),
                        escape_html(table.columns[c]));
  }
  if (!links.empty()) head += "<th scope=\"col\">Where</th>";
  std::string rows;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::vector<Cell>& row = table.rows[r];
    const Cell* const worst = worst_of(row);
    std::string classes = worst == nullptr ? "" : look_of(worst->verdict, worst->kind).css_class;
    if (r < row_classes.size()) classes = row_classes[r];
    rows += "<tr" + class_attribute(classes) + ">";
    for (std::size_t c = 0; c < row.size(); ++c) rows += cell_html(row[c], c == 0, c < numbers.size() && numbers[c]);
    if (r < links.size()) rows += fmt::format("<td><a href=\"#{0}\">{0}</a></td>", escape_html(links[r]));
    rows += "</tr>\n";
  }
  // The box scrolls, so the keyboard must be able to reach it.
  const std::string title = escape_html(table.title);
  return fmt::format(
             "<{3}>{0}</{3}>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table>\n"
             "<thead><tr>{1}</tr></thead>\n<tbody>\n{2}</tbody></table></div>\n",
             title, head, rows, heading) +
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

// The values of one kind with the words behind them.
std::string sentences_of_kind(const Values& values, ValueKind kind, const char* summary) {
  std::string entries;
  int count = 0;
  for (const auto& [name, entry] : values.document()["values"].items()) {
    if (values.kind(name) != kind) continue;
    ++count;
    entries += fmt::format("<dt><code>{}</code> <b>{}</b></dt><dd>{}</dd>\n", escape_html(name),
                           escape_html(values.printed(name)), escape_html(values.sentence(name)));
  }
  if (entries.empty()) return "";
  return fmt::format("<details><summary>{}: {}</summary>\n<dl class=\"sentences {}\">\n{}</dl></details>\n", summary,
                     count, name_of(kind), entries);
}

std::string sentences_html(const Values& values) {
  return sentences_of_kind(values, ValueKind::stated, "Values that the text states, with its sentences") +
         sentences_of_kind(values, ValueKind::inferred,
                           "Values that the text does not state: inferred or chosen by us, with the reasoning") +
         sentences_of_kind(values, ValueKind::own_check, "Values of ours for checks of our own");
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + escape_html(name);
  return text;
}

// Paragraphs, illustrations, tables, then the parts below a heading of their own.
std::string content_html(const Section& section, const std::string& folder) {
  std::string html;
  for (const std::string& paragraph : section.paragraphs) html += "<p>" + escape_html(paragraph) + "</p>\n";
  if (!section.illustrations.empty()) {
    html += section.pairs ? "<div class=\"figures pairs\">\n" : "<div class=\"figures\">\n";
    for (const Illustration& illustration : section.illustrations) html += illustration_html(illustration, folder);
    html += "</div>\n";
  }
  for (const Table& table : section.tables) html += table_html(table, "h4");
  for (const Section& part : section.parts)
    html +=
        "<div class=\"block\">\n<h3>" + escape_html(part.title) + "</h3>\n" + content_html(part, folder) + "</div>\n";
  return html;
}

std::string section_html(const ReportSection& section, const std::string& folder) {
  const State state = state_of(section);
  std::string html = fmt::format("<section id=\"{}\" class=\"{}\">\n<h2>{}</h2>\n<p class=\"state\">{}</p>\n",
                                 escape_html(section.id), state.css_class, escape_html(section.title), state.text);
  if (!section.missing_steps.empty())
    html += fmt::format("<p class=\"missing\">Not done yet ({}): {}</p>\n", steps_text(section.missing_steps.size()),
                        joined(section.missing_steps));
  html += content_html(section.section, folder);
  if (section.values != nullptr) html += sentences_html(*section.values);
  return html + "</section>\n";
}

std::string front_html(const ReportFront& front) {
  std::string html = fmt::format("<section id=\"{}\" class=\"front\">\n<h2>{}</h2>\n", escape_html(front.id),
                                 escape_html(front.title));
  for (const std::string& paragraph : front.paragraphs) html += "<p>" + escape_html(paragraph) + "</p>\n";
  if (!front.table.rows.empty()) html += table_html(front.table, "h3", front.links, front.row_classes);
  return html + "</section>\n";
}

// For a reader, before the first number: a busy machine, missing steps.
std::string banner_html(const ReportHeader& header, const std::vector<ReportSection>& sections) {
  std::string html;
  if (header.load.busy())
    html +=
        "<div class=\"banner busy\" role=\"alert\"><h2>The machine was busy: the times of this run say little</h2>\n"
        "<p>" +
        escape_html(header.load.text()) +
        ". Other work of a machine slows some rounds and not others, so verdicts on times may be wrong or undecided. "
        "Verdicts on trees, counts and memory do not depend on it.</p></div>\n";
  std::string items;
  for (const ReportSection& section : sections)
    if (!section.missing_steps.empty())
      items += fmt::format("<li><a href=\"#{}\">{}</a>: {} missing</li>\n", escape_html(section.id),
                           escape_html(section.title), steps_text(section.missing_steps.size()));
  if (items.empty()) return html;
  return html +
         "<div class=\"banner\" role=\"alert\"><h2>Incomplete: the run was interrupted</h2>\n<p>What is shown was "
         "done before. The same command goes on where it stopped. Missing:</p>\n<ul>\n" +
         items + "</ul></div>\n";
}

std::string run_html(const ReportHeader& header) {
  const Settings& settings = header.settings;
  std::string html = "<dl class=\"run\">\n";
  const auto add = [&](const char* what, const std::string& text) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, escape_html(text));
  };
  add("Command", header.command);
  add("Run", settings.quick ? "quick: everything small" : "full");
  add("Seed", std::to_string(settings.seed));
  add("Threads", settings.threads > 0 ? std::to_string(settings.threads) : "all");
  add("Machine", header.machine);
  add("Its load", header.load.text());
  add("Compiler", header.compiler);
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

}  // namespace

std::string report_html(const ReportHeader& header, const std::vector<ReportFront>& fronts,
                        const std::vector<ReportSection>& sections, const std::string& folder) {
  std::string contents, front, body;
  for (const ReportSection& section : sections) {
    const State state = state_of(section);
    contents += fmt::format("<li class=\"{}\"><a href=\"#{}\">{}</a> <span class=\"state\">{}</span></li>\n",
                            state.css_class, escape_html(section.id), escape_html(section.title), state.text);
    body += section_html(section, folder);
  }
  for (const ReportFront& each : fronts) front += front_html(each);
  return fill(thesis_report_html(), {{"style", std::string(thesis_report_css())},
                                     {"run", run_html(header)},
                                     {"banner", banner_html(header, sections)},
                                     {"contents", contents},
                                     {"fronts", front},
                                     {"sections", body}});
}

}  // namespace bihive::cli::thesis
