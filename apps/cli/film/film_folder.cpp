#include "film/film_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bihive/base/write_file.h"
#include "film/system_failure.h"
#include "support/failure.h"

namespace bihive::cli {
namespace {

bool exists(const std::string& path) {
  return access(path.c_str(), F_OK) == 0;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

// Whether there is more than what a shard that begins at this moment has made before its plan.
bool holds_something(const std::string& folder) {
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (name != "lock" && name.rfind(".bihive-", 0) != 0) return true;
  }
  return static_cast<bool>(code);
}

}  // namespace

FilmFolder::FilmFolder(std::string output, bool parts)
    : output_(std::move(output)),
      folder_(parts ? part_path(output_) : folder_of(plan_path(output_))),
      plan_(parts ? folder_ + "/film.json" : plan_path(output_)),
      parts_(parts) {
  const bool holds_else = parts && !exists(plan_) && exists(folder_) && holds_something(folder_);
  // Another shard may have written its plan since.
  if (exists(plan_))
    kept_ = read_film_plan(plan_);
  else if (holds_else)
    fail({"is in the place where the film would be made", folder_, 0, 0, "remove it, or name another output"});
}

FilmFolder::~FilmFolder() {
  if (lock_ >= 0) close(lock_);
}

void FilmFolder::take(const FilmPlan& plan, bool alone) {
  if (!folder_.empty() && mkdir(folder_.c_str(), 0777) == 0)
    made_folder_ = folder_;
  else if (!folder_.empty() && errno != EEXIST)
    fail_of_system("cannot be made", folder_, errno);
  if (parts_) lock(alone);
  if (kept_) return;
  value_or_fail(write_file(plan_, film_plan_to_json(plan)));
  made_plan_ = true;
}

// The lock ends with the program, however that ends.
void FilmFolder::lock(bool alone) {
  const std::string path = folder_ + "/lock";
  lock_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) fail_of_system("cannot be written", path, errno);
  if (flock(lock_, (alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  fail({"another run of bihive film works on this film", folder_, 0, 0, "wait for its end, or name another output"});
}

void FilmFolder::finish(const FilmPlan& plan) {
  if (!parts_) return;
  value_or_fail(write_file(plan_path(output_), film_plan_to_json(plan)));
  std::error_code code;
  std::filesystem::remove_all(folder_, code);
}

void FilmFolder::leave_nothing() {
  std::error_code code;
  if (parts_) {
    if (made_plan_) std::filesystem::remove_all(folder_, code);
    return;
  }
  if (made_plan_) unlink(plan_.c_str());
  if (!made_folder_.empty()) rmdir(made_folder_.c_str());
}

}  // namespace bihive::cli
