// The texts of data/styles, embedded.
#pragma once

#include <string_view>

namespace bihive {

std::string_view style_text_default();
std::string_view style_text_plain();
std::string_view style_text_illustrative();
std::string_view style_text_studio();
std::string_view style_text_glossy();
std::string_view style_text_flat();
std::string_view style_text_xray();
std::string_view style_text_density();
std::string_view style_text_ball_and_stick();
std::string_view style_text_licorice();

}  // namespace bihive
