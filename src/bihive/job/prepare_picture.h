// Prepares a picture from its options: shared by `bihive render` and `bihive film`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bihive/job/choose_camera.h"
#include "bihive/job/input.h"
#include "bihive/job/picture_request.h"
#include "bihive/job/report_text.h"
#include "bihive/render/layers.h"

namespace bihive {

class FrameSource;

/// Fails with kBadUsage if the engine cannot draw the view.
RenderEngine choose_engine(const PictureRequest& request);

/// Applies the looks to an input that load_input() has loaded with LooksOfFile::keep, and the user's options to its
/// scene: transfer curve, background, camera, light. Returns the scene's own settings with the user's options;
/// request.fixed replaces the camera and the ranges of colours. Fails if options contradict each other or do not fit
/// the input. `whole`: null if the input has all spheres. `frames`: of the input, for trails; null: they are opened.
RenderSettings prepare_picture(const PictureRequest& request, RenderEngine engine, Input& input,
                               const WholeSet* whole = nullptr, const FrameSource* frames = nullptr);

/// Fails with kBadInput if the picture or its tree surely does not fit the memory.
void check_memory_of(RenderEngine engine, const Input& input, const PictureRequest& request,
                     const RenderSettings& settings);

/// Whether the picture must be drawn whole: the views distance and tree, and pictures of the GPU.
bool comes_whole(RenderEngine engine, const RenderSettings& settings);

/// Everything that determines the picture, for its text chunk; threads and engine do not.
nlohmann::ordered_json settings_json(const PictureRequest& request, const RenderSettings& settings, const Scene& scene,
                                     const std::vector<Layer>& layers);

/// The text chunks of the file.
std::vector<std::pair<std::string, std::string>> text_of(const PictureRequest& request, const Scene& scene,
                                                         const nlohmann::ordered_json& settings);

}  // namespace bihive
