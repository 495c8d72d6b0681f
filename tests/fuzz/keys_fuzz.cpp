// parse_camera_keys() on any bytes: keys that are written and read again the same, or an error of one line.
#include <string_view>

#include "bihive/io/text/text_scanner.h"
#include "bihive/scene/camera_path.h"
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  const auto keys = parse_camera_keys({reinterpret_cast<const char*>(data), size}, "fuzz.json");
  if (!keys) {
    fuzz::require(!keys.error().message.empty() && printable(keys.error().message) == keys.error().message);
    return 0;
  }
  const std::string written = camera_keys_to_json(*keys);
  const auto again = parse_camera_keys(written, "fuzz.json");
  fuzz::require(again.ok() && camera_keys_to_json(*again) == written);
  return 0;
}
