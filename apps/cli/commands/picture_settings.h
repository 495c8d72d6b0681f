// From the options of a picture to what is drawn: shared by `bihive render` and `bihive film`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "commands/choose_camera.h"
#include "commands/commands.h"
#include "support/input.h"
#include "support/report_text.h"

namespace bihive::cli {

/// Fails with kBadUsage if the engine cannot draw the view.
RenderEngine choose_engine(const RenderOptions& options);

bool is_gpu(RenderEngine engine);

/// The structure that an engine builds.
Engine structure_of(RenderEngine engine);

/// Does the looks on an input that load_input() has loaded with LooksOfFile::keep, and applies the user's options to
/// its scene: transfer curve, background, camera, light. The scene's own settings with the user's options are the
/// result; options.fixed replaces the camera and the ranges of colours. Fails where options contradict each other or do
/// not fit the input. `whole`: null if the input has all spheres.
RenderSettings prepare_picture(const RenderOptions& options, RenderEngine engine, Input& input,
                               const WholeSet* whole = nullptr);

/// Fails with kBadInput if the picture or its tree surely does not fit the memory.
void check_memory_of(RenderEngine engine, const Input& input, const RenderOptions& options,
                     const RenderSettings& settings);

/// The views distance and tree, and pictures of graphics processors, are drawn whole.
bool comes_whole(RenderEngine engine, const RenderSettings& settings);

/// Everything that decides the picture, for its text chunk. Threads and engine do not.
nlohmann::ordered_json settings_json(const RenderOptions& options, const RenderSettings& settings, const Scene& scene,
                                     const std::vector<Layer>& layers);

/// The texts in the file about its picture.
std::vector<std::pair<std::string, std::string>> text_of(const Scene& scene, const nlohmann::ordered_json& settings);

}  // namespace bihive::cli
