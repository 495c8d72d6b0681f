// The reader of CSV and plain text on any bytes.
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bihive::fuzz::read_raw("CSV", data, size);
  return 0;
}
