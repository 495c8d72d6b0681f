#include "bihive/kernels/aligned_buffer.h"

#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace bihive {

void AlignedBuffer::reserve(std::size_t bytes) {
  if (bytes <= capacity_) return;

  // Large blocks start and end on borders of huge pages (2 MiB), so that the system can use them.
  constexpr std::size_t kLine = 64;
  constexpr std::size_t kHugePage = std::size_t{1} << 21;
  const std::size_t alignment = bytes >= kHugePage ? kHugePage : kLine;
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;

  std::free(data_);
  capacity_ = 0;
  data_ = std::aligned_alloc(alignment, rounded);
  if (data_ == nullptr) throw std::bad_alloc();
  capacity_ = rounded;
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (alignment == kHugePage) madvise(data_, rounded, MADV_HUGEPAGE);
#endif
}

}  // namespace bihive
