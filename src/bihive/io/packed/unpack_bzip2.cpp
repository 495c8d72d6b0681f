#include "bihive/io/packed/unpackers.h"

#if BIHIVE_HAS_BZIP2

#include <bzlib.h>

#include <utility>

namespace bihive {
namespace {

// One stream of bzip2; several may follow each other.
struct Bunzipper {
  bz_stream stream{};
  bool ready;
  Bunzipper() { ready = BZ2_bzDecompressInit(&stream, 0, 0) == BZ_OK; }
  ~Bunzipper() {
    if (ready) BZ2_bzDecompressEnd(&stream);
  }
  Bunzipper(const Bunzipper&) = delete;
  Bunzipper& operator=(const Bunzipper&) = delete;

  // Begins anew with the input that is left.
  bool restart() {
    char* const input = stream.next_in;
    const unsigned left = stream.avail_in;
    if (ready) BZ2_bzDecompressEnd(&stream);
    stream = {};
    ready = BZ2_bzDecompressInit(&stream, 0, 0) == BZ_OK;
    stream.next_in = input;
    stream.avail_in = left;
    return ready;
  }
};

}  // namespace

Status unbzip2_pieces(const PieceSource& source, const std::string& name, const PieceSink& sink) {
  Bunzipper bunzipper;
  bz_stream& stream = bunzipper.stream;
  if (!bunzipper.ready) return packed_fault("there is no memory left to undo bzip2", name);
  std::string buffer(kUnpackedPieceBytes, '\0');
  bool at_end = false, is_first = true;
  for (;;) {
    if (stream.avail_in == 0 && !at_end) {
      const Result<std::string_view> piece = source();
      if (!piece) return piece.error();
      at_end = piece->empty();
      stream.next_in = const_cast<char*>(piece->data());
      stream.avail_in = static_cast<unsigned>(piece->size());
    }
    stream.next_out = buffer.data();
    stream.avail_out = static_cast<unsigned>(buffer.size());
    const int state = BZ2_bzDecompress(&stream);
    const std::size_t count = buffer.size() - stream.avail_out;
    if (count > 0) {
      const Result<bool> more = sink({buffer.data(), count});
      if (!more) return more.error();
      if (!*more) return Done{};
    }
    if (state == BZ_OK) {
      if (at_end && stream.avail_in == 0 && count == 0)
        return packed_fault("the bzip2 data is cut: it ends before its end mark", name);
      continue;
    }
    if (state == BZ_MEM_ERROR) return packed_fault("there is no memory left to undo bzip2", name);
    if (state != BZ_STREAM_END)
      return packed_fault(!is_first && state == BZ_DATA_ERROR_MAGIC
                              ? "the bzip2 data is damaged: something else follows its end mark"
                              : "the bzip2 data is damaged",
                          name);

    // Look for a further stream.
    is_first = false;
    if (stream.avail_in == 0) {
      const Result<std::string_view> piece = at_end ? Result<std::string_view>(std::string_view()) : source();
      if (!piece) return piece.error();
      if (piece->empty()) return Done{};
      stream.next_in = const_cast<char*>(piece->data());
      stream.avail_in = static_cast<unsigned>(piece->size());
    }
    if (!bunzipper.restart()) return packed_fault("there is no memory left to undo bzip2", name);
  }
}

}  // namespace bihive

#else

namespace bihive {

Status unbzip2_pieces(const PieceSource&, const std::string& name, const PieceSink&) {
  return Error{"this build of bihive cannot undo bzip2, as it was made without libbz2", name, 0, 0,
               "unpack the file first: 'bunzip2 FILE'"};
}

}  // namespace bihive

#endif
