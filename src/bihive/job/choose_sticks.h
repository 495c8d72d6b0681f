// The sticks that a scene and its user ask for: bonds, hydrogen bonds, arrows, tubes, links and trails.
#pragma once

#include <cstdint>
#include <optional>

#include "bihive/job/choose_camera.h"
#include "bihive/job/input.h"
#include "bihive/job/picture_request.h"
#include "bihive/scene/links.h"
#include "bihive/settings/arrows.h"
#include "bihive/settings/hydrogen_bonds.h"
#include "bihive/settings/links.h"
#include "bihive/settings/sticks.h"
#include "bihive/settings/traces.h"
#include "bihive/settings/trails.h"

namespace bihive {

class FrameSource;

struct ChosenSticks {
  Sticks bonds;
  HydrogenBonds hydrogen_bonds;
  Arrows arrows;
  Traces traces;
  Trails trails;
  Links links;
};

/// Fails with kBadUsage on what is stated about sticks that the picture has not, and on sticks that are not drawn
/// between spheres that are distributed. `whole`: null if the input has all spheres.
ChosenSticks choose_sticks(const PictureRequest& request, const Scene& scene, const WholeSet* whole);

/// Gives the atoms their radii beside bonds, before looks. Fails as scale_balls() of scene/bonds.h.
void scale_balls(const ChosenSticks& sticks, Scene& scene);

/// The contacts that the picture shows; nothing: none. Before spheres get other radii. Fails as contact_links() of
/// scene/contact_links.h.
std::optional<LinkTable> find_contacts(const ChosenSticks& sticks, const Scene& scene, std::int64_t threads);

/// Adds them to the scene, after looks. Warns of sticks that are not there. `contacts`: find_contacts(). `frames`: of
/// the input; null: they are opened for trails. Fails as the functions that add them.
void draw_sticks(const ChosenSticks& sticks, const std::optional<LinkTable>& contacts, const PictureRequest& request,
                 const FrameSource* frames, Input& input);

}  // namespace bihive
