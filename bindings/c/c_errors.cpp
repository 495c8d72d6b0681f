#include "c_errors.h"

#include <cstdio>

namespace bihive::c {
namespace {

thread_local char error_text[2000] = "";

}  // namespace

int fail(const char* text) noexcept {
  std::snprintf(error_text, sizeof error_text, "%s", text);
  return kFailed;
}

int fail(const Error& error) {
  return fail(error.to_string().c_str());
}

const char* last_error() noexcept {
  return error_text;
}

}  // namespace bihive::c
