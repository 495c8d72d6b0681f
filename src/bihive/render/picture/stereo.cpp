#include "bihive/render/stereo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/math/elementary.h"

namespace bihive {
namespace {

// The settings of the eye on this side: -1 left, 1 right. `view`: from one_view().
RenderSettings eye_settings(const Camera& camera, double share, const RenderSettings& view, int side) {
  RenderSettings eye = view;
  const Vec3d forward = camera.look_at - camera.eye;
  const double distance = length(forward);
  const Vec3d right = normalized(cross(forward, camera.up));
  Camera moved = camera;
  if (camera.projection == Projection::orthographic) {
    moved.eye = camera.eye + (0.5 * share * distance * side) * right;
    eye.camera = moved;
    return eye;
  }

  // The shift of the target's plane between camera and eye, in pixels.
  const int shorter = std::min(view.width_px, view.height_px);
  const double px = 2 * tan_deg(camera.fov_deg / 2) / shorter;  // at distance 1
  const int shift = std::max(1, static_cast<int>(std::floor(0.5 * share / px + 0.5)));
  const Vec3d step = (shift * px * distance * side) * right;
  moved.eye = camera.eye + step;
  moved.look_at = camera.look_at + step;

  // The view is a part of a picture that is wider on both sides and has pixels of the same size.
  eye.width_px = view.width_px + 2 * shift;
  const int shorter_of_wide = std::min(eye.width_px, eye.height_px);
  moved.fov_deg = 2 * atan_deg(0.5 * px * shorter_of_wide);
  if (eye.line_unit == LineUnit::picture) eye.line_scale *= static_cast<double>(shorter) / shorter_of_wide;
  const int x0 = side < 0 ? 2 * shift : 0;
  eye.crop = Tile{x0, 0, x0 + view.width_px, view.height_px};
  eye.camera = moved;
  return eye;
}

float luminance(Vec3f light) {
  return 0.2126F * light.x + 0.7152F * light.y + 0.0722F * light.z;
}

Film anaglyph(const Film& left, const Film& right) {
  Film both(left.width, left.height);
  for (std::size_t pixel = 0; pixel < both.radiance.size(); ++pixel) {
    const float of_right = luminance(right.radiance[pixel]);
    both.radiance[pixel] = {luminance(left.radiance[pixel]), of_right, of_right};
  }
  return both;
}

Film next_to_each_other(const Film& first, const Film& second) {
  Film both;
  both.resize(first.width + second.width, first.height, !first.coverage.empty());
  paste(first, 0, 0, both);
  paste(second, first.width, 0, both);
  return both;
}

}  // namespace

RenderSettings one_view(const RenderSettings& settings) {
  RenderSettings view = settings;
  if (settings.stereo.halves()) view.width_px = std::max(1, settings.width_px / 2);
  view.stereo = {};
  return view;
}

Result<Rendered> render_stereo(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                               const ProgressCallback& progress, const CancelToken* cancel) {
  const Stereo& stereo = settings.stereo;
  BIHIVE_CHECK(settings.view == View::shaded && !settings.crop);
  BIHIVE_CHECK(!stereo.halves() || settings.width_px % 2 == 0);
  BIHIVE_CHECK(stereo.eye_distance > 0 && stereo.eye_distance <= kMostEyeDistance);
  const RenderSettings view = one_view(settings);
  Rendered both;
  std::array<Film, 2> films;
  for (const std::size_t eye : {0, 1}) {
    ProgressCallback of_both;
    if (progress) of_both = [&progress, eye](double done) { progress(0.5 * (static_cast<double>(eye) + done)); };
    Result<Rendered> drawn = render(
        scene, tracer, eye_settings(scene.camera, stereo.eye_distance, view, eye == 0 ? -1 : 1), of_both, cancel);
    if (!drawn) return drawn.error();
    films[eye] = std::move(drawn->film);
    both.rays += drawn->rays;
    both.render_ms += drawn->render_ms;
  }
  if (stereo.form == StereoForm::cross) std::swap(films[0], films[1]);
  both.film = stereo.halves() ? next_to_each_other(films[0], films[1]) : anaglyph(films[0], films[1]);
  return both;
}

}  // namespace bihive
