// Large answers get their memory in steps, so that a cancelled call need not wait for all of it: to be given its first
// value takes memory longer than to be copied.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bihive/base/watch.h"

namespace bihive::wide {

/// values.resize(size, value). Throws Cancelled if the thread's WatchedWork is cancelled.
template <class T>
void resize_in_steps(std::vector<T>& values, std::size_t size, T value) {
  constexpr std::size_t kStep = std::size_t{1} << 20;
  values.reserve(size);
  while (values.size() < size) {
    stop_if_cancelled();
    values.resize(std::min(size, values.size() + kStep), value);
  }
  values.resize(size);
}

}  // namespace bihive::wide
