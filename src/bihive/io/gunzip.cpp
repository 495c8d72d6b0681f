#include "bihive/io/gunzip.h"

#include "bihive/io/unpack.h"

namespace bihive {

bool looks_gzipped(std::string_view bytes) {
  return packing_of(bytes) == Packing::gzip;
}

Result<std::string> gunzip(std::string_view bytes, const std::string& name) {
  if (!looks_gzipped(bytes)) return Error{"this is no gzip data", name, 0, 0, ""};
  return unpack_bytes(bytes, name);
}

}  // namespace bihive
