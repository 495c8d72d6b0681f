// The members of a zip archive, as numpy.savez writes it [APPNOTE].
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

struct ZipMember {
  std::string name;         ///< with question marks for control characters
  std::string_view packed;  ///< in the archive's bytes
  std::uint64_t size = 0;   ///< unpacked
  int method = 0;           ///< 0: stored, 8: deflated
};

/// The members in the order of the directory. Errors: damaged, or several archives in one.
Result<std::vector<ZipMember>> zip_members(std::string_view bytes, const std::string& file);

/// The member's bytes. Errors: packed in another way, damaged, or more than the memory holds.
Result<std::string> unpack_member(const ZipMember& member, const std::string& file);

}  // namespace bihive
