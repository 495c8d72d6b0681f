// A picture in words, for the methods section of a paper.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bihive/job/picture_record.h"
#include "bihive/job/picture_request.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// A sentence that names program, inputs by SHA-256, style, projection, size and light, and an entry for BibTeX, a line
/// each. `described`: from settings_json(). `record`: of the picture; one without files and built-in scene stands for
/// spheres from memory.
std::string methods_text(const PictureRequest& request, const nlohmann::ordered_json& described, const Scene& scene,
                         const PictureRecord& record);

}  // namespace bihive
