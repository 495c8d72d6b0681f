#include "support/write_together.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bihive/base/write_file.h"
#include "support/failure.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

// A new file beside its path that waits for the others.
struct Aside {
  std::string path;     // its final path
  std::string waiting;  // its present path
  mode_t mode;          // of the file that it replaces; 0 = there is none
};

bool is_special(const std::string& path) {
  struct stat info {};
  return stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
}

Aside aside_of(const std::string& path) {
  char target[PATH_MAX];
  struct stat info {};
  Aside aside{realpath(path.c_str(), target) != nullptr ? std::string(target) : path, "", 0};
  if (stat(aside.path.c_str(), &info) == 0) aside.mode = info.st_mode & 07777;
  aside.waiting = aside.path + "." + std::to_string(getpid()) + ".part";
  return aside;
}

void remove_waiting(const std::vector<Aside>& files) {
  for (const Aside& file : files) unlink(file.waiting.c_str());
}

}  // namespace

void write_together(const std::vector<FileToWrite>& files) {
  for (const FileToWrite& file : files)
    if (const Status status = check_writable(file.path); !status) fail(status.error());

  // Write the regular files beside their paths.
  const WritingSection section;
  std::vector<Aside> waiting;
  const auto give_up = [&](Error error, const std::string& path) {
    remove_waiting(waiting);
    error.file = path;
    fail(std::move(error));
  };
  for (const FileToWrite& file : files) {
    if (is_special(file.path)) continue;
    const Aside aside = aside_of(file.path);
    if (const Status status = write_file(aside.waiting, file.bytes); !status) give_up(status.error(), file.path);
    waiting.push_back(aside);
    if (aside.mode != 0) chmod(aside.waiting.c_str(), aside.mode);
  }

  // Write the files that a rename cannot replace, then rename the others.
  for (const FileToWrite& file : files)
    if (is_special(file.path))
      if (const Status status = write_file(file.path, file.bytes); !status) give_up(status.error(), file.path);
  for (const Aside& file : waiting)
    if (std::rename(file.waiting.c_str(), file.path.c_str()) != 0)
      give_up({std::string("cannot be replaced: ") + std::strerror(errno), "", 0, 0, ""}, file.path);
}

}  // namespace bihive::cli
