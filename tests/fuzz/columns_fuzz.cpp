// Every reader of a format with columns, with columns that the input chooses. The first byte chooses the reader, each
// of the next four one part and its column.
#include "read_and_check.h"

namespace {

using namespace bihive;

constexpr const char* kFormats[] = {"XYZ", "LAMMPS dump", "CSV", "NPY",     "NPZ",
                                    "PLY", "PCD",         "VTK", "VTK XML", "NetCDF"};
constexpr std::size_t kChoices = 4;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 + kChoices) return 0;
  ColumnChoice columns;
  for (std::size_t i = 1; i <= kChoices; ++i) fuzz::choose_column(data[i], columns);
  const Format& format = format_named(kFormats[data[0] % std::size(kFormats)]);
  const std::string_view text(reinterpret_cast<const char*>(data) + 1 + kChoices, size - 1 - kChoices);
  fuzz::check_raw(read_bytes(format, text, "fuzz", 0, columns), 0);
  return 0;
}
