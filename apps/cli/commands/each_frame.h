// Reads all frames of a file, on all threads, and hands over what is made of each.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/io/frames.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "support/interrupt.h"

namespace bihive::cli {

/// Calls make(frame, file) for each frame on any thread, and take(made) in the order of frames on this one. Shows the
/// progress under `title`. Fails on the first frame that cannot be read.
template <class Made, class Make, class Take>
void each_frame(const Frames& frames, const char* title, const Make& make, const Take& take) {
  // Enough for all threads, and few in memory.
  constexpr std::int64_t kFramesAtOnce = 64;
  const CancellableSection section;
  Progress progress(title);
  for (std::int64_t begin = 0; begin < frames.count(); begin += kFramesAtOnce) {
    const std::int64_t count = std::min(kFramesAtOnce, frames.count() - begin);
    std::vector<Made> some(static_cast<std::size_t>(count));
    std::vector<std::optional<Error>> errors(some.size());
    parallel_for(0, count, [&](std::int64_t i) {
      if (CancellableSection::token().cancelled()) return;
      const Result<SphereFile> file = frames.read(begin + i);
      if (file)
        some[static_cast<std::size_t>(i)] = make(begin + i, *file);
      else
        errors[static_cast<std::size_t>(i)] = file.error();
    });
    CancellableSection::leave_if_cancelled();
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (errors[i]) value_or_fail(Status(*errors[i]));
      take(std::move(some[i]));
    }
    progress.update(static_cast<double>(begin + count) / static_cast<double>(frames.count()));
  }
}

}  // namespace bihive::cli
