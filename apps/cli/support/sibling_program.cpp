#include "support/sibling_program.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "bihive/job/failure.h"

namespace bihive::cli {

void become_program(const std::string& name, const char* const* arguments, const std::string& hint) {
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string beside = unknown ? "" : (self.parent_path() / name).string();
  char* const* const argv = const_cast<char* const*>(arguments);  // NOLINT: exec*() does not write into them
  if (!beside.empty()) execv(beside.c_str(), argv);
  const int reason = beside.empty() ? ENOENT : errno;
  if (reason == ENOENT) execvp(name.c_str(), argv);
  if (errno != ENOENT) throw Failure{kEnvironment, {std::string(std::strerror(errno)), beside, 0, 0, ""}};
  throw Failure{kEnvironment, {"the program " + name + " is not installed", "", 0, 0, hint}};
}

}  // namespace bihive::cli
