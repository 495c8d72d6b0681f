// Stereo pictures: the views of two eyes in one film.
#pragma once

#include "bihive/render/renderer.h"

namespace bihive {

/// The settings of one view: half as wide where both lie next to each other, and no stereo picture. For the camera, and
/// for labels.
RenderSettings one_view(const RenderSettings& settings);

/// As render(), for settings with a stereo form, which must be of View::shaded without a crop.
///
/// Perspective: the eyes lie left and right of the camera's, look in parallel, and draw a part of a wider picture each
/// (a sheared frustum), so that nothing in the plane of the target moves between the views. The shift is a whole number
/// of pixels, at least 1, to which the distance between the eyes is rounded. Orthographic: both eyes look at the
/// target.
Result<Rendered> render_stereo(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                               const ProgressCallback& progress = {}, const CancelToken* cancel = nullptr);

}  // namespace bihive
