// Requests to the server of `bihive web` from any bytes: parsed as the server parses them, answered without sockets.
#include <unistd.h>

#include <boost/beast/http.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "engines.h"
#include "server/answer.h"
#include "server/url.h"

namespace {

namespace http = boost::beast::http;
using namespace bihive;
using bihive::fuzz::demand;

constexpr std::uint64_t kFileBytes = 1000;

std::string text_of(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

// A page of two files, and FILE of a thousand bytes.
cli::Site make_site() {
  cli::Site site;
  site.page["/index.html"] = cli::make_page_file("/index.html", "<html>" + std::string(5000, 'x'));
  site.page["/assets/a b.js"] = cli::make_page_file("/assets/a b.js", "js");
  site.file_url = "/file/a b.pdb";
  site.file_path =
      (std::filesystem::temp_directory_path() / ("bihive_http_fuzz_" + std::to_string(::getpid()))).string();
  std::ofstream(site.file_path) << std::string(kFileBytes, 'p');
  site.is_own_host = [](const std::string& host) {
    return host == "localhost" || host == "127.0.0.1" || host == "::1";
  };
  return site;
}

// The file goes with the program.
struct OwnSite {
  cli::Site site = make_site();
  ~OwnSite() {
    std::error_code ignored;
    std::filesystem::remove(site.file_path, ignored);
  }
};

cli::Question question_from(const http::request_parser<http::empty_body>& parser) {
  const auto& request = parser.get();
  cli::Question question;
  question.method = text_of(request.method_string());
  question.target = text_of(request.target());
  const auto hosts = request.equal_range(http::field::host);
  for (auto host = hosts.first; host != hosts.second; ++host) question.hosts.push_back(text_of(host->value()));
  question.accept_encoding = text_of(request[http::field::accept_encoding]);
  question.if_none_match = text_of(request[http::field::if_none_match]);
  question.if_range = text_of(request[http::field::if_range]);
  question.range = text_of(request[http::field::range]);
  question.has_body = !parser.is_done();
  return question;
}

void check(const cli::Site& site, const cli::Question& question, const cli::Answer& answer) {
  const int known[] = {200, 206, 304, 400, 403, 404, 405, 413, 416};
  demand(std::find(std::begin(known), std::end(known), answer.status) != std::end(known));
  for (const auto& [name, value] : answer.headers) {
    demand(!name.empty() && name.find_first_of("\r\n: ") == std::string::npos);
    demand(value.find_first_of("\r\n") == std::string::npos);
  }
  // No byte outside of what there is.
  const cli::Content& content = answer.content;
  if (content.bytes)
    demand(content.offset <= content.bytes->size() && content.size <= content.bytes->size() - content.offset);
  if (content.file) demand(content.offset <= kFileBytes && content.size <= kFileBytes - content.offset);
  demand(!(content.bytes && content.file));

  // Content for GET alone, for this machine's names alone, and for what is there.
  if (answer.status != 200 && answer.status != 206) {
    demand(!content.file);
    return;
  }
  demand(question.method == "GET" || question.method == "HEAD");
  if (question.method == "HEAD") demand(!answer.send_content);
  demand(question.hosts.size() == 1);
  const auto host = cli::host_name(question.hosts[0]);
  demand(host && site.is_own_host(*host));
  const auto path = cli::url_path(question.target);
  demand(path.has_value());
  demand(!content.file || *path == site.file_url);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const OwnSite own;
  http::request_parser<http::empty_body> parser;
  parser.header_limit(16 * 1024);
  parser.eager(false);
  boost::system::error_code code;
  parser.put(boost::asio::buffer(data, size), code);
  if (code && code != http::error::need_more) return 0;
  if (!parser.is_header_done()) return 0;
  const cli::Question question = question_from(parser);
  const cli::Answer answer = cli::answer(own.site, question);
  check(own.site, question, answer);
  demand(cli::answer(own.site, question).status == answer.status);
  return 0;
}
