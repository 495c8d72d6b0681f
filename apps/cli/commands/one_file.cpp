#include "commands/one_file.h"

#include <fmt/format.h>

#include "bihive/image/html_text.h"
#include "server/page_files.h"

namespace bihive::cli {
namespace {

// An empty element that web/src/one_file.ts looks up by its id; its text is ASCII.
std::string place(const std::string& id) {
  return fmt::format(R"(<script id="{}" type="text/plain"></script>)", id);
}

bool is_gzip(const std::string& bytes) {
  return bytes.compare(0, 2, "\x1f\x8b") == 0;
}

std::string filled(const std::string& id, const std::string& name, const std::string& bytes) {
  const std::string small = is_gzip(bytes) ? "" : packed_by_gzip(bytes);
  const bool is_smaller = !small.empty() && small.size() < bytes.size();
  return fmt::format(R"(<script id="{}" type="text/plain" data-name="{}"{}>{}</script>)", id, escape_html(name),
                     is_smaller ? R"( data-packing="gzip")" : "", base64(is_smaller ? small : bytes));
}

}  // namespace

Result<std::string> one_file_with(const std::string& page, const OneFileData& data) {
  const std::string places = place("page_state") + "\n" + place("page_file") + "\n" + place("page_trajectory");
  const std::size_t at = page.find(places);
  if (at == std::string::npos) return Error{"this page is of another version", "", 0, 0, "run make web"};
  const auto with = [](const std::string& id, const std::string& name, const std::string& bytes) {
    return name.empty() ? place(id) : filled(id, name, bytes);
  };
  return page.substr(0, at) + filled("page_state", "", data.state) + "\n" +
         with("page_file", data.file_name, data.file) + "\n" +
         with("page_trajectory", data.trajectory_name, data.trajectory) + page.substr(at + places.size());
}

}  // namespace bihive::cli
