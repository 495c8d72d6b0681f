# Run by bihive_embed_version(): writes OUTPUT if its content changes.

# The commit, with "-dirty" if tracked files differ from it. Only if SOURCE itself is the top of a clone: a release
# unpacked inside another project must not take that project's commit.
set(commit "")
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(
    COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --exclude=* --abbrev=9
    OUTPUT_VARIABLE commit
    ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE failed)
  if(failed)
    set(commit "")
  endif()
endif()

file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[// Generated.
#include "bihive/base/version.h"

namespace bihive {

std::string_view version() {
  return "@VERSION@";
}

std::string_view commit() {
  return "@commit@";
}

}  // namespace bihive
]])
