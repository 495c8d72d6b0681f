#include "bihive/io/data_path.h"

#include <sys/stat.h>

namespace bihive {
namespace {

bool is_there(const std::string& path) {
  struct stat facts = {};
  return stat(path.c_str(), &facts) == 0;
}

}  // namespace

DataPath data_path(const std::string& path) {
  for (std::size_t at = path.find(":/"); at != std::string::npos; at = path.find(":/", at + 1)) {
    if (at == 0 || is_there(path) || !is_there(path.substr(0, at))) continue;
    return {path.substr(0, at), path.substr(at + 1)};
  }
  return {path, ""};
}

}  // namespace bihive
