// A scene file that holds no spheres of its own: a picture of another input, with the options of `bihive render`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

/// `input`: a file or a built-in scene. Paths start from the document's folder. `options`: ids as in docs/settings.md
/// and values in their order; that of a switch is empty.
struct SavedRequest {
  std::string input;
  std::vector<std::pair<std::string, std::string>> options;
};

/// Nothing if the document is a scene with spheres of its own, or no scene. Errors as those of parse_scene().
Result<std::optional<SavedRequest>> saved_request_from(std::string_view text, const std::string& name);

/// The document, which saved_request_from() reads again.
std::string to_scene_json(const SavedRequest& request);

}  // namespace bihive
