// The readers of LAMMPS data, POSCAR, XDATCAR, SDF, MOL2 and CIF of crystals on any bytes. The first byte chooses the
// reader and the frame.
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  constexpr Result<RawSpheres> (*readers[])(std::string_view, const std::string&, std::int64_t) = {
      read_lammps_data, read_poscar, read_xdatcar, read_sdf, read_mol2, read_small_cif};
  if (size > 0) fuzz::read_raw(readers[data[0] / 4 % 6], data, size);
  return 0;
}
