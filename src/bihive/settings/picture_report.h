// The settings of a picture as it was drawn, for reports and the text of PNG files.
#pragma once

#include <string>

#include "bihive/settings/picture_settings.h"

namespace bihive {

/// Properties of a scene, for parameters that need them.
struct ReportedScene {
  bool soft_light = false, see_through = false;
};

/// A JSON object of those settings that matter for the scene and are not plain.
std::string picture_report(const PictureSettings& settings, const ReportedScene& scene);

}  // namespace bihive
