// The parameters of a picture's tree: as given, or searched for these spheres (`tune`).
#pragma once

#include <string>

#include "bihive/base/watch.h"
#include "bihive/job/engine.h"
#include "bihive/job/picture_request.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

struct TunedTree {
  TreeParameters tree;
  double gain = 1;  ///< how many times as fast queries are as with the engine's own choice

  /// "max_prims 8 is 1.14 times as fast as the engine's own choice", with settings named as the caller does.
  std::string text() const;
};

/// Fails where nothing can be searched: the limits are given, or the engine of this name has no tree on the processor.
void check_tuning(const TreeParameters& given, const std::string& engine, bool has_tree);

/// Fails where the view shows the tree whose limits would change.
void check_tuned_view(View view);

/// Searches by tune_structure() (compare/tune.h), with rays from the scene's camera and, as the settings have them,
/// shadow rays and ambient occlusion: some builds of the tree and up to ten seconds. The engine has a tree on the
/// processor; without spheres nothing is searched. `progress` is called on the caller's thread.
TunedTree tuned_tree(const Scene& scene, RenderEngine engine, const RenderSettings& settings,
                     const ProgressCallback& progress = {});

/// The same for rays from anywhere in any direction, without a picture.
TunedTree tuned_tree_for_rays(const SphereSet& spheres, Engine engine, int threads,
                              const ProgressCallback& progress = {});

/// request.tree, or with `tune` what tuned_tree() finds, of a request that prepare_picture() has taken. Pictures keep
/// their bits.
TreeParameters tree_for(const PictureRequest& request, RenderEngine engine, const Scene& scene,
                        const RenderSettings& settings);

}  // namespace bihive
