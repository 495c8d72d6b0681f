// Builds without HDF5: the page, other processors, and where libhdf5-dev is not installed.
#include "bihive/io/formats/arrays/array_file.h"

namespace bihive {

Result<std::shared_ptr<const ArrayFile>> open_hdf5(RandomFile file) {
  return Error{
      "this is an HDF5 file, and this build of bihive has no libhdf5", file.path(), 0, 0,
      "install libhdf5-dev (scripts/setup demo) and build again, or write the data set with h5py and numpy.save "
      "as .npy"};
}

}  // namespace bihive
