// Every reader of a format with columns, with columns that the input chooses. The first byte chooses the reader, each
// of the next four one part and its column.
#include "bihive/io/formats/arrays/array_frames.h"
#include "read_and_check.h"

namespace {

using namespace bihive;

Result<RawSpheres> read_xyz_columns(std::string_view text, const std::string& name, std::int64_t frame,
                                    const ColumnChoice& columns) {
  FramePass pass{frame};
  pass.columns = columns;
  return read_xyz(TextScanner(text, name), pass);
}

Result<RawSpheres> read_dump_columns(std::string_view text, const std::string& name, std::int64_t frame,
                                     const ColumnChoice& columns) {
  FramePass pass{frame};
  pass.columns = columns;
  return read_lammps_dump(TextScanner(text, name), pass);
}

Result<RawSpheres> read_netcdf_columns(std::string_view bytes, const std::string& name, std::int64_t frame,
                                       const ColumnChoice& columns) {
  const Result<std::shared_ptr<const RawFrames>> frames =
      open_array_frames(RandomFile::of_bytes(bytes, name), "", columns);
  if (!frames) return frames.error();
  return (*frames)->read(frame);
}

using ColumnReader = Result<RawSpheres> (*)(std::string_view, const std::string&, std::int64_t, const ColumnChoice&);
constexpr ColumnReader kReaders[] = {read_xyz_columns, read_dump_columns,  read_csv, read_npy,
                                     read_npz,         read_ply,           read_pcd, read_vtk_legacy,
                                     read_vtk_xml,     read_netcdf_columns};
constexpr std::size_t kChoices = 4;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 + kChoices) return 0;
  ColumnChoice columns;
  for (std::size_t i = 1; i <= kChoices; ++i) fuzz::choose_column(data[i], columns);
  const ColumnReader reader = kReaders[data[0] % std::size(kReaders)];
  const std::string_view text(reinterpret_cast<const char*>(data) + 1 + kChoices, size - 1 - kChoices);
  fuzz::check_raw(reader(text, "fuzz", 0, columns), 0);
  return 0;
}
