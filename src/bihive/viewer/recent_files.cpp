#include "bihive/viewer/recent_files.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bihive/base/write_file.h"
#include "bihive/viewer/file_names.h"

namespace bihive {
namespace {

namespace fs = std::filesystem;

// By other programs, or by another window, a file may have gone.
std::vector<std::string> paths_in(const std::string& list) {
  std::vector<std::string> paths;
  const Result<std::string> text = list.empty() ? Result<std::string>(std::string()) : read_file(list);
  if (!text) return paths;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text->find('\n', begin)) != std::string::npos; begin = end + 1) {
    std::string path = text->substr(begin, end - begin);
    std::error_code ignored;
    const bool is_new = std::find(paths.begin(), paths.end(), path) == paths.end();
    if (is_new && paths.size() < RecentFiles::kMost && fs::path(path).is_absolute() &&
        fs::is_regular_file(path, ignored))
      paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace

std::string RecentFiles::usual_list() {
  const char* const state = std::getenv("XDG_STATE_HOME");  // NOLINT(concurrency-mt-unsafe)
  if (state != nullptr && fs::path(state).is_absolute()) return std::string(state) + "/bihive/recent";
  const std::string home = with_home("~");
  return fs::path(home).is_absolute() ? home + "/.local/state/bihive/recent" : "";
}

RecentFiles::RecentFiles(std::string list) : list_(std::move(list)), paths_(paths_in(list_)) {}

void RecentFiles::add(const std::string& path) {
  std::error_code failed;
  const std::string whole = fs::absolute(path, failed).lexically_normal().string();
  if (failed || list_.empty() || whole.find('\n') != std::string::npos || !fs::is_regular_file(whole, failed)) return;
  // Another window may have added some.
  paths_ = paths_in(list_);
  paths_.erase(std::remove(paths_.begin(), paths_.end(), whole), paths_.end());
  paths_.insert(paths_.begin(), whole);
  if (paths_.size() > kMost) paths_.resize(kMost);
  std::string text;
  for (const std::string& one : paths_) text += one + "\n";
  fs::create_directories(fs::path(list_).parent_path(), failed);
  if (!write_file(list_, text)) list_.clear();
}

void RecentFiles::forget() {
  std::error_code ignored;
  if (!list_.empty()) fs::remove(list_, ignored);
  paths_.clear();
}

}  // namespace bihive
