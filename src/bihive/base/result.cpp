#include "bihive/base/result.h"

#include "bihive/base/readable.h"

namespace bihive {

std::string Error::to_string() const {
  std::string text;
  if (!file.empty()) {
    text += file + ":";
    if (line > 0) text += std::to_string(line) + ":";
    if (line > 0 && column > 0) text += std::to_string(column) + ":";
    text += " ";
  }
  text += message;
  if (!hint.empty()) text += "; " + hint;
  return escaped(text);
}

void detail::value_of_failed_result(const Error& error) {
  check_failed(BIHIVE_FILE_NAME_, __LINE__, "value() of a Result that holds an error: " + error.to_string());
}

}  // namespace bihive
