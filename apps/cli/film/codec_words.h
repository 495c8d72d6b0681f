// The options of a film's codec for ffmpeg.
#pragma once

#include <string>
#include <vector>

#include "bihive/base/result.h"

namespace bihive::cli {

/// Split at spaces.
std::vector<std::string> codec_words(const std::string& text);

/// The options of a film without --codec; `ending`: ".webm" or another one.
std::vector<std::string> default_codec(const std::string& ending, int width_px, int height_px);

/// Error unless codec options from a file are harmless: options that choose the codec, its quality and its form, each
/// with a plain value. The user's own options on the command line may do more: name files, filters and protocols.
Status check_codec_of_file(const std::string& text);

}  // namespace bihive::cli
