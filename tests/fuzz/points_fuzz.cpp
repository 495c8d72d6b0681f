// The readers of PLY, PCD, VTK and NPZ on any bytes. The first byte chooses the reader and the frame.
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  constexpr Result<RawSpheres> (*readers[])(std::string_view, const std::string&, std::int64_t) = {
      read_ply, read_pcd, read_vtk_legacy, read_vtk_xml, read_npz};
  if (size > 0) fuzz::read_raw(readers[data[0] / 4 % 5], data, size);
  return 0;
}
