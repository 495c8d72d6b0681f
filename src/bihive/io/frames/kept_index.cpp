#include "bihive/io/frames/kept_index.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "bihive/base/fnv.h"
#include "bihive/base/memory.h"
#include "bihive/io/packed/byte_reader.h"

namespace bihive {
namespace {

// The digit at the end is the version.
constexpr std::string_view kIndexMark = "bihive frames 3\n";
constexpr std::string_view kMarkOfAnyVersion = kIndexMark.substr(0, kIndexMark.size() - 2);
constexpr std::size_t kSumBytes = 8;
constexpr std::size_t kPlaceBytes = 24;

void put(std::string& bytes, std::uint64_t number) {
  for (int k = 0; k < 8; ++k) bytes += static_cast<char>(number >> (8 * k) & 0xff);
}
void put(std::string& bytes, std::int64_t number) {
  put(bytes, static_cast<std::uint64_t>(number));
}

std::array<std::int64_t, 7> head_of(const IndexedFile& file) {
  const FileStamp& stamp = file.stamp;
  return {file.format, file.size, stamp.written_s, stamp.written_ns, stamp.changed_s, stamp.changed_ns, stamp.inode};
}

void put(std::string& bytes, const PlaceList& places) {
  put(bytes, static_cast<std::uint64_t>(places.size()));
  for (const TextPlace& place : places)
    for (const std::int64_t number : {place.begin, place.end, place.lines_before}) put(bytes, number);
}

bool take(ByteReader& reader, PlaceList& places, std::int64_t size) {
  std::uint64_t count = 0;
  if (!reader.take(count) || count > reader.left() / kPlaceBytes) return false;
  TextPlace before;
  for (std::uint64_t i = 0; i < count; ++i) {
    TextPlace place;
    if (!reader.take(place.begin) || !reader.take(place.end) || !reader.take(place.lines_before)) return false;
    if (place.begin < before.end || place.end < place.begin || place.end > size) return false;
    if (place.lines_before < before.lines_before || place.lines_before > place.begin) return false;
    places.push_back(place);
    before = place;
  }
  return true;
}

}  // namespace

std::string kept_index_path(const std::string& path) {
  return path + ".bihive-index";
}

Result<std::optional<std::string>> read_kept_index(const std::string& path) {
  Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW));
  if (!descriptor && errno == ENOENT) return std::optional<std::string>();
  if (!descriptor) return Error{errno == ELOOP ? "is a link" : std::strerror(errno), path, 0, 0, ""};
  struct stat facts = {};
  const bool known = fstat(descriptor.get(), &facts) == 0;
  const RandomFile file = RandomFile::of_descriptor(std::move(descriptor), path);
  if (!known || !S_ISREG(facts.st_mode)) return Error{"is no file", path, 0, 0, ""};
  if (facts.st_uid != geteuid() && facts.st_uid != 0) return Error{"belongs to another user", path, 0, 0, ""};
  if ((facts.st_mode & S_IWOTH) != 0) return Error{"may be written by everybody", path, 0, 0, ""};
  if (Status status = check_memory(static_cast<double>(file.size()), "an index"); !status)
    return Error{status.error().message, path, 0, 0, ""};
  Result<std::string> bytes = file.read(0, file.size());
  if (!bytes) return bytes.error();
  return std::optional<std::string>(std::move(*bytes));
}

std::string encode_index(const FrameIndex& index, const IndexedFile& file) {
  std::string bytes(kIndexMark);
  for (const std::int64_t number : head_of(file)) put(bytes, number);
  for (const std::int64_t number : {index.lines, std::int64_t{index.text_behind}}) put(bytes, number);
  for (const auto* places : {&index.frames, &index.assembly_lines, &index.cell_lines, &index.bond_lines})
    put(bytes, *places);
  put(bytes, fnv1a(bytes));
  return bytes;
}

bool looks_like_index(std::string_view bytes) {
  return bytes.substr(0, kMarkOfAnyVersion.size()) == kMarkOfAnyVersion;
}

std::optional<FrameIndex> decode_index(std::string_view bytes, const IndexedFile& file) {
  if (bytes.size() < kIndexMark.size() + kSumBytes || bytes.substr(0, kIndexMark.size()) != kIndexMark)
    return std::nullopt;
  const std::string_view content = bytes.substr(0, bytes.size() - kSumBytes);
  std::uint64_t sum = 0;
  ByteReader(bytes.substr(content.size()), ByteOrder::little).take(sum);
  if (sum != fnv1a(content)) return std::nullopt;

  ByteReader reader(content.substr(kIndexMark.size()), ByteOrder::little);
  for (const std::int64_t expected : head_of(file)) {
    std::int64_t number = 0;
    if (!reader.take(number) || number != expected) return std::nullopt;
  }
  FrameIndex index;
  std::int64_t text_behind = 0;
  if (!reader.take(index.lines) || !reader.take(text_behind)) return std::nullopt;
  index.text_behind = text_behind != 0;
  for (auto* places : {&index.frames, &index.assembly_lines, &index.cell_lines, &index.bond_lines})
    if (!take(reader, *places, file.size)) return std::nullopt;
  // Frames follow each other without a gap, and each has a line at least.
  std::int64_t end = 0;
  for (const TextPlace& place : index.frames) {
    if (place.begin != end || place.end == place.begin) return std::nullopt;
    end = place.end;
  }
  const bool lines_fit = !index.frames.empty() && index.lines >= index.frames.back().lines_before && index.lines <= end;
  if (!lines_fit || reader.left() != 0) return std::nullopt;
  return index;
}

}  // namespace bihive
