// Answers of the C++ module to JavaScript: JSON texts. After a failure {"error": {"message", "file", "line", "column",
// "hint"}}.
#pragma once

#include <cstdint>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/image/image.h"

namespace bihive::page {

/// Only the module and its worker know this folder of the user's files: answers leave it out.
inline constexpr const char* kFolder = "/files-of-the-user/";

std::string text_of(const nlohmann::ordered_json& json);
nlohmann::ordered_json failure_json(const Error& error);
std::string failure(const Error& error);

/// Lack of memory is the only failure that throws.
template <class Work>
std::string with_memory(const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return failure({"there is not enough memory for this in the browser", "", 0, 0, "try a smaller file or picture"});
  }
}

/// Four bytes each, the last of which is opacity.
std::vector<std::uint8_t> pixels_of(const Image& image);

}  // namespace bihive::page
