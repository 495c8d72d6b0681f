// NPZ of NumPy: a zip archive of arrays.
#include <set>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/points/named_arrays.h"
#include "bihive/io/formats/points/npy_fields.h"
#include "bihive/io/npy.h"
#include "bihive/io/packed/zip_file.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// The name of the array in the member; empty if it holds none.
std::string array_name(const ZipMember& member) {
  constexpr std::string_view kEnding = ".npy";
  const std::string_view name = member.name;
  return std::string(name.ends_with(kEnding) ? name.substr(0, name.size() - kEnding.size()) : "");
}

Result<RawSpheres> read_npz(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  const Result<std::vector<ZipMember>> members = zip_members(bytes, file);
  if (!members) return members.error();

  // Other programs pack their files into such archives too.
  std::string others;
  bool any = members->empty();
  for (const ZipMember& member : *members) {
    any = any || !array_name(member).empty();
    if (others.size() < 200) others += (others.empty() ? "" : ", ") + printable(member.name);
  }
  if (!any)
    return Error{"this is a ZIP archive without arrays of NumPy; it has " + others, file, 0, 0,
                 "unpack it, and take the file with the spheres"};

  // Read the arrays of numbers.
  NamedArrays all{
      "NPZ",
      {},
      "",
      "name them when they are written: numpy.savez(FILE, x=..., y=..., z=..., radius=...) or positions=..."};
  std::set<std::string> names;
  double total = 0;
  for (const ZipMember& member : *members)
    if (!array_name(member).empty() && !names.insert(array_name(member)).second)
      return Error{"the array " + quote(array_name(member)) + " comes twice", file, 0, 0, ""};
  for (const ZipMember& member : *members) {
    const std::string bare = array_name(member);
    if (bare.empty()) continue;
    Result<std::string> unpacked = unpack_member(member, file);
    if (!unpacked) return unpacked.error();
    const std::size_t before = all.arrays.size();
    if (const Result<NpyHeader> header = npy_header(*unpacked, file); header && header->is_structured()) {
      Result<std::vector<NamedArray>> fields = npy_fields(*unpacked, *header, file, all.left_out);
      if (!fields) all.left_out += " " + bare;
      if (fields)
        for (NamedArray& field : *fields) {
          if (!names.insert(field.name).second) field.name = bare + "." + field.name;
          all.arrays.push_back(std::move(field));
        }
    } else if (Result<NpyArray> array = parse_npy(*unpacked, file)) {
      all.arrays.push_back({bare, std::move(array->shape), std::move(array->values)});
    } else {
      all.left_out += " " + bare;
    }
    for (std::size_t i = before; i < all.arrays.size(); ++i)
      total += static_cast<double>(all.arrays[i].values.size() * sizeof(double));
    if (Status status = check_memory(total, "its arrays"); !status)
      return Error{status.error().message, file, 0, 0, ""};
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
