#include "bihive/io/packed/unpackers.h"

#if BIHIVE_HAS_XZ

#include <lzma.h>

#include <cstdint>

#include "bihive/base/memory.h"

namespace bihive {
namespace {

// The dictionary of xz -9 has 64 MB; the format allows 1.5 GB.
constexpr double kMostShareOfMemory = 0.25;

}  // namespace

Status unxz_pieces(const PieceSource& source, const std::string& name, const PieceSink& sink) {
  struct Decoder {
    lzma_stream stream = LZMA_STREAM_INIT;
    Decoder() = default;
    ~Decoder() { lzma_end(&stream); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
  } decoder;
  lzma_stream& stream = decoder.stream;
  const auto most_bytes = static_cast<std::uint64_t>(kMostShareOfMemory * memory_bytes());
  if (lzma_stream_decoder(&stream, most_bytes, LZMA_CONCATENATED) != LZMA_OK)
    return packed_fault("there is no memory left to undo xz", name);
  std::string buffer(kUnpackedPieceBytes, '\0');
  bool at_end = false;
  for (;;) {
    if (stream.avail_in == 0 && !at_end) {
      const Result<std::string_view> piece = source();
      if (!piece) return piece.error();
      at_end = piece->empty();
      stream.next_in = reinterpret_cast<const std::uint8_t*>(piece->data());
      stream.avail_in = piece->size();
    }
    stream.next_out = reinterpret_cast<std::uint8_t*>(buffer.data());
    stream.avail_out = buffer.size();
    const lzma_ret state = lzma_code(&stream, at_end ? LZMA_FINISH : LZMA_RUN);
    if (const std::size_t count = buffer.size() - stream.avail_out; count > 0) {
      const Result<bool> more = sink({buffer.data(), count});
      if (!more) return more.error();
      if (!*more) return Done{};
    }
    if (state == LZMA_STREAM_END) return Done{};
    if (state == LZMA_OK) continue;
    if (state == LZMA_BUF_ERROR) {
      if (!at_end) continue;
      return packed_fault("the xz data is cut: it ends before its end mark", name);
    }
    if (state == LZMA_MEMLIMIT_ERROR || state == LZMA_MEM_ERROR)
      return packed_fault("undoing xz takes more than a quarter of the memory", name);
    return packed_fault(
        state == LZMA_OPTIONS_ERROR ? "the xz data is packed in an unknown way" : "the xz data is damaged", name);
  }
}

}  // namespace bihive

#else

namespace bihive {

Status unxz_pieces(const PieceSource&, const std::string& name, const PieceSink&) {
  return Error{"this build of bihive cannot undo xz, as it was made without liblzma", name, 0, 0,
               "unpack the file first: 'unxz FILE'"};
}

}  // namespace bihive

#endif
