#include "bihive/base/aligned_buffer.h"

#include <cstdlib>
#include <new>

#include "bihive/base/memory.h"

#if defined(__linux__)
#include <sys/mman.h>
#elif defined(_WIN32)
#include <malloc.h>
#endif

namespace bihive {

namespace {

// Large blocks start and end on huge-page boundaries (2 MiB), so that the system can use them.
constexpr std::size_t kLine = 64;
constexpr std::size_t kHugePage = std::size_t{1} << 21;

std::size_t alignment_of(std::size_t bytes) {
  return bytes >= kHugePage ? kHugePage : kLine;
}

std::size_t rounded_up(std::size_t bytes) {
  const std::size_t alignment = alignment_of(bytes);
  return (bytes + alignment - 1) / alignment * alignment;
}

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  const std::size_t rounded = rounded_up(bytes);
  // The kernel would give a large block that a control group does not allow, and kill the process later.
  if (bytes >= kHugePage && !check_memory(0, "a block", 0, static_cast<double>(rounded))) throw std::bad_alloc();
#if defined(_WIN32)
  void* const data = _aligned_malloc(rounded, alignment_of(bytes));
#else
  void* const data = std::aligned_alloc(alignment_of(bytes), rounded);
#endif
  if (data == nullptr) throw std::bad_alloc();
  prefer_huge_pages(data, rounded);
  return data;
}

void free_aligned(void* data) {
#if defined(_WIN32)
  _aligned_free(data);
#else
  std::free(data);
#endif
}

void prefer_huge_pages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  const std::size_t before = reinterpret_cast<std::uintptr_t>(data) % kHugePage;
  const std::size_t skipped = before == 0 ? 0 : kHugePage - before;
  if (skipped + kHugePage > bytes) return;
  madvise(static_cast<char*>(data) + skipped, (bytes - skipped) / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
}

void AlignedBuffer::reserve(std::size_t bytes) {
  if (bytes <= capacity_) return;
  free_aligned(data_);
  data_ = nullptr;
  capacity_ = 0;
  data_ = allocate_aligned(bytes);
  capacity_ = rounded_up(bytes);
}

}  // namespace bihive
