// decode_index() on any bytes, and on indices that are whole but hold any places: what it accepts covers the file from
// its first byte on, frame after frame.
#include <cstring>

#include "bihive/io/frames/kept_index.h"
#include "read_and_check.h"

namespace {

using namespace bihive;

void check(const std::optional<FrameIndex>& index, const IndexedFile& file) {
  if (!index) return;
  fuzz::require(!index->frames.empty());
  std::int64_t end = 0;
  for (const TextPlace& frame : index->frames) {
    fuzz::require(frame.begin == end && frame.end > frame.begin && frame.end <= file.size);
    fuzz::require(frame.lines_before >= 0 && frame.lines_before <= frame.begin && frame.lines_before <= index->lines);
    end = frame.end;
  }
  for (const auto* places : {&index->assembly_lines, &index->cell_lines, &index->bond_lines})
    for (const TextPlace& place : *places)
      fuzz::require(place.begin >= 0 && place.end >= place.begin && place.end <= file.size);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const IndexedFile file{format_named("XYZ").index_number, 1000, {7, 8, 9, 10, 11}};
  check(decode_index({reinterpret_cast<const char*>(data), size}, file), file);
  if (size < 2) return 0;

  // Numbers of two bytes, so that a few lie in the file; the first says how many places each list has.
  std::size_t at = 1;
  const auto next = [&] {
    std::int16_t number = 0;
    if (at + 2 <= size) std::memcpy(&number, data + at, 2);
    at += 2;
    return std::int64_t{number};
  };
  FrameIndex index;
  index.lines = next();
  const auto fill = [&](PlaceList& places, int count) {
    for (int i = 0; i < count; ++i) {
      const std::int64_t begin = next(), end = next();
      places.push_back({begin, end, next()});
    }
  };
  fill(index.frames, data[0] & 15);
  fill(index.assembly_lines, data[0] >> 4 & 3);
  fill(index.cell_lines, data[0] >> 6);
  fill(index.bond_lines, data[0] >> 5 & 3);
  const std::string written = encode_index(index, file);
  const std::optional<FrameIndex> read = decode_index(written, file);
  check(read, file);
  if (read) fuzz::require(encode_index(*read, file) == written);
  IndexedFile other = file;
  ++other.stamp.changed_ns;
  fuzz::require(!decode_index(written, other));
  return 0;
}
