// The readers of PLY, PCD, VTK, NPZ and NetCDF on any bytes. The first byte chooses the reader and the frame.
#include "bihive/io/formats/arrays/array_frames.h"
#include "read_and_check.h"

namespace {

using namespace bihive;

Result<RawSpheres> read_netcdf(std::string_view bytes, const std::string& name, std::int64_t frame) {
  const Result<std::shared_ptr<const RawFrames>> frames = open_array_frames(RandomFile::of_bytes(bytes, name), "", {});
  if (!frames) return frames.error();
  return (*frames)->read(frame);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr Result<RawSpheres> (*readers[])(std::string_view, const std::string&, std::int64_t) = {
      read_ply, read_pcd, read_vtk_legacy, read_vtk_xml, read_npz, read_netcdf};
  if (size > 0) fuzz::read_raw(readers[data[0] / 4 % 6], data, size);
  return 0;
}
