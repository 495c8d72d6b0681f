#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <string_view>

#include "bihive/base/write_file.h"
#include "bihive/image/html_text.h"
#include "statistics.h"
#include "templates.h"

namespace bihive::thesis {
namespace {

namespace must = kainjow::mustache;
using Data = must::data;

// A PNG file begins with 16 bytes of signature and chunk header, then width and height in big-endian order.
constexpr std::size_t kPngWidthAt = 16, kPngHeightAt = 20;
#define BIHIVE_PAIR(letter, title) {letter, title},
constexpr std::pair<const char*, const char*> kSections[] = {BIHIVE_THESIS_SECTIONS(BIHIVE_PAIR)};
#undef BIHIVE_PAIR

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// `caption` is HTML already.
std::string figure_html(const std::string& folder, const std::string& file, const std::string& caption) {
  const Result<std::string> bytes = read_file(folder + "/" + file);
  std::string content;
  if (!bytes)
    content = "<div class=\"absent\">This picture has not been made yet.</div>";
  else if (file.size() > 4 && file.compare(file.size() - 4, 4, ".svg") == 0)
    content = bytes->substr(std::min(bytes->size(), bytes->find("<svg")));
  else if (bytes->size() < kPngHeightAt + 4)
    content = "<div class=\"absent\">This is no PNG file: " + escape_html(file) + "</div>";
  else
    content = fmt::format("<img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">",
                          base64(*bytes), big_endian(*bytes, kPngWidthAt), big_endian(*bytes, kPngHeightAt), caption);
  return "<figure>" + content + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n"), end = text.find_last_not_of(" \n");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

// JSON as Mustache sees it. An object of objects is also there as a list, in its order.
Data data_from(const Json& json) {
  if (json.is_object()) {
    Data object{Data::type::object};
    for (const auto& [key, value] : json.items()) {
      object.set(key, data_from(value));
      const bool of_objects = value.is_object() && !value.empty() &&
                              std::all_of(value.begin(), value.end(), [](const Json& one) { return one.is_object(); });
      if (!of_objects) continue;
      Data rows{Data::type::list};
      for (const auto& [name, one] : value.items()) {
        Data row = data_from(one);
        row.set("key", name);
        rows.push_back(row);
      }
      object.set(key + "_rows", rows);
    }
    return object;
  }
  if (json.is_array()) {
    Data list{Data::type::list};
    for (const Json& one : json) list.push_back(data_from(one));
    return list;
  }
  if (json.is_string()) return json.get<std::string>();
  if (json.is_boolean()) return json.get<bool>() ? Data::type::bool_true : Data::type::bool_false;
  if (json.is_number_float()) return fmt::format("{}", json.get<double>());
  if (json.is_number()) return json.dump();
  return Data::type::bool_false;
}

// Formats the number that the section holds; nothing if it holds none.
template <class Format>
Data number_section(const Format& format) {
  return must::lambda2{[format](const std::string& text, const must::renderer& render) {
    const std::string number = trimmed(render(text, false));
    return number.empty() ? std::string() : format(std::strtod(number.c_str(), nullptr));
  }};
}

std::string filled(std::string_view page, const Json& view, const std::string& folder) {
  Data data = data_from(view);
  for (int decimals = 0; decimals <= 4; ++decimals)
    data.set(fmt::format("f{}", decimals),
             number_section([decimals](double number) { return fmt::format("{:.{}f}", number, decimals); }));
  data.set("grouped", number_section([](double number) { return grouped(std::llround(number)); }));
  data.set("figure", must::lambda2{[folder](const std::string& text, const must::renderer& render) {
             const std::string both = trimmed(render(text, true));
             const std::size_t bar = std::min(both.find('|'), both.size());
             return figure_html(folder, trimmed(both.substr(0, bar)),
                                bar < both.size() ? trimmed(both.substr(bar + 1)) : "");
           }});
  data.set("findings", must::partial{[] { return std::string(thesis_template_findings()); }});
  must::mustache parsed{std::string(page)};
  parsed.set_custom_escape([](const std::string& text) { return escape_html(text); });
  if (!parsed.is_valid()) cli::fail({"a template of the report: " + parsed.error_message(), "", 0, 0, ""});
  return parsed.render(data);
}

std::string_view template_of(const std::string& experiment) {
#define BIHIVE_TEMPLATE(name, id, section, title) \
  if (experiment == id) return thesis_template_##name();
  BIHIVE_THESIS_EXPERIMENTS(BIHIVE_TEMPLATE)
#undef BIHIVE_TEMPLATE
  return {};
}

Json finding_json(const Finding& finding) {
  return {{"name", finding.name},
          {"claim", finding.claim},
          {"row", finding.row},
          {"kind", name_of(finding.kind)},
          {"expected", finding.expected},
          {"ours", finding.ours},
          {"verdict", name_of(finding.verdict)}};
}

Json words_json(const Words& words) {
  return {{"words", words.words}, {"sign", words.sign}, {"css_class", words.css_class}};
}

// What a template of an experiment sees.
Json view_of(const ReportPart& part, const Report& report) {
  Json view = part.data;
  view["quick"] = report.settings.quick;
  view["seed"] = report.settings.seed;
  for (const Finding& finding : part.findings) {
    Json row = finding_json(finding);
    row.update(words_json(words_of(finding.verdict, finding.kind)));
    if (finding.row.empty()) row["row"] = finding.claim;
    view["findings_list"].push_back(std::move(row));
  }
  // What no claim says, but what the run is made with.
  for (const auto& [name, entry] : part.values->document()["values"].items())
    if (!entry.contains("claim"))
      view["choices"].push_back({{"name", name},
                                 {"value", part.values->printed(name)},
                                 {"kind", name_of(part.values->kind(name))},
                                 {"sentence", entry["sentence"]}});
  return view;
}

// How many claims have each verdict.
std::vector<std::pair<Words, int>> counts_of(const std::vector<ReportPart>& parts) {
  std::vector<std::pair<Words, int>> counts;
  for (const ReportPart& part : parts)
    for (const Claim& claim : part.claims) {
      const auto found = std::find_if(counts.begin(), counts.end(), [&](const auto& each) {
        return std::string_view(each.first.words) == claim.words.words;
      });
      if (found == counts.end())
        counts.emplace_back(claim.words, 1);
      else
        ++found->second;
    }
  return counts;
}

Json claim_json(const Claim& claim) {
  return {{"section", claim.section},
          {"claim", claim.claim},
          {"experiment", claim.experiment},
          {"verdict", claim.verdict},
          {"found", claim.found}};
}

Json load_json(const MachineLoad& load) {
  return {{"seconds", load.seconds},
          {"others", load.known ? Json(load.others) : Json()},
          {"most_others", load.known ? Json(load.most_others) : Json()},
          {"busy", load.busy()}};
}

}  // namespace

std::string summary_of(const std::vector<ReportPart>& parts) {
  std::string text;
  for (const auto& [words, count] : counts_of(parts))
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, words.words);
  return text;
}

std::string report_html(const Report& report, const std::string& folder) {
  Json view = report.about;
  view.update({{"style", std::string(thesis_template_css())},
               {"load", report.load.text()},
               {"busy", report.load.busy()},
               {"quick", report.settings.quick},
               {"seed", report.settings.seed},
               {"threads", report.settings.threads > 0 ? std::to_string(report.settings.threads) : "all"},
               {"devices", report.devices},
               {"has_runs", report.devices.contains("runs")},
               {"has_shown", report.devices.contains("shown")}});
  if (!report.against.is_null()) view["against"] = report.against;
  for (const auto& [words, count] : counts_of(report.parts)) {
    Json one = words_json(words);
    one["count"] = count;
    view["counts"].push_back(std::move(one));
  }
  for (const auto& [letter, title] : kSections) {
    Json rows = Json::array();
    for (const ReportPart& part : report.parts)
      for (const Claim& claim : part.claims) {
        if (claim.section != letter) continue;
        Json row = claim_json(claim);
        row.update(words_json(claim.words));
        row["sentence"] = claim.sentence;
        rows.push_back(std::move(row));
      }
    if (!rows.empty()) view["sections"].push_back({{"letter", letter}, {"title", title}, {"rows", std::move(rows)}});
  }
  for (const ReportPart& part : report.parts) {
    std::string key = part.experiment->id;
    std::replace_if(
        key.begin(), key.end(), [](char c) { return c == '-' || c == '.'; }, '_');
    view["of"][key] = part.data;
    Json shown{{"id", part.experiment->id},
               {"title", part.experiment->title},
               {"body", filled(template_of(part.experiment->id), view_of(part, report), folder)}};
    if (!part.missing_steps.empty()) {
      shown["missing"] = {{"count", part.missing_steps.size()},
                          {"steps", fmt::format("{}", fmt::join(part.missing_steps, ", "))}};
      view["incomplete"]["parts"].push_back(shown);
    }
    view["experiments"].push_back(std::move(shown));
  }
  return filled(thesis_template_report(), view, folder);
}

Json results_json(const Report& report) {
  Json experiments = Json::array(), claims = Json::array();
  bool complete = true;
  for (const ReportPart& part : report.parts) {
    complete = complete && part.missing_steps.empty();
    Json findings = Json::array();
    for (const Finding& finding : part.findings) findings.push_back(finding_json(finding));
    experiments.push_back({{"id", part.experiment->id},
                           {"title", part.experiment->title},
                           {"missing_steps", part.missing_steps},
                           {"load", load_json(part.load)},
                           {"findings", std::move(findings)},
                           {"data", part.data}});
    for (const Claim& claim : part.claims) claims.push_back(claim_json(claim));
  }
  const Settings& settings = report.settings;
  Json results{{"bihive_results", 3}};
  results.update(report.about);
  results.update({{"load", load_json(report.load)},
                  {"settings", {{"quick", settings.quick}, {"seed", settings.seed}, {"threads", settings.threads}}},
                  {"complete", complete},
                  {"claims", std::move(claims)},
                  {"experiments", std::move(experiments)}});
  for (const auto& [name, list] : report.devices.items()) results[name == "runs" ? "devices" : "shown_frames"] = list;
  if (!report.against.is_null()) results["against"] = report.against["rows"];
  return results;
}

}  // namespace bihive::thesis
