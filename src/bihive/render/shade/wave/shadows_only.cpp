// Planes that show shadows alone.
#include "bihive/render/shade/wave/wave.h"
#include "bihive/render/shading.h"

namespace bihive::steps {
namespace {

Vec3d at(const ColourRows& rows, std::int64_t i) {
  return {rows.of[0][i], rows.of[1][i], rows.of[2][i]};
}

}  // namespace

Vec3d light_of_shadows_only(const WaveScene& scene, const WaveSurfaces& surfaces, std::int64_t number,
                            const LightReceived& received, const ColourRows& visibility) {
  Surface surface{};
  surface.id = kPlane;
  for (int axis = 0; axis < 3; ++axis) {
    surface.origin[axis] = surfaces.origin[axis][number];
    surface.normal[axis] = surfaces.normal[axis][number];
  }
  surface.material = scene.materials[static_cast<std::size_t>(scene.plane_material)];

  // What arrives from each light; lights with a radius have rows of their own.
  std::vector<Vec3d> seen(scene.lights.size(), Vec3d{1, 1, 1});
  std::int64_t row = number, soft_row = number;
  for (std::size_t i = 0; i < seen.size(); ++i, row += received.surfaces) {
    if (received.facing && scene.lights[i].radius > 0) {
      seen[i] = at(received.seen, soft_row);
      soft_row += received.surfaces;
    } else if (received.hidden != nullptr) {
      if (received.share) seen[i] = at(received.share, row);
      if (received.hidden[row] != 0) seen[i] = {};
    }
  }
  const Vec3d share = unshadowed_share(*scene.scene, scene.lights, surface, seen.data(),
                                       visibility ? at(visibility, number) : Vec3d{1, 1, 1});
  if (received.coverage == nullptr) return scene.scene->background * share;
  const double mean = (share.x + share.y + share.z) / 3;
  received.coverage[surfaces.owner[number]] = 1 - surfaces.weight[number] * mean;
  return {};
}

}  // namespace bihive::steps
