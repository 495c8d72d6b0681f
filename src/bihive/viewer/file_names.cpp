#include "bihive/viewer/file_names.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace bihive {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool begins_with(const std::string& name, const std::string& begin) {
  return name.size() >= begin.size() &&
         std::equal(begin.begin(), begin.end(), name.begin(), [](char a, char b) { return lower(a) == lower(b); });
}

// Where the last name begins.
std::size_t last_name(const std::string& typed) {
  const std::size_t slash = typed.rfind('/');
  return slash == std::string::npos ? 0 : slash + 1;
}

}  // namespace

std::string with_home(const std::string& path) {
  if (path != "~" && !path.starts_with("~/")) return path;
  const char* const home = std::getenv("HOME");
  return home == nullptr || *home == '\0' ? path : home + path.substr(1);
}

std::vector<FileName> matching_files(const std::string& typed, std::size_t most) {
  if (typed == "~") return {{"~", true}};
  const std::size_t begin = last_name(typed);
  const std::string folder = begin == 0 ? "." : with_home(typed.substr(0, begin)), wanted = typed.substr(begin);
  std::vector<FileName> found;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, std::filesystem::directory_options::skip_permission_denied, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!begins_with(name, wanted) || (name.starts_with('.') && !wanted.starts_with('.'))) continue;
    std::error_code ignored;
    found.push_back({name, entry->is_directory(ignored)});
  }
  std::sort(found.begin(), found.end(), [](const FileName& a, const FileName& b) {
    return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
  });
  if (found.size() > most) found.resize(most);
  return found;
}

std::string with_last_name(const std::string& typed, const FileName& last) {
  return typed.substr(0, last_name(typed)) + last.name + (last.is_folder ? "/" : "");
}

std::string completed(const std::string& typed, const std::vector<FileName>& matches) {
  if (matches.empty()) return typed;
  if (matches.size() == 1) return with_last_name(typed, matches.front());
  std::string common = matches.front().name;
  for (const FileName& match : matches) {
    std::size_t same = 0;
    while (same < common.size() && same < match.name.size() && common[same] == match.name[same]) ++same;
    common.resize(same);
  }
  // A character of UTF-8 stays whole.
  const std::string& longer = matches.front().name;
  const auto is_cut = [&] { return (static_cast<unsigned char>(longer[common.size()]) & 0xC0) == 0x80; };
  while (!common.empty() && common.size() < longer.size() && is_cut()) common.pop_back();
  // Names that differ in the case of letters may agree in less than is typed.
  const std::size_t begin = last_name(typed);
  return common.size() < typed.size() - begin ? typed : typed.substr(0, begin) + common;
}

}  // namespace bihive
