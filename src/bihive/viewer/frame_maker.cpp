#include "bihive/viewer/frame_maker.h"

#include <new>

#include "bihive/viewer/prepared_frame.h"

namespace bihive {

Result<std::shared_ptr<PreparedFrame>> FrameMaker::make(SphereFile frame) const {
  try {
    const Choices& choices = *choices_;
    auto made = std::make_shared<PreparedFrame>(SceneInput::spheres(std::move(frame), choices.name), choices.version);
    Result<SceneInput::Looked> looked =
        made->input.looked_at(choices.look, choices.settings.replicate, choices.settings.picture.user, nullptr,
                              {&choices.ranges, choices.floor});
    if (!looked) return looked.error();
    made->shown = std::make_unique<ShownScene>(std::move(looked->loaded));
    made->shown->trees = std::make_unique<SceneTrees>(made->shown->scene, tree_parameters(choices.settings));
    if (const Result<const Tracer*> tracer = made->shown->trees->needed_by(choices.settings); !tracer)
      return tracer.error();
    return made;
  } catch (const std::bad_alloc&) {
    return Error{"there is not enough memory for this frame", choices_->name, 0, 0, ""};
  }
}

}  // namespace bihive
