// NPZ of NumPy: a zip archive of arrays.
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/points/named_arrays.h"
#include "bihive/io/npy.h"
#include "bihive/io/packed/zip_file.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

Result<RawSpheres> read_npz(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  const Result<std::vector<ZipMember>> members = zip_members(bytes, file);
  if (!members) return members.error();

  // Read the arrays of numbers.
  NamedArrays all{
      "NPZ",
      {},
      "",
      "name them when they are written: numpy.savez(FILE, x=..., y=..., z=..., radius=...) or positions=..."};
  double total = 0;
  for (const ZipMember& member : *members) {
    constexpr std::string_view ending = ".npy";
    const std::string_view name = member.name;
    if (name.size() <= ending.size() || name.substr(name.size() - ending.size()) != ending) continue;
    const std::string bare(name.substr(0, name.size() - ending.size()));
    for (const NamedArray& other : all.arrays)
      if (other.name == bare) return Error{"the array " + quote(bare) + " comes twice", file, 0, 0, ""};
    Result<std::string> unpacked = unpack_member(member, file);
    if (!unpacked) return unpacked.error();
    Result<NpyArray> array = parse_npy(*unpacked, file);
    if (array) total += static_cast<double>(array->values.size() * sizeof(double));
    if (Status status = check_memory(total, "its arrays"); !status)
      return Error{status.error().message, file, 0, 0, ""};
    if (!array)
      all.left_out += " " + bare;
    else
      all.arrays.push_back({bare, std::move(array->shape), std::move(array->values)});
  }
  return spheres_of_named_arrays(all, file, choice);
}

}  // namespace

extern constexpr Format kNpz(
    "NPZ", ".npz", Format::kColumns, [](const FileHead& head) { return head.bytes.substr(0, 4) == "PK\x03\x04"; },
    read_npz,
    "the mark of zip | columns x, y, z, or one array of places; stored or packed | r, radius or diameter, else from "
    "distances");

}  // namespace bihive
