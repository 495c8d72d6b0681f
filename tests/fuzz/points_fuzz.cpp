// The readers of PLY, PCD, VTK, NPZ and NetCDF on any bytes. The first byte chooses the reader and the frame.
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  constexpr const char* formats[] = {"PLY", "PCD", "VTK", "VTK XML", "NPZ", "NetCDF"};
  if (size > 0) fuzz::read_raw(formats[data[0] / 4 % 6], data, size);
  return 0;
}
