#include "server/answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "bihive/base/ascii.h"
#include "bihive/base/parse_number.h"
#include "server/url.h"

namespace bihive::cli {
namespace {

// Allows the page's own scripts, workers and WebAssembly, and pictures that the page makes; forbids everything from
// other origins. Scripts may set styles on elements without permission; style attributes and style elements need it.
constexpr const char* kContentSecurityPolicy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; connect-src 'self' blob:; "
    "img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; font-src 'self'; manifest-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

void add_common_headers(Answer& answer) {
  // Browsers demand the first three for threads with shared memory.
  answer.headers.insert(answer.headers.end(), {{"Cross-Origin-Opener-Policy", "same-origin"},
                                               {"Cross-Origin-Embedder-Policy", "require-corp"},
                                               {"Cross-Origin-Resource-Policy", "same-origin"},
                                               {"Content-Security-Policy", kContentSecurityPolicy},
                                               {"X-Content-Type-Options", "nosniff"},
                                               {"Referrer-Policy", "no-referrer"}});
}

// "gzip", but not "gzip;q=0" or "gzip; q=0.00".
bool accepts_gzip(std::string_view accept_encoding) {
  for (const std::string_view part : parts_of(accept_encoding, ',')) {
    const std::size_t semicolon = std::min(part.find(';'), part.size());
    const std::string_view name = trim(part.substr(0, semicolon));
    if (name != "gzip" && name != "x-gzip" && name != "*") continue;
    const std::string_view quality = trim(part.substr(std::min(semicolon + 1, part.size())));
    return quality.rfind("q=", 0) != 0 || quality.find_first_not_of("0.", 2) != std::string_view::npos;
  }
  return false;
}

bool names_tag(std::string_view if_none_match, const std::string& tag) {
  for (const std::string_view around : parts_of(if_none_match, ',')) {
    std::string_view part = trim(around);
    if (part.starts_with("W/")) part.remove_prefix(2);
    if (part == tag || part == "*") return true;
  }
  return false;
}

struct ByteRange {
  std::uint64_t first, last;  ///< first > last: outside of the file
};

// One range of bytes: "bytes=0-99", "bytes=100-", "bytes=-100". Nothing for requests that may be ignored: other units,
// several ranges, malformed text.
std::optional<ByteRange> range_from(std::string_view text, std::uint64_t size) {
  if (text.rfind("bytes=", 0) != 0) return std::nullopt;
  text = trim(text.substr(6));
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const auto number = [](std::string_view digits, std::uint64_t& value) {
    const char* const end = digits.data() + digits.size();
    const auto [stop, code] = std::from_chars(digits.data(), end, value);
    return code == std::errc() && stop == end;
  };
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  const std::string_view before = text.substr(0, dash);
  const std::string_view after = text.substr(dash + 1);
  if (before.empty()) {
    if (!number(after, last)) return std::nullopt;
    if (last == 0 || size == 0) return ByteRange{1, 0};
    return ByteRange{size - std::min(last, size), size - 1};
  }
  if (!number(before, first)) return std::nullopt;
  if (after.empty())
    last = UINT64_MAX;
  else if (!number(after, last) || last < first)
    return std::nullopt;
  if (first >= size) return ByteRange{1, 0};
  return ByteRange{first, std::min(last, size - 1)};
}

// Answers with the content, with the requested range of it, or with the message that the browser's copy is still right.
Answer send(const Question& question, Content content, const std::string& tag, Answer found) {
  add_common_headers(found);
  found.headers.emplace_back("ETag", tag);
  if (!question.if_none_match.empty() && names_tag(question.if_none_match, tag)) {
    found.status = 304;
    found.send_content = false;
    return found;
  }
  const bool range_counts = question.if_range.empty() || question.if_range == tag;
  if (const auto range = range_from(question.range, content.size); range && range_counts) {
    if (range->first > range->last) {
      Answer outside = refusal(416, "this part is outside of the file");
      outside.headers.emplace_back("Content-Range", fmt::format("bytes */{}", content.size));
      return outside;
    }
    found.status = 206;
    found.headers.emplace_back("Content-Range", fmt::format("bytes {}-{}/{}", range->first, range->last, content.size));
    content.offset = range->first;
    content.size = range->last - range->first + 1;
  }
  found.content = std::move(content);
  return found;
}

Answer send_page_file(const Question& question, const PageFile& file) {
  Answer found;
  // The browser keeps the page, and asks each time whether it is still the same.
  found.headers = {{"Content-Type", file.type}, {"Cache-Control", "no-cache"}, {"Accept-Ranges", "bytes"}};
  if (file.gzip) found.headers.emplace_back("Vary", "Accept-Encoding");
  const bool as_gzip = file.gzip && question.range.empty() && accepts_gzip(question.accept_encoding);
  if (as_gzip) found.headers.emplace_back("Content-Encoding", "gzip");
  const auto& bytes = as_gzip ? file.gzip : file.bytes;
  const std::string tag = '"' + file.tag + (as_gzip ? "-gzip\"" : "\"");
  return send(question, {bytes, nullptr, 0, bytes->size()}, tag, std::move(found));
}

Answer send_named_file(const Question& question, const std::string& path) {
  // The current content: a rewritten file is sent again.
  const auto file = OpenFile::open(path);
  if (!file) return refusal(404, "the file cannot be read any more");
  Answer found;
  found.headers = {
      {"Content-Type", "application/octet-stream"}, {"Cache-Control", "no-cache"}, {"Accept-Ranges", "bytes"}};
  return send(question, {nullptr, *file, 0, (*file)->size()}, '"' + (*file)->version() + '"', std::move(found));
}

Answer answer_get(const Site& site, const Question& question) {
  const std::optional<std::string> path = url_path(question.target);
  if (!path) return refusal(400, "this is no path of a file");
  if (!site.file_url.empty() && *path == site.file_url) return send_named_file(question, site.file_path);
  const auto file = site.page.find(*path == "/" ? "/index.html" : *path);
  if (file == site.page.end()) return refusal(404, "there is no such file");
  return send_page_file(question, file->second);
}

}  // namespace

Answer refusal(int status, const std::string& text) {
  Answer refused;
  refused.status = status;
  refused.headers = {{"Content-Type", "text/plain; charset=utf-8"}, {"Cache-Control", "no-store"}};
  add_common_headers(refused);
  refused.content.bytes = std::make_shared<const std::string>(text + "\n");
  refused.content.size = refused.content.bytes->size();
  return refused;
}

namespace {

Answer answer_whole(const Site& site, const Question& question) {
  // The body was not read, so the following bytes on this connection are not a request.
  const auto last_words = [](Answer refused) {
    refused.close = true;
    return refused;
  };
  if (question.method != "GET" && question.method != "HEAD") {
    Answer refused = refusal(405, "only GET and HEAD are answered");
    refused.headers.emplace_back("Allow", "GET, HEAD");
    return last_words(std::move(refused));
  }
  if (question.has_body) return last_words(refusal(413, "requests have no body here"));
  if (question.hosts.size() != 1) return last_words(refusal(400, "expected one Host header"));
  const std::optional<std::string> host = host_name(question.hosts.front());
  if (!host) return last_words(refusal(400, "the Host header is malformed"));
  if (!site.is_own_host(*host))
    return last_words(refusal(403, "this server answers to the address that it printed, not to " + *host));
  return answer_get(site, question);
}

}  // namespace

Answer answer(const Site& site, const Question& question) {
  Answer said = answer_whole(site, question);
  if (question.method == "HEAD") said.send_content = false;
  return said;
}

}  // namespace bihive::cli
