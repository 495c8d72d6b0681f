// Names of settings in the page's messages: the labels of their controls.
#pragma once

#include <string>
#include <string_view>

namespace bihive::page {

/// "“Radius ×” in the panel"; a setting without a control keeps its id. For name_settings_by().
std::string control_name(std::string_view id);

}  // namespace bihive::page
