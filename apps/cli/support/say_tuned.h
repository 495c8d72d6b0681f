// `--tune` of render and film.
#pragma once

#include "bihive/job/messages.h"
#include "bihive/job/tuned_tree.h"
#include "support/communicator.h"

namespace bihive::cli {

/// The tree that tuned_tree() finds. Says which, on stderr.
inline TreeParameters say_tuned(const Scene& scene, RenderEngine engine, const RenderSettings& settings,
                                const ProgressCallback& progress = {}) {
  const TunedTree tuned = tuned_tree(scene, engine, settings, progress);
  if (leads()) say_lines("bihive: " + tuned.text() + "\n");
  return tuned.tree;
}

}  // namespace bihive::cli
