#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>

#include "bihive/base/readable.h"
#include "bihive/base/write_file.h"
#include "bihive/image/html_text.h"
#include "claims.h"
#include "machine_load.h"

namespace bihive::thesis {
namespace {

namespace must = kainjow::mustache;
using Data = must::data;

#define BIHIVE_PAIR(letter, title) {letter, title},
constexpr std::pair<const char*, const char*> kSections[] = {BIHIVE_THESIS_SECTIONS(BIHIVE_PAIR)};
#undef BIHIVE_PAIR

// `caption` is HTML already.
std::string figure_html(const std::string& folder, const std::string& file, const std::string& caption) {
  const Result<std::string> bytes = read_file(folder + "/" + file);
  std::string content;
  if (!bytes)
    content = "<div class=\"absent\">This picture has not been made yet.</div>";
  else if (file.ends_with(".svg"))
    content = bytes->substr(std::min(bytes->size(), bytes->find("<svg")));
  else
    content = fmt::format("<img src=\"data:image/png;base64,{}\" alt=\"{}\">", base64(*bytes), caption);
  return "<figure>" + content + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n"), end = text.find_last_not_of(" \n");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

// JSON as Mustache sees it: an empty text is false. An object of objects is also there as a list, in its order.
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
  if (json.is_string() && json != "") return json.get<std::string>();
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
  if (!parsed.is_valid()) fail({"a template of the report: " + parsed.error_message(), "", 0, 0, ""});
  return parsed.render(data);
}

// The data of an experiment's template.
Json view_of(const Experiment& part) {
  Json view = part.data;
  view["quick"] = part.settings.quick;
  view["seed"] = part.settings.seed;
  for (Json row : part.findings) {
    row.update(words_of(row));
    if (row["row"] == "") row["row"] = row["claim"];
    view["findings_list"].push_back(std::move(row));
  }
  // Facts about the run beyond the claims.
  for (const auto& [name, entry] : part.values.document()["values"].items())
    if (!entry.contains("claim"))
      view["choices"].push_back({{"name", name},
                                 {"value", part.values.printed(name)},
                                 {"kind", entry["kind"]},
                                 {"sentence", entry["sentence"]}});
  return view;
}

// How many claims have each verdict: words_of(), with a "count".
Json counts_of(const Report& report) {
  Json counts = Json::object();
  for (const Experiment& part : report.parts)
    for (const Json& claim : part.claims) {
      Json& one = counts[claim["words"].get<std::string>()];
      if (one.is_null()) one = words_of(claim["verdict"].get<std::string>());
      one["count"] = one.value("count", 0) + 1;
    }
  return Json::array_t(counts.begin(), counts.end());
}

}  // namespace

Json Report::load() const {
  double most = -1;
  for (const Experiment& part : parts) most = std::max(most, part.others);
  return {{"most_others", most < 0 ? Json() : Json(most)}, {"busy", most > kBusy}};
}

std::string summary_of(const Report& report) {
  std::string text;
  for (const Json& one : counts_of(report))
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", one["count"].get<int>(), one["words"].get<std::string>());
  return text;
}

std::string report_html(const Report& report, const std::string& folder) {
  const Json load = report.load();
  Json view = report.about;
  view.update(
      {{"style", std::string(thesis_template_css())},
       {"busy", load["busy"]},
       {"others_percent", load["most_others"].is_null() ? Json() : Json(100 * load["most_others"].get<double>())},
       {"quick", report.settings.quick},
       {"seed", report.settings.seed},
       {"threads", report.settings.threads > 0 ? std::to_string(report.settings.threads) : "all"},
       {"devices", report.devices},
       {"has_runs", report.devices.contains("runs")},
       {"has_shown", report.devices.contains("shown")},
       {"counts", counts_of(report)}});
  for (const auto& [letter, title] : kSections) {
    Json rows = Json::array();
    for (const Experiment& part : report.parts)
      for (const Json& claim : part.claims) {
        if (claim["section"] != letter) continue;
        rows.push_back(claim);
        if (claim["css_class"] != "unlike" && claim["css_class"] != "differs") continue;
        // Its reason stands in that list.
        view["not_found"]["rows"].push_back(claim);
        rows.back()["found"] = claim["numbers"];
      }
    if (!rows.empty()) view["sections"].push_back({{"letter", letter}, {"title", title}, {"rows", std::move(rows)}});
  }
  for (const Experiment& part : report.parts) {
    std::string key = part.id;
    std::replace_if(
        key.begin(), key.end(), [](char c) { return c == '-' || c == '.'; }, '_');
    view["of"][key] = part.data;
    Json shown{{"id", part.id}, {"title", part.title}, {"body", filled(part.page, view_of(part), folder)}};
    if (const std::vector<std::string> missing = part.missing_steps(); !missing.empty()) {
      shown["missing"] = {{"count", missing.size()}, {"steps", fmt::format("{}", fmt::join(missing, ", "))}};
      view["incomplete"]["parts"].push_back(shown);
    }
    view["experiments"].push_back(std::move(shown));
  }
  return filled(thesis_template_report(), view, folder);
}

Json results_json(const Report& report) {
  Json experiments = Json::array(), claims = Json::array();
  bool complete = true;
  for (const Experiment& part : report.parts) {
    const std::vector<std::string> missing = part.missing_steps();
    complete = complete && missing.empty();
    experiments.push_back({{"id", part.id},
                           {"title", part.title},
                           {"missing_steps", missing},
                           {"findings", part.findings},
                           {"data", part.data}});
    for (const Json& claim : part.claims)
      for (Json& one = claims.emplace_back();
           const char* const key : {"section", "claim", "experiment", "verdict", "found"})
        one[key] = claim[key];
  }
  const Settings& settings = report.settings;
  Json results{{"bihive_results", 4}};
  results.update(report.about);
  results.update({{"load", report.load()},
                  {"settings", {{"quick", settings.quick}, {"seed", settings.seed}, {"threads", settings.threads}}},
                  {"complete", complete},
                  {"claims", std::move(claims)},
                  {"experiments", std::move(experiments)}});
  for (const auto& [name, list] : report.devices.items()) results[name == "runs" ? "devices" : "shown_frames"] = list;
  return results;
}

}  // namespace bihive::thesis
