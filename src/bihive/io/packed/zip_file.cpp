#include "bihive/io/packed/zip_file.h"

#include <cstdint>

#include "bihive/base/memory.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/text/text_scanner.h"

#if BIHIVE_HAS_ZLIB
#include <zlib.h>
#endif

namespace bihive {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kEndMark = "PK\5\6"sv, kEntryMark = "PK\1\2"sv, kMemberMark = "PK\3\4"sv;
constexpr std::string_view kWideEndMark = "PK\6\6"sv, kWidePlaceMark = "PK\6\7"sv;
constexpr std::size_t kMostMembers = 10000;

std::uint64_t number_in(std::string_view bytes, std::size_t place, std::size_t size) {
  return bits_at(bytes.data() + place, size, false);
}

// The sizes and the place of an entry that do not fit 32 bits stand in its extra field of kind 1.
bool take_wide(std::string_view extra, std::uint64_t& size, std::uint64_t& packed, std::uint64_t& place) {
  while (extra.size() >= 4) {
    const std::uint64_t kind = number_in(extra, 0, 2), length = number_in(extra, 2, 2);
    if (length > extra.size() - 4) return false;
    std::string_view values = extra.substr(4, length);
    extra.remove_prefix(4 + length);
    if (kind != 1) continue;
    for (std::uint64_t* const target : {&size, &packed, &place}) {
      if (*target != 0xffffffff) continue;
      if (values.size() < 8) return false;
      *target = number_in(values, 0, 8);
      values.remove_prefix(8);
    }
  }
  return true;
}

}  // namespace

Result<std::vector<ZipMember>> zip_members(std::string_view bytes, const std::string& file) {
  const auto bad = [&file](const std::string& what) { return Error{"the zip archive " + what, file, 0, 0, ""}; };

  // The end of the directory stands at the end of the archive, behind it a comment of up to 64 kB.
  const std::size_t end = bytes.rfind(kEndMark);
  if (end == std::string_view::npos || bytes.size() - end < 22) return bad("is cut: it has no directory");
  std::uint64_t count = number_in(bytes, end + 10, 2), at = number_in(bytes, end + 16, 4);
  if (end >= 20 && bytes.substr(end - 20, 4) == kWidePlaceMark) {
    const std::uint64_t wide = number_in(bytes, end - 20 + 8, 8);
    if (wide > bytes.size() || bytes.size() - wide < 56 || bytes.substr(wide, 4) != kWideEndMark)
      return bad("is damaged: its directory has no end");
    count = number_in(bytes, wide + 32, 8);
    at = number_in(bytes, wide + 48, 8);
  }
  if (count > kMostMembers) return bad("has more than 10,000 members");

  std::vector<ZipMember> members;
  std::uint64_t packed_total = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (at > bytes.size() || bytes.size() - at < 46 || bytes.substr(at, 4) != kEntryMark)
      return bad("is damaged: its directory ends too early");
    const std::string_view entry = bytes.substr(at);
    const std::uint64_t flags = number_in(entry, 8, 2), method = number_in(entry, 10, 2);
    std::uint64_t packed = number_in(entry, 20, 4), size = number_in(entry, 24, 4), place = number_in(entry, 42, 4);
    const std::uint64_t name = number_in(entry, 28, 2), extra = number_in(entry, 30, 2), more = number_in(entry, 32, 2);
    if (name + extra + more > entry.size() - 46 || !take_wide(entry.substr(46 + name, extra), size, packed, place))
      return bad("is damaged: its directory ends too early");
    ZipMember member;
    member.name = printable(entry.substr(46, name));
    member.size = size;
    member.method = static_cast<int>(method);
    if (flags & 1) return bad("is encrypted");
    if (place > bytes.size() || bytes.size() - place < 30 || bytes.substr(place, 4) != kMemberMark)
      return bad("is damaged: " + quote(member.name) + " is not where the directory says");
    const std::uint64_t begin = place + 30 + number_in(bytes, place + 26, 2) + number_in(bytes, place + 28, 2);
    if (begin > bytes.size() || packed > bytes.size() - begin) return bad("is cut inside of " + quote(member.name));
    if ((packed_total += packed) > bytes.size()) return bad("is damaged: its members lie in each other");
    member.packed = bytes.substr(begin, packed);
    members.push_back(member);
    at += 46 + name + extra + more;
  }
  return members;
}

Result<std::string> unpack_member(const ZipMember& member, const std::string& file) {
  const auto bad = [&](const std::string& what) {
    return Error{"the member " + quote(member.name) + " of the zip archive " + what, file, 0, 0, ""};
  };
  if (member.method == 0) {
    if (member.packed.size() != member.size) return bad("has another length than the directory says");
    return std::string(member.packed);
  }
  if (member.method != 8) return bad("is packed in a way that is not read (" + std::to_string(member.method) + ")");
#if BIHIVE_HAS_ZLIB
  // Deflate packs at most a thousandfold.
  if (member.size / 1100 > member.packed.size()) return bad("is damaged");
  if (Status status = check_memory(double(member.size), "what is packed in it"); !status)
    return bad(status.error().message);
  if (member.size >= 0xffffffff || member.packed.size() >= 0xffffffff)
    return bad("is packed and larger than 4 GB: write it with numpy.savez, which does not pack");
  std::string out(static_cast<std::size_t>(member.size) + 1, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return bad("found no memory left to unpack it");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(member.packed.data()));
  stream.avail_in = static_cast<uInt>(member.packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int state = inflate(&stream, Z_FINISH);
  const bool whole = state == Z_STREAM_END && stream.total_out == member.size;
  inflateEnd(&stream);
  if (!whole) return bad("is damaged");
  out.pop_back();
  return out;
#else
  return bad("is packed, and this build of bihive was made without zlib: write it with numpy.savez");
#endif
}

}  // namespace bihive
