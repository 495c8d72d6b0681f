// A value, or the reason why there is none.
//
// The library never prints, exits or throws on bad input: it returns a Result. An Error states the fault, its location
// (file, and line and column if they are known) and the remedy.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "bihive/base/check.h"

namespace bihive {

/// A fault, its location and its remedy. `line` and `column` count from 1; 0 means unknown.
struct Error {
  std::string message;  ///< the fault and the expected value, one line, no final full stop
  std::string file;     ///< the file as the user named it; may be empty
  std::int64_t line = 0;
  std::int64_t column = 0;
  std::string hint;     ///< advice for the user, one line; may be empty
  int system_code = 0;  ///< errno of the system call that failed; 0: none did. `message` has its text

  /// "file:line:column: message; hint" without the unknown parts. Always one line, without control characters
  /// (base/readable.h: escaped()).
  std::string to_string() const;
};

namespace detail {
/// Prints the error, and ends the program.
[[noreturn]] void value_of_failed_result(const Error& error);
}  // namespace detail

/// Either a T or an Error. Asking for the absent one is a programmer's error and ends the program; where the value is
/// absent, it prints the error first.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() {
    if (!ok()) detail::value_of_failed_result(error());
    return *std::get_if<0>(&state_);
  }
  const T& value() const {
    if (!ok()) detail::value_of_failed_result(error());
    return *std::get_if<0>(&state_);
  }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }

  const Error& error() const {
    BIHIVE_CHECK(!ok());
    return *std::get_if<1>(&state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// The value of a Result that only succeeds or fails.
struct Done {};
using Status = Result<Done>;

}  // namespace bihive
