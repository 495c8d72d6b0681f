#include "bihive/wide/build/binary_tree.h"

#include <algorithm>

namespace bihive {
namespace {

constexpr std::size_t kPortionBytes = NodeArena::kPortionSplits * sizeof(BinarySplit);
constexpr std::size_t kLargestChunk = std::size_t{1} << 22;

std::size_t portions_in(const AlignedBuffer& chunk) {
  return chunk.capacity() / kPortionBytes;
}

}  // namespace

BinarySplit* NodeArena::take_portion() {
  const std::lock_guard lock(mutex_);
  while (chunk_ < chunks_.size() && used_ == portions_in(chunks_[chunk_])) {
    ++chunk_;
    used_ = 0;
  }
  if (chunk_ == chunks_.size()) {
    // Doubles the memory, within limits.
    const auto held = static_cast<std::size_t>(allocated_bytes());
    AlignedBuffer chunk;
    chunk.reserve(std::clamp(held, 4 * kPortionBytes, kLargestChunk));
    chunks_.push_back(std::move(chunk));
    used_ = 0;
  }
  auto* const bytes = static_cast<std::byte*>(chunks_[chunk_].data());
  return reinterpret_cast<BinarySplit*>(bytes + kPortionBytes * used_++);
}

void NodeArena::clear() {
  const std::lock_guard lock(mutex_);
  chunk_ = 0;
  used_ = 0;
}

std::int64_t NodeArena::allocated_bytes() const {
  std::int64_t bytes = 0;
  for (const AlignedBuffer& chunk : chunks_) bytes += static_cast<std::int64_t>(chunk.capacity());
  return bytes;
}

}  // namespace bihive
