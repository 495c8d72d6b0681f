#include "bihive/render/tree_picture.h"

#include <algorithm>
#include <vector>

#include "bihive/base/timer.h"

namespace bihive {
namespace {

// The spheres behind the boxes must be darker than the boxes.
constexpr double kReliefBrightness = 0.40;

// The band between the parts.
constexpr int kBandPx = 8;

// The spheres in grey, as if the light came from the eye.
void draw_relief(Canvas& canvas, const Film& normals, const Camera& camera) {
  const Vec3d to_eye = normalized(camera.eye - camera.look_at);
  for (int y = 0; y < normals.height; ++y)
    for (int x = 0; x < normals.width; ++x) {
      const Vec3d colour = to_double(normals.at(x, y));
      if (colour == Vec3d{}) continue;
      const double facing = dot(2.0 * colour - Vec3d{1, 1, 1}, to_eye);
      const double grey = kReliefBrightness * std::clamp(facing, 0.0, 1.0);
      canvas.at(x, y) = to_float(Vec3d{grey, grey, grey});
    }
}

}  // namespace

TreePictureLayout tree_picture_layout(int width_px, int height_px) {
  // The bars need less room than the boxes if they lie below.
  const bool side_by_side = width_px > height_px;
  const int length = side_by_side ? width_px : height_px;
  const int band = std::min(kBandPx, length / 16);
  const int first = std::max(1, (side_by_side ? length / 2 : length * 3 / 5) - band / 2);
  const int second = std::min(length, first + band);
  const CanvasArea whole{0, 0, double(width_px), double(height_px)};
  TreePictureLayout layout{whole, whole};
  (side_by_side ? layout.boxes.x1 : layout.boxes.y1) = first;
  (side_by_side ? layout.bars.x0 : layout.bars.y0) = second;
  return layout;
}

Camera frame_tree(const SphereSet& spheres, ViewFrom from, double fov_deg, int width_px, int height_px) {
  return frame_tree(spheres, side_of(from), {fov_deg, Projection::perspective}, width_px, height_px);
}

Camera frame_tree(const SphereSet& spheres, const Side& side, const Lens& lens, int width_px, int height_px) {
  // Frame the corners of the box.
  std::vector<double> x, y, z;
  if (!spheres.empty()) {
    const SphereSet::Bounds bounds = spheres.bounds();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d at = spheres.to_local({(corner & 1) != 0 ? bounds.hi.x : bounds.lo.x,
                                         (corner & 2) != 0 ? bounds.hi.y : bounds.lo.y,
                                         (corner & 4) != 0 ? bounds.hi.z : bounds.lo.z});
      x.push_back(at.x);
      y.push_back(at.y);
      z.push_back(at.z);
    }
  }
  const Result<SphereSet> corners =
      SphereSet::from_local(x, y, z, std::vector<double>(x.size(), 0.0), spheres.origin());
  const CanvasArea part = tree_picture_layout(width_px, height_px).boxes;
  return frame_spheres(corners ? *corners : spheres, side, lens, static_cast<int>(part.width()),
                       static_cast<int>(part.height()));
}

Result<Rendered> render_tree_picture(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                     const ProgressCallback& progress, const CancelToken* cancel) {
  const Timer timer;
  const TreePictureLayout layout = tree_picture_layout(settings.width_px, settings.height_px);
  Canvas canvas(settings.width_px, settings.height_px);

  // The relief: one ray a pixel.
  RenderSettings relief = settings;
  relief.width_px = static_cast<int>(layout.boxes.width());
  relief.height_px = static_cast<int>(layout.boxes.height());
  relief.samples_per_pixel = 1;
  relief.adaptive_samples = false;
  relief.view = View::normal;
  relief.crop.reset();
  Result<Rendered> rendered = render(scene, tracer, relief, progress, cancel);
  if (!rendered) return rendered;
  draw_relief(canvas, rendered->film, scene.camera);

  draw_tree_boxes(canvas, layout.boxes, *tracer.tree(), scene.spheres.inverse_scale(), local_camera(scene));
  draw_tree_bars(canvas, layout.bars, *tracer.tree());

  rendered->film = Film(settings.width_px, settings.height_px);
  rendered->film.radiance = canvas.take_pixels();
  if (settings.crop) rendered->film = part_of(rendered->film, *settings.crop);
  rendered->render_ms = timer.elapsed_ms();
  return rendered;
}

}  // namespace bihive
