// Numbers of the first surface behind each pixel: the layers of an OpenEXR file beside the light.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/base/result.h"
#include "bihive/image/exr.h"
#include "bihive/image/film.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// radiance: the film's light, channels R, G, B; with coverage also A, and R, G, B are multiplied by it, as readers of
/// OpenEXR expect. All others are of the first surface (sphere or plane) on the ray through the pixel's centre and the
/// middle of the lens; nothing is averaged, so an id is the id of a sphere, and a transparent sphere counts like any
/// other. A plane that shows shadows alone counts as nothing:
/// albedo.R, albedo.G, albedo.B: the colour of its material before any light, linear; 0 where there is nothing.
/// depth, channel Z: the distance along the view from the camera, in world units, as Camera::focus; +inf for nothing.
/// normal.X, normal.Y, normal.Z: its normal in the world, of length 1, turned against the ray; 0 for nothing.
/// id: input_id() of the sphere; of a stick its number after all spheres of the input; kIdOfPlane and kIdOfNothing.
/// attribute.NAME: the sphere's number of that name (select/attribute_names.h), on half a stick that of the sphere at
/// its end; NaN where it is unknown, for the plane and for nothing.
enum class LayerKind { radiance, albedo, depth, normal, id, attribute };

struct Layer {
  LayerKind kind = LayerKind::radiance;
  std::string attribute{};  ///< the name, for LayerKind::attribute
};

constexpr std::uint32_t kIdOfNothing = 0xFFFFFFFF;
constexpr std::uint32_t kIdOfPlane = 0xFFFFFFFE;

/// "radiance,depth,attribute:b_factor". An Error lists the known names.
Result<std::vector<Layer>> layers_from_text(const std::string& text);

/// The word for a layer in such a text.
std::string name_of_layer(const Layer& layer);

/// An Error if an attribute is not there, or holds texts, or a layer stands twice, or there are none.
Status check_layers(const Scene& scene, const std::vector<Layer>& layers);

/// Whether the light is among them.
bool has_radiance(const std::vector<Layer>& layers);

/// The names and types of the layers' channels, without numbers: for ExrForm. `with_coverage`: of the film.
std::vector<Channel> channels_of(const std::vector<Layer>& layers, bool with_coverage);

/// The channels of the pixels drawn_pixels(settings), on settings.threads. `film` holds these pixels as render()
/// returned them; without radiance among the layers it is not looked at. check_layers() must succeed. The same bits by
/// every engine and on any number of threads. A cancelled call returns channels of undefined numbers.
std::vector<Channel> draw_layers(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                 const std::vector<Layer>& layers, const Film& film = {},
                                 const CancelToken* cancel = nullptr);

}  // namespace bihive
