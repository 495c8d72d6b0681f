// Failed system calls.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include "bihive/job/failure.h"

namespace bihive {

/// Fails with kBadInput: "PATH: WHAT: the system's reason for `code`"; a full disk gets a hint.
[[noreturn]] inline void fail_of_system(const std::string& what, const std::string& path, int code) {
  const bool is_full = code == ENOSPC || code == EDQUOT;
  fail({what + ": " + std::strerror(code), path, 0, 0,
        is_full ? "free some space, and run the same again: whole pictures are kept" : "", code});
}

}  // namespace bihive
