#include "bihive/io/formats/arrays/gsd_file.h"

#include <algorithm>
#include <new>

#include "bihive/base/memory.h"
#include "bihive/io/packed/byte_reader.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::uint64_t kGsdMagic = 0x65DF65DF65DF65DF;
constexpr std::int64_t kGsdHeadBytes = 256;
constexpr std::int64_t kEntryBytes = 32;
constexpr std::int64_t kNameBytes = 64;
// Chunks of more columns are no arrays of particles.
constexpr std::uint32_t kMostColumnsOfChunk = 4096;

// Bytes of a number of each type, from 1 on: whole numbers without a sign, with one, binary32 and binary64.
constexpr std::int64_t kTypeBytes[] = {0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8};
constexpr std::uint8_t kLastType = 10;

template <class T>
void take_all(ByteReader& reader, std::vector<double>& values) {
  for (double& value : values) {
    T stored = 0;
    reader.take(stored);
    value = static_cast<double>(stored);
  }
}

void take_values(std::uint8_t type, ByteReader& reader, std::vector<double>& values) {
  switch (type) {
    case 1:
      return take_all<std::uint8_t>(reader, values);
    case 2:
      return take_all<std::uint16_t>(reader, values);
    case 3:
      return take_all<std::uint32_t>(reader, values);
    case 4:
      return take_all<std::uint64_t>(reader, values);
    case 5:
      return take_all<std::int8_t>(reader, values);
    case 6:
      return take_all<std::int16_t>(reader, values);
    case 7:
      return take_all<std::int32_t>(reader, values);
    case 8:
      return take_all<std::int64_t>(reader, values);
    case 9:
      return take_all<float>(reader, values);
    default:
      return take_all<double>(reader, values);
  }
}

// A text in a field of fixed length.
std::string text_of_field(std::string_view field) {
  return std::string(field.substr(0, field.find('\0')));
}

}  // namespace

bool GsdFile::looks_like(std::string_view first_bytes) {
  std::uint64_t magic = 0;
  return ByteReader(first_bytes, ByteOrder::little).take(magic) && magic == kGsdMagic;
}

Error GsdFile::damaged(const std::string& what) const {
  return {"the GSD file is damaged: " + what, file_.path(), 0, 0, ""};
}

Result<GsdFile> GsdFile::open(RandomFile file) {
  GsdFile made(std::move(file));
  try {
    if (Status status = made.read_head(); !status) return status.error();
  } catch (const std::bad_alloc&) {
    return Error{no_memory_for("reading it").message, made.path(), 0, 0, ""};
  }
  return made;
}

Status GsdFile::read_head() {
  const Result<std::string> head = file_.read(0, kGsdHeadBytes);
  if (!head) return head.error();
  ByteReader reader(*head, ByteOrder::little);
  std::uint64_t magic = 0, index_place = 0, index_entries = 0, names_place = 0, names_entries = 0;
  std::uint32_t schema_version = 0, version = 0;
  std::string_view application, schema;
  reader.take(magic);
  for (std::uint64_t* number : {&index_place, &index_entries, &names_place, &names_entries}) reader.take(*number);
  reader.take(schema_version);
  reader.take(version);
  reader.take(kNameBytes, application);
  reader.take(kNameBytes, schema);
  schema_ = text_of_field(schema);
  const auto size = static_cast<std::uint64_t>(file_.size());
  if (index_entries > size / kEntryBytes || names_entries > size / kNameBytes || index_place > size ||
      names_place > size)
    return damaged("its index lies outside of it");

  // Names: of fixed length in files of version 1, one after the other in later ones.
  std::vector<std::string> names;
  const Result<std::string> list =
      file_.read(static_cast<std::int64_t>(names_place), static_cast<std::int64_t>(names_entries) * kNameBytes);
  if (!list) return list.error();
  if (version >> 16 < 2) {
    for (std::size_t at = 0; at < list->size() && (*list)[at] != '\0'; at += kNameBytes)
      names.push_back(text_of_field(std::string_view(*list).substr(at, kNameBytes)));
  } else {
    for (std::size_t at = 0; at < list->size() && (*list)[at] != '\0'; at += names.back().size() + 1)
      names.push_back(text_of_field(std::string_view(*list).substr(at)));
  }

  // The index ends at the first entry without a place.
  const Result<std::string> index =
      file_.read(static_cast<std::int64_t>(index_place), static_cast<std::int64_t>(index_entries) * kEntryBytes);
  if (!index) return index.error();
  ByteReader entries(*index, ByteOrder::little);
  for (std::uint64_t i = 0; i < index_entries; ++i) {
    std::uint64_t frame = 0, rows = 0;
    std::int64_t place = 0;
    std::uint32_t columns = 0;
    std::uint16_t name = 0;
    std::uint8_t type = 0, flags = 0;
    entries.take(frame);
    entries.take(rows);
    entries.take(place);
    entries.take(columns);
    entries.take(name);
    entries.take(type);
    entries.take(flags);
    if (place == 0) break;
    if (name >= names.size()) return damaged("an array has no name");
    if (frame > size || place < 0 || std::uint64_t(place) > size || columns > kMostColumnsOfChunk || type < 1 ||
        type > kLastType || rows > size ||
        rows * columns * std::uint64_t(kTypeBytes[type]) > size - std::uint64_t(place))
      return damaged("the array " + printable(names[name]) + " of frame " + std::to_string(frame) +
                     " lies outside of it");
    chunks_[{names[name], static_cast<std::int64_t>(frame)}] = {static_cast<std::int64_t>(rows), place, columns, type};
    frames_ = std::max(frames_, static_cast<std::int64_t>(frame) + 1);
  }
  return Done{};
}

const GsdFile::Chunk* GsdFile::find(std::int64_t frame, const std::string& name) const {
  auto found = chunks_.find({name, frame});
  if (found == chunks_.end()) found = chunks_.find({name, 0});
  return found == chunks_.end() ? nullptr : &found->second;
}

std::optional<std::int64_t> GsdFile::rows(std::int64_t frame, const std::string& name) const {
  const Chunk* const chunk = find(frame, name);
  if (chunk == nullptr) return std::nullopt;
  return chunk->rows;
}

Result<std::optional<GsdArray>> GsdFile::array(std::int64_t frame, const std::string& name, RowChunk some) const {
  const Chunk* const found = find(frame, name);
  if (found == nullptr) return std::optional<GsdArray>();
  const Chunk& chunk = *found;
  GsdArray made{chunk.rows, chunk.columns, {}};
  const RowRange rows = some.of(chunk.rows);
  const std::int64_t row_bytes = std::int64_t{chunk.columns} * kTypeBytes[chunk.type];
  const std::int64_t count = rows.count() * chunk.columns;
  const Result<std::string> bytes = file_.read(chunk.place + rows.first * row_bytes, rows.count() * row_bytes);
  if (!bytes) return bytes.error();
  made.values.resize(static_cast<std::size_t>(count));
  ByteReader reader(*bytes, ByteOrder::little);
  take_values(chunk.type, reader, made.values);
  return std::optional<GsdArray>(std::move(made));
}

}  // namespace bihive
