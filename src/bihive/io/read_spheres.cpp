#include "bihive/io/read_spheres.h"

#include <utility>

#include "bihive/io/assemble/finish.h"
#include "bihive/io/frames/sphere_frames.h"
#include "bihive/io/packed.h"
#include "bihive/io/packed/unpack.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/without_throwing.h"

namespace bihive {

Result<SphereFile> read_spheres_from_memory(std::string_view bytes, const std::string& name,
                                            const ReadOptions& options) {
  return without_throwing(name, [&]() -> Result<SphereFile> {
    if (!is_packed(bytes)) return SphereFrames(name, options).open(bytes, options.frame);
    const Result<std::string> unpacked = unpack_bytes(bytes, name);
    if (!unpacked) return unpacked.error();
    return SphereFrames(name, options).open(*unpacked, options.frame);
  });
}

Result<std::string> unpack_if_packed(std::string bytes, const std::string& name) {
  if (!is_packed(bytes)) return bytes;
  return without_throwing(name, [&] { return unpack_bytes(bytes, name); });
}

Result<SphereFile> read_spheres(const std::string& path, const ReadOptions& options) {
  return without_throwing(path, [&] { return SphereFrames(path, options).open(options.frame); });
}

}  // namespace bihive
