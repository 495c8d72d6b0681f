// The words of a film's codec for ffmpeg.
#pragma once

#include <string>
#include <vector>

#include "bihive/base/result.h"

namespace bihive::cli {

/// One space or several between them.
std::vector<std::string> codec_words(const std::string& text);

/// The words of a film without --codec; `ending`: ".webm" or another one.
std::vector<std::string> default_codec(const std::string& ending);

/// An Error unless the words of a codec that stand in a file are harmless: options that choose the codec, its quality
/// and its form, each with a plain value. The user's own words on the command line may do more: name files, filters and
/// protocols.
Status check_codec_of_file(const std::string& text);

}  // namespace bihive::cli
