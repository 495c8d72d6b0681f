// The PDB reader on any bytes.
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bihive::fuzz::read_raw("PDB", data, size);
  return 0;
}
