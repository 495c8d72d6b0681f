// The readers of LAMMPS data, POSCAR, XDATCAR, SDF, MOL2, CIF of crystals and PSF on any bytes. The first byte chooses
// the reader and the frame.
#include "read_and_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  constexpr const char* formats[] = {"LAMMPS data", "POSCAR", "XDATCAR", "SDF", "MOL2", "CIF of crystals"};
  // The last bytes chose others before there was PSF, and few inputs begin with them.
  if (size > 0) fuzz::read_raw(data[0] >= 252 ? "PSF" : formats[data[0] / 4 % 6], data, size);
  return 0;
}
