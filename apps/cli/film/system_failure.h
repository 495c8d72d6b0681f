// A call of the system that failed.
#pragma once

#include <cstring>
#include <string>

#include "support/failure.h"

namespace bihive::cli {

/// Fails with kBadInput: "PATH: WHAT: the system's reason for `code`".
[[noreturn]] inline void fail_of_system(const std::string& what, const std::string& path, int code) {
  fail({what + ": " + std::strerror(code), path, 0, 0, ""});
}

}  // namespace bihive::cli
