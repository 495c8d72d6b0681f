// The XYZ reader on any bytes.
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bihive::fuzz::read_raw("XYZ", data, size);
  return 0;
}
