// Ends the program when it cannot do its task: an exception inside programs, never in the rest of the library.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "bihive/base/result.h"
#include "bihive/base/setting_name.h"

namespace bihive {

enum ExitCode : int {
  kSuccess = 0,
  kBadInput = 1,     ///< bad input, missing folder, unwritable path, full disk
  kBadUsage = 2,     ///< options that are unknown, out of range or contradict each other
  kEnvironment = 3,  ///< a missing device, driver or program
  kInterrupted = 130
};

struct Failure {
  ExitCode code;
  Error error;
  std::string shown{};    ///< further lines after the error's own, each with its end; usually none
  std::string setting{};  ///< the id of the setting whose name begins the message; empty: none
};

[[noreturn]] inline void fail(Error error) {
  throw Failure{kBadInput, std::move(error)};
}
[[noreturn]] inline void fail_usage(const std::string& message, const std::string& hint = "") {
  throw Failure{kBadUsage, Error{message, "", 0, 0, hint}};
}

/// The message is the setting's name and `rest`: "--focus" and ": expected a number".
[[noreturn]] inline void fail_setting(std::string_view id, const std::string& rest, const std::string& hint = "") {
  throw Failure{kBadUsage, Error{setting_name(id) + rest, "", 0, 0, hint}, {}, std::string(id)};
}

[[noreturn]] inline void fail_environment(Error error) {
  throw Failure{kEnvironment, std::move(error)};
}

/// Returns the value, or ends the program with the result's error.
template <class T>
T value_or_fail(Result<T> result) {
  if (!result) fail(result.error());
  return std::move(*result);
}

}  // namespace bihive
