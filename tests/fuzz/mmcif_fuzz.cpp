// The mmCIF reader on any bytes.
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bihive::fuzz::read_raw("mmCIF", data, size);
  return 0;
}
