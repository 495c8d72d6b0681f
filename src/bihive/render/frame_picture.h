// The camera of a picture whose scene has none.
#pragma once

#include <functional>

#include "bihive/image/canvas.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The scene from this side, as large as the picture of these settings allows: the spheres that clips leave, with the
/// edges of the cell if those are drawn, or in View::tree the drawing of the tree. Labels that would cover spheres get
/// a side of the picture for themselves.
Camera frame_picture(const Scene& scene, const Side& side, const Lens& lens, const RenderSettings& settings);

/// The same for some of the scene's spheres, which alone are framed: others may be outside of the picture, in front of
/// them, and behind the eye. Labels get room where they would cover the selected ones.
Camera frame_selected(const Scene& scene, const SphereSet& selected, const Side& side, const Lens& lens,
                      const RenderSettings& settings);

/// The camera of frame_picture(), where somebody else knows all spheres: `framed` is the camera with room for these
/// insets, `covers` tells whether an area of its picture may cover a sphere.
Camera frame_beside_labels(const Scene& scene, const RenderSettings& settings,
                           const std::function<Camera(const Insets&)>& framed,
                           const std::function<bool(const Camera&, const CanvasArea&)>& covers);
bool covers_spheres(const SphereSet& spheres, const Camera& camera, const RenderSettings& settings,
                    const CanvasArea& area);

/// How many spheres in view begin behind the eye and end before it, so that the picture shows their insides: the eye is
/// inside of them; in orthographic pictures, the plane where rays start.
std::int64_t spheres_around_eye(const SphereSet& spheres, const Camera& camera, const RenderSettings& settings);

/// How many spheres are wholly outside of the picture.
std::int64_t spheres_outside(const SphereSet& spheres, const Camera& camera, const RenderSettings& settings);

/// The sides that the labels of such a picture need if all of it is full of spheres.
Insets insets_of_labels(const Scene& scene, const Camera& camera, const RenderSettings& settings);

}  // namespace bihive
