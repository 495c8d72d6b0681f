#include "bihive/io/packed/unpack.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <new>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/watch.h"
#include "bihive/io/packed.h"
#include "bihive/io/packed/binary_cif.h"
#include "bihive/io/packed/unpackers.h"

#if BIHIVE_HAS_ZLIB
#include <zlib.h>
#endif
#if BIHIVE_HAS_ZSTD
#include <zstd.h>
#endif

namespace bihive {
namespace {

constexpr std::string_view kGzipMark = "\x1f\x8b";

// Growth factor of the unpacked text, and its first capacity in bytes.
constexpr double kGrowth = 1.5;
constexpr double kLeastRoom = 1 << 20;

#if BIHIVE_HAS_ZLIB

// zlib's state; the destructor always ends it.
struct Inflater {
  z_stream stream{};
  bool ready;
  Inflater() {
    constexpr int kGzipOnly = 16;
    ready = inflateInit2(&stream, kGzipOnly + MAX_WBITS) == Z_OK;
  }
  ~Inflater() {
    if (ready) inflateEnd(&stream);
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

// Whether another member follows (true), or padding or nothing (false).
Result<bool> goes_on(std::string& rest, const PieceSource& source, const std::string& name) {
  while (rest.size() < kGzipMark.size()) {
    const Result<std::string_view> piece = source();
    if (!piece) return piece.error();
    if (piece->empty()) break;
    rest += *piece;
  }
  if (std::string_view(rest).substr(0, kGzipMark.size()) == kGzipMark) return true;
  while (rest.find_first_not_of('\0') == std::string::npos) {
    const Result<std::string_view> piece = source();
    if (!piece) return piece.error();
    if (piece->empty()) return false;
    rest = *piece;
  }
  return packed_fault("the gzip data is damaged: something else follows its end mark", name);
}

Status gunzip_pieces(const PieceSource& source, const std::string& name, const PieceSink& sink) {
  Inflater inflater;
  if (!inflater.ready) return packed_fault("there is no memory left to undo gzip", name);
  z_stream& stream = inflater.stream;
  std::string buffer(kUnpackedPieceBytes, '\0'), rest;
  bool at_end = false;
  for (;;) {
    if (stream.avail_in == 0 && !at_end) {
      const Result<std::string_view> piece = source();
      if (!piece) return piece.error();
      at_end = piece->empty();
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece->data()));
      stream.avail_in = static_cast<uInt>(piece->size());
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    const int state = inflate(&stream, Z_NO_FLUSH);
    if (const std::size_t count = buffer.size() - stream.avail_out; count > 0) {
      const Result<bool> more = sink({buffer.data(), count});
      if (!more) return more.error();
      if (!*more) return Done{};
    }
    if (state == Z_OK) continue;
    if (state == Z_BUF_ERROR) {
      if (!at_end) continue;
      return packed_fault("the gzip data is cut: it ends before its end mark", name);
    }
    if (state != Z_STREAM_END)
      return packed_fault("the gzip data is damaged" + (stream.msg ? ": " + std::string(stream.msg) : std::string()),
                          name);
    rest.assign(reinterpret_cast<const char*>(stream.next_in), stream.avail_in);
    const Result<bool> more = goes_on(rest, source, name);
    if (!more) return more.error();
    if (!*more) return Done{};
    inflateReset(&stream);
    stream.next_in = reinterpret_cast<Bytef*>(rest.data());
    stream.avail_in = static_cast<uInt>(rest.size());
  }
}

#else

Status gunzip_pieces(const PieceSource&, const std::string& name, const PieceSink&) {
  return Error{"this build of bihive cannot undo gzip, as it was made without zlib", name, 0, 0,
               "unpack the file first"};
}

#endif

#if BIHIVE_HAS_ZSTD

Status unzstd_pieces(const PieceSource& source, const std::string& name, const PieceSink& sink) {
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
  if (!stream) return packed_fault("there is no memory left to undo zstd", name);
  std::string buffer(kUnpackedPieceBytes, '\0');
  bool in_frame = false;
  for (;;) {
    const Result<std::string_view> piece = source();
    if (!piece) return piece.error();
    if (piece->empty()) break;
    ZSTD_inBuffer from{piece->data(), piece->size(), 0};
    for (bool full = false; from.pos < from.size || full;) {
      ZSTD_outBuffer to{buffer.data(), buffer.size(), 0};
      const std::size_t state = ZSTD_decompressStream(stream.get(), &to, &from);
      if (ZSTD_isError(state) != 0)
        return packed_fault("the zstd data is damaged: " + std::string(ZSTD_getErrorName(state)), name);
      in_frame = state != 0;
      full = to.pos == to.size && in_frame;
      if (to.pos == 0) continue;
      const Result<bool> more = sink({buffer.data(), to.pos});
      if (!more) return more.error();
      if (!*more) return Done{};
    }
  }
  if (in_frame) return packed_fault("the zstd data is cut: it ends inside a frame", name);
  return Done{};
}

#else

Status unzstd_pieces(const PieceSource&, const std::string& name, const PieceSink&) {
  return Error{"this build of bihive cannot undo zstd, as it was made without libzstd", name, 0, 0,
               "unpack the file first: 'unzstd FILE'"};
}

#endif

using namespace std::string_view_literals;

// Each way of packing: how its data begin and the names of its files end. Data of bzip2 go on with a block, or with the
// end of an empty one, behind a digit.
struct PackingRow {
  Packing packing;
  std::string_view mark, ending;
  Status (*unpack)(const PieceSource&, const std::string&, const PieceSink&);
};
constexpr PackingRow kPackings[] = {
    {Packing::gzip, kGzipMark, ".gz", gunzip_pieces},
    {Packing::zstd, "\x28\xb5\x2f\xfd", ".zst", unzstd_pieces},
    {Packing::xz, "\xfd\x37\x7a\x58\x5a\0"sv, ".xz", unxz_pieces},
    {Packing::bzip2, "BZh", ".bz2", unbzip2_pieces},
};

bool is_bzip2(std::string_view bytes) {
  const std::string_view block = bytes.substr(std::min<std::size_t>(bytes.size(), 4), 6);
  return block == "\x31\x41\x59\x26\x53\x59" || block == "\x17\x72\x45\x38\x50\x90";
}

}  // namespace

Packing packing_of(std::string_view first_bytes) {
  for (const PackingRow& row : kPackings)
    if (first_bytes.substr(0, row.mark.size()) == row.mark && (row.packing != Packing::bzip2 || is_bzip2(first_bytes)))
      return row.packing;
  return is_binary_cif(first_bytes) ? Packing::binary_cif : Packing::none;
}

std::string_view packed_ending(std::string_view name) {
  for (const PackingRow& row : kPackings)
    if (name.size() > row.ending.size() && name.ends_with(row.ending)) return row.ending;
  return "";
}

bool is_packed(std::string_view bytes) {
  return packing_of(bytes) != Packing::none;
}

Status unpack_pieces(Packing packing, const PieceSource& source, const std::string& name, const PieceSink& sink) {
  BinaryCifFilter filter(name, sink);
  const PieceSink filtered = [&filter](std::string_view piece) {
    stop_if_cancelled();
    return filter.take(piece);
  };
  if (packing == Packing::binary_cif) {
    for (bool more = true; more;) {
      const Result<std::string_view> piece = source();
      if (!piece) return piece.error();
      const Result<bool> taken = piece->empty() ? Result<bool>(false) : filtered(*piece);
      if (!taken) return taken.error();
      more = *taken;
    }
    return filter.finish();
  }
  const auto* const row = std::find_if(std::begin(kPackings), std::end(kPackings),
                                       [packing](const auto& one) { return one.packing == packing; });
  BIHIVE_CHECK(row != std::end(kPackings));
  if (Status status = row->unpack(source, name, filtered); !status) return status;
  return filter.finish();
}

Result<std::string> unpack_bytes(std::string_view bytes, const std::string& name) try {
  const Packing packing = packing_of(bytes);
  if (packing == Packing::none) return std::string(bytes);
  constexpr std::size_t kPiece = std::size_t{1} << 30;
  const double room = memory_bytes();
  std::string unpacked;
  const auto source = [&bytes]() -> Result<std::string_view> {
    const std::string_view piece = bytes.substr(0, kPiece);
    bytes.remove_prefix(piece.size());
    return piece;
  };
  // A text that grows lies in memory twice for a moment, so it grows in steps that fit the limit.
  const auto sink = [&](std::string_view piece) -> Result<bool> {
    const std::size_t size = unpacked.size() + piece.size();
    if (static_cast<double>(size) > room)
      if (Status status = check_memory(static_cast<double>(size), "what is packed in it"); !status)
        return packed_fault(status.error().message + " (there is more)", name);
    if (size > unpacked.capacity()) {
      const double wanted = std::max(kGrowth * static_cast<double>(unpacked.capacity()), kLeastRoom);
      unpacked.reserve(std::max(size, static_cast<std::size_t>(std::min(wanted, room))));
    }
    unpacked.append(piece);
    return true;
  };
  if (Status status = unpack_pieces(packing, source, name, sink); !status) return status.error();
  return unpacked;
} catch (const std::bad_alloc&) {
  return packed_fault(no_memory_for("unpacking it").message, name);
}

}  // namespace bihive
