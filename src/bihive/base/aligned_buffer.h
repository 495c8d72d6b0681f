// A block of memory that only grows. It is aligned to cache lines, and to huge pages if the system has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

namespace bihive {

/// A block of at least `bytes`, for free_aligned(). Large ones start and end on huge-page boundaries. Throws
/// std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
/// Takes null too.
void free_aligned(void* data);

/// Requests huge pages for those parts of a large block that fill them. Call it before the memory is first written,
/// because a huge page takes a moment then. Does nothing for small blocks, and on systems without huge pages.
void prefer_huge_pages(void* data, std::size_t bytes);

class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  AlignedBuffer(const AlignedBuffer&) = delete;
  AlignedBuffer& operator=(const AlignedBuffer&) = delete;
  AlignedBuffer(AlignedBuffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), capacity_(std::exchange(other.capacity_, 0)) {}
  AlignedBuffer& operator=(AlignedBuffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~AlignedBuffer() { free_aligned(data_); }

  /// Makes room for at least `bytes`. The content is lost if the block has to grow. Throws std::bad_alloc.
  void reserve(std::size_t bytes);

  void* data() { return data_; }
  const void* data() const { return data_; }
  std::size_t capacity() const { return capacity_; }

 private:
  void* data_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace bihive
