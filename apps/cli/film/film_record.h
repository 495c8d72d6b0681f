// The record of how a film was made (job/picture_record.h), in the files of each format.
#pragma once

#include <string>
#include <vector>

#include "bihive/job/film/own_folder.h"

namespace bihive::cli {

/// Adds the record to a finished GIF (a comment extension) or APNG (a tEXt chunk `bihive`), at its end.
void add_record_to_animation(const OwnFolder& folder, const std::string& name, bool is_gif, const std::string& record);

/// The record as ffmpeg's file of metadata: as the tag `comment`.
std::string ffmpeg_metadata(const std::string& record);

/// Whether a path ends as films in one file do that can hold a record: .mp4, .mov, .mkv, .webm, .gif, .apng.
bool has_name_of_film(const std::string& path);
/// Whether pictures of such a film are as they were drawn: an APNG.
bool is_without_loss(const std::string& path);

/// The text of the record; empty: it has none. Fails with kBadInput if it cannot be read, with kEnvironment if ffmpeg
/// is needed and is not there.
std::string read_film_record(const std::string& path);
/// SHA-256 of each picture of an APNG, as ffmpeg reads them.
std::vector<std::string> sha256_of_pictures(const std::string& path);

}  // namespace bihive::cli
