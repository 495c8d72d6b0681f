// bihive web: serves the page that shows spheres in a browser, or writes it as one file.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "bihive/base/json_text.h"
#include "bihive/base/readable.h"
#include "bihive/base/write_file.h"
#include "bihive/io/reading_settings.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "commands/commands.h"
#include "commands/one_file.h"
#include "commands/shown_state.h"
#include "server/addresses.h"
#include "server/browser.h"
#include "server/http_server.h"
#include "server/page_files.h"
#include "server/url.h"
#include "support/outputs.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

constexpr int kFirstPort = 8017;
constexpr int kPortsTried = 20;

PageFiles load_page() {
  const std::string folder = find_page();
  if (folder.empty())
    throw Failure{kEnvironment,
                  {"this bihive was built without the page", "", 0, 0, "run make web where it was built"}};
  Result<PageFiles> page = read_page(folder);
  if (!page) throw Failure{kEnvironment, page.error()};
  return std::move(*page);
}

// How the input is read, in the page's words: radii are numbers (web/src/link.ts). The trajectory is part of the
// source.
ordered_json reading_of(const InputOptions& input) {
  const ReadOptions& options = input.reading.options();
  ordered_json reading = *json_from_text<ordered_json>(reading_to_json(input.reading));
  reading.erase("trajectory");
  if (reading.contains("radius")) reading["radius"] = *options.radius;
  if (reading.contains("radius_scale")) reading["radius_scale"] = options.radius_scale;
  return reading;
}

// The first state of the page, where the user asks for one; else the page's own.
void put_state(const ViewOptions& options, ordered_json& start) {
  if (options.input.seed)
    fail_usage("the page's scenarios have the seed 1", "write the scene into a file by bihive scene");
  if (options.input.count) start["source"]["count"] = *options.input.count;
  if (const ordered_json reading = reading_of(options.input); !reading.empty()) start["source"]["reading"] = reading;
  start["settings"] = settings_to_show(options, /*with_side=*/true);
  start["look"] = look_to_show(options);
}

// The page as one file, with the input inside.
void write_one_file(const WebOptions& options) {
  const InputOptions& input = options.shown.input;
  if (input.input == kStandardStream)
    fail_usage("the page keeps the name of its file, which the standard input has not", "name a file");
  check_outputs({options.html}, {input.input, input.reading.options().trajectory}, /*are_text=*/true);
  OneFileData data;
  ordered_json start;
  if (is_built_in_scene(input.input)) {
    start["source"]["built_in"] = input.input;
  } else {
    // Read the input now, so that errors appear here and not when somebody opens the page.
    const std::string& trajectory = input.reading.options().trajectory;
    if (const Input loaded = load_input(input, LooksOfFile::keep); loaded.files.size() > (trajectory.empty() ? 0 : 1))
      fail_usage(input.input + " needs " + loaded.files.front() + " beside it, and the page holds one file",
                 "name the file of the spheres, with options for the rest");
    data.file = read_input(input.input);
    data.file_name = std::filesystem::path(input.input).filename().string();
    start["source"]["file"] = data.file_name;
    if (!trajectory.empty()) {
      data.trajectory = read_input(trajectory);
      data.trajectory_name = std::filesystem::path(trajectory).filename().string();
      start["source"]["trajectory"] = data.trajectory_name;
    }
  }
  put_state(options.shown, start);
  data.state = start.dump();

  const std::string folder = find_page();
  const Result<std::string> page = read_file(folder + "/one_file.html");
  if (folder.empty() || !page)
    throw Failure{
        kEnvironment,
        {"this bihive was built without the page that is one file", "", 0, 0, "run make web where it was built"}};
  const Result<std::string> filled = one_file_with(*page, data);
  if (!filled) throw Failure{kEnvironment, filled.error()};
  if (const Status status = write_file(output_path(options.html), *filled); !status) fail(status.error());
  print_report(
      fmt::format("{}: {} bytes; it opens without a network\n", escaped(options.html), grouped(filled->size())),
      {options.html});
}

// Everything that can be fetched: the page, the file, and the page's first input (start.json).
Site site_of(const WebOptions& options) {
  if (!options.shown.input.reading.options().trajectory.empty())
    fail_usage("the page opens a trajectory that is dropped on it with its file",
               "or put both into one page by --html, or see bihive view");
  Site site;
  ordered_json start = ordered_json::object();
  const std::string& input = options.shown.input.input;
  if (is_built_in_scene(input)) {
    start["source"]["built_in"] = input;
  } else if (!input.empty()) {
    if (input == kStandardStream)
      fail_usage("the page fetches its file whenever it is opened, so the standard input cannot be one", "name a file");
    value_or_fail(OpenFile::open(input));
    const std::filesystem::path path = std::filesystem::absolute(input);
    const std::string name = path.filename().string();
    site.file_path = path.string();
    site.file_url = "/file/" + name;
    start["source"]["url"] = "file/" + url_escaped(name);
  }
  if (!options.shown.given.empty()) put_state(options.shown, start);
  site.page = load_page();
  site.page["/start.json"] = make_page_file("start.json", start.dump() + "\n");

  // The page of another site may point its own name to this machine's address (DNS rebinding), but it cannot choose the
  // Host header.
  site.is_own_host = [bound = options.bind](const std::string& host) {
    if (host == "localhost" || is_loopback(host) || host == bound) return true;
    if (!is_every_address(bound)) return false;
    for (const std::string& own : own_addresses(/*with_ipv6=*/true))
      if (host == own) return true;
    return false;
  };
  return site;
}

std::vector<int> ports_to_try(const std::optional<std::int64_t>& wanted) {
  if (wanted) return {static_cast<int>(*wanted)};
  std::vector<int> ports(kPortsTried);
  std::iota(ports.begin(), ports.end(), kFirstPort);
  return ports;
}

// The page's addresses; the one of this machine comes first.
std::vector<std::string> urls_of(const std::string& bound, int port) {
  if (!is_every_address(bound)) return {page_url(bound, port)};
  std::vector<std::string> urls{page_url("127.0.0.1", port)};
  for (const std::string& address : own_addresses(bound == "::")) urls.push_back(page_url(address, port));
  return urls;
}

bool is_page_alone(const WebOptions& options) {
  const std::string& input = options.shown.input.input;
  return input.empty() || is_built_in_scene(input);
}

void say_where(const WebOptions& options, const std::vector<std::string>& urls, int port) {
  if (!is_loopback(options.bind))
    warn("everyone who can reach this machine can open the page" +
         std::string(is_page_alone(options) ? "" : " and fetch the file") +
         "; from other machines, without https, browsers give the page one thread only");
  if (options.json) {
    print(ordered_json{{"url", urls.front()}, {"port", port}, {"urls", urls}}.dump() + "\n");
  } else {
    for (const std::string& url : urls) print(url + "\n");
    print("Ctrl-C ends it.\n");
  }
  finish_output();
}

}  // namespace

void run_web(const WebOptions& asked) {
  WebOptions options = asked;
  take_request_to_show(options.shown, /*of_page=*/true);
  if (!options.shown.given.empty() || !options.html.empty()) {
    if (options.shown.input.input.empty()) options.shown.input.input = "demo";
    check_shown(options.shown);
  }
  if (!options.html.empty()) return write_one_file(options);
  const Site site = site_of(options);
  HttpServer server([&site](const Question& question) { return answer(site, question); });
  const int port = value_or_fail(server.listen(options.bind, ports_to_try(options.port)));
  const std::vector<std::string> urls = urls_of(options.bind, port);
  say_where(options, urls, port);
  if (options.browser) open_browser(urls.front());
  server.run_until_signal();
}

}  // namespace bihive::cli
