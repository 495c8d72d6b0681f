#include "bihive/io/gunzip.h"

#include <algorithm>
#include <new>

#include "bihive/base/memory.h"

#if BIHIVE_HAS_ZLIB
#include <zlib.h>
#endif

namespace bihive {

bool looks_gzipped(std::string_view bytes) {
  return bytes.substr(0, 2) == "\x1f\x8b";
}

#if BIHIVE_HAS_ZLIB

namespace {

// A text grows by this factor, and has room for so many bytes from the beginning.
constexpr double kGrowth = 1.5;
constexpr double kLeastRoom = 1 << 20;

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

// May throw, where memory is short.
Result<std::string> gunzip_all(std::string_view bytes, const std::string& name) {
  const auto bad = [&name](const std::string& what) { return Error{what, name, 0, 0, ""}; };
  Inflater inflater;
  if (!inflater.ready) return bad("there is no memory left to undo gzip");
  z_stream& stream = inflater.stream;

  // zlib counts in 32 bits: give it piece after piece, and let it write into a buffer of fixed size.
  constexpr std::size_t kPiece = std::size_t{1} << 30;
  const double room = memory_bytes();
  std::string unpacked, buffer(std::size_t{1} << 18, '\0');
  std::size_t fed = 0;
  for (;;) {
    if (stream.avail_in == 0) {
      const std::size_t piece = std::min(kPiece, bytes.size() - fed);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + fed));
      stream.avail_in = static_cast<uInt>(piece);
      fed += piece;
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    const int state = inflate(&stream, Z_NO_FLUSH);
    const std::size_t count = buffer.size() - stream.avail_out;
    // A text that grows lies in memory twice for a moment, so it grows in steps that fit the limit.
    if (static_cast<double>(unpacked.size() + count) > room)
      if (Status status = check_memory(static_cast<double>(unpacked.size() + count), "what is packed in it"); !status)
        return bad(status.error().message + " (there is more)");
    if (unpacked.size() + count > unpacked.capacity()) {
      const double wanted = std::max(kGrowth * static_cast<double>(unpacked.capacity()), kLeastRoom);
      unpacked.reserve(std::max(unpacked.size() + count, static_cast<std::size_t>(std::min(wanted, room))));
    }
    unpacked.append(buffer.data(), count);
    if (state == Z_OK) continue;
    if (state == Z_BUF_ERROR) {
      if (fed < bytes.size()) continue;
      return bad("the gzip data is cut: it ends before its end mark");
    }
    if (state != Z_STREAM_END)
      return bad("the gzip data is damaged" + (stream.msg ? ": " + std::string(stream.msg) : std::string()));

    // A member is followed by another member, by padding, or by nothing.
    std::string_view rest = bytes.substr(fed - stream.avail_in);
    if (rest.find_first_not_of('\0') == std::string_view::npos) return unpacked;
    if (!looks_gzipped(rest)) return bad("the gzip data is damaged: something else follows its end mark");
    inflateReset(&stream);
  }
}

}  // namespace

Result<std::string> gunzip(std::string_view bytes, const std::string& name) {
  try {
    return gunzip_all(bytes, name);
  } catch (const std::bad_alloc&) {
    return Error{"there is not enough memory to unpack it", name, 0, 0, ""};
  }
}

#else

Result<std::string> gunzip(std::string_view, const std::string& name) {
  return Error{"this build of bihive cannot undo gzip, as it was made without zlib", name, 0, 0,
               "unpack the file first"};
}

#endif

}  // namespace bihive
