// The implementation of frame_maker.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/scene/colour_by.h"
#include "bihive/viewer/frame_maker.h"
#include "bihive/viewer/scene_input.h"
#include "bihive/viewer/shown_scene.h"
#include "bihive/viewer/viewer_look.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive {

struct FrameMaker::Choices {
  std::string name;  ///< of the file
  ViewerLook look;
  ViewerSettings settings;
  std::vector<ColourBy> ranges;  ///< as Scene::coloured_by
  std::optional<Plane> floor;    ///< where the look has one
  std::uint64_t version;         ///< of the viewer's choices
};

class PreparedFrame {
 public:
  SceneInput input;
  std::unique_ptr<ShownScene> shown;  ///< with trees
  std::uint64_t version;              ///< of its maker's choices

  PreparedFrame(SceneInput read, std::uint64_t of_choices) : input(std::move(read)), version(of_choices) {}
};

}  // namespace bihive
