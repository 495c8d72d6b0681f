#include "c_errors.h"

#include <cstdio>

#include "bihive/base/watch.h"

namespace bihive::c {
namespace {

thread_local char error_text[2000] = "";

}  // namespace

int failed(const char* text) noexcept {
  std::snprintf(error_text, sizeof error_text, "%s", text);
  return kFailed;
}

int failed(const Error& error) {
  const int state = failed(error.to_string().c_str());
  return is_cancelled(error) ? kCancelled : state;
}

const char* last_error() noexcept {
  return error_text;
}

}  // namespace bihive::c
