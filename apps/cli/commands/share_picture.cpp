#include "commands/share_picture.h"

#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/spread/scene_bytes.h"
#include "bihive/spread/spread_scene.h"

namespace bihive::cli {

void share_picture(PreparedPicture& prepared, bool with_spheres, PictureCommunicator& ranks) {
  Bytes bytes;
  if (leads()) {
    ByteWriter out(bytes);
    out.put(prepared.engine);
    out.put(prepared.can_share);
    out.put_text(as_text(prepared.described, -1));
    put_scene(prepared.input.scene, prepared.settings, bytes);
  }
  bytes = ranks.broadcast(std::move(bytes));
  if (!leads()) {
    const int threads = prepared.settings.threads;
    ByteReader in(bytes);
    prepared.engine = in.take<RenderEngine>();
    prepared.can_share = in.take<bool>();
    prepared.described = *json_from_text<nlohmann::ordered_json>(in.take_text());
    take_scene(in, prepared.input.scene, prepared.settings);
    prepared.settings.threads = threads;
  }
  if (with_spheres) give_all_spheres(prepared.input.scene, ranks);
}

}  // namespace bihive::cli
