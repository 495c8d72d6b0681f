#include "film/film_record.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <utility>

#include "bihive/base/ascii.h"
#include "bihive/base/path_parts.h"
#include "bihive/base/write_file.h"
#include "bihive/image/png.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/system_failure.h"
#include "film/ffmpeg.h"

namespace bihive::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlock = 255;  // of a GIF
constexpr unsigned char kExtension = 0x21, kComment = 0xFE, kImage = 0x2C, kTrailer = 0x3B;
constexpr const char* kTag = "comment";

std::string gif_comment(const std::string& text) {
  std::string bytes{static_cast<char>(kExtension), static_cast<char>(kComment)};
  for (std::size_t at = 0; at < text.size(); at += kBlock) {
    const std::string block = text.substr(at, kBlock);
    bytes += static_cast<char>(block.size()) + block;
  }
  return bytes + '\0';
}

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xFF);
  return bytes;
}

std::string text_chunk(const std::string& text) {
  const std::string named = "tEXt" + kLateKeyword + '\0' + text;
  const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(named.data()), static_cast<uInt>(named.size()));
  return big_endian(static_cast<std::uint32_t>(named.size() - 4)) + named + big_endian(static_cast<std::uint32_t>(crc));
}

// The comments of a GIF, one after the other; empty: it has none, or is none.
std::string gif_comments(const std::string& gif) {
  constexpr std::size_t kHead = 13, kImageHead = 10;
  const auto byte = [&gif](std::size_t at) { return at < gif.size() ? static_cast<unsigned char>(gif[at]) : 0u; };
  const auto colours = [](unsigned flags) { return (flags & 0x80) != 0 ? std::size_t{3} << ((flags & 7) + 1) : 0; };
  std::string comments;
  std::size_t at = kHead + colours(byte(10));
  while (at < gif.size() && byte(at) != kTrailer) {
    const bool is_comment = byte(at) == kExtension && byte(at + 1) == kComment;
    if (byte(at) == kExtension)
      at += 2;
    else if (byte(at) == kImage)
      at += kImageHead + colours(byte(at + 9)) + 1;
    else
      return comments;
    for (; at < gif.size() && byte(at) != 0; at += 1 + byte(at))
      if (is_comment) comments += gif.substr(at + 1, byte(at));
    ++at;
  }
  return comments;
}

// The output of ffmpeg for a file.
std::string printed_by_ffmpeg(const std::string& path, const std::vector<std::string>& words) {
  const std::string ffmpeg = find_ffmpeg();
  const std::optional<OwnFolder> folder = OwnFolder::open_shared(fs::temp_directory_path().string());
  if (!folder) fail_environment({"there is no folder for temporary files", "", 0, 0, "set TMPDIR"});
  std::vector<std::string> all{"-i", "file:" + fs::absolute(path).string()};
  all.insert(all.end(), words.begin(), words.end());
  FfmpegRun run(ffmpeg, all, *folder, FfmpegRun::Input::none);
  try {
    run.finish();
  } catch (const Failure&) {
    fail({"is not a film that ffmpeg can read", path, 0, 0, ""});
  }
  return run.whole_output();
}

// The value of the tag in ffmpeg's file of metadata.
std::string tag_in(const std::string& metadata) {
  const std::string begin = "\n" + std::string(kTag) + "=";
  std::size_t at = metadata.find(begin);
  if (at == std::string::npos) {
    at = metadata.find(upper_case(begin));
  }
  std::string value;
  if (at == std::string::npos) return value;
  for (at += begin.size(); at < metadata.size() && metadata[at] != '\n'; ++at) {
    if (metadata[at] == '\\' && at + 1 < metadata.size()) ++at;
    value += metadata[at];
  }
  return value;
}

}  // namespace

void add_record_to_animation(const OwnFolder& folder, const std::string& name, bool is_gif, const std::string& record) {
  // A GIF ends in its trailer, a PNG in the chunk IEND.
  const off_t end = is_gif ? 1 : 12;
  const std::optional<Descriptor> file = folder.open_file(name, O_RDWR);
  if (!file) fail_of_system("cannot be written", folder.path_of(name), ENOENT);
  const off_t size = lseek(file->get(), 0, SEEK_END);
  std::string last(static_cast<std::size_t>(end), '\0');
  if (size < end || pread(file->get(), last.data(), last.size(), size - end) != static_cast<ssize_t>(end) ||
      lseek(file->get(), size - end, SEEK_SET) < 0)
    fail_of_system("cannot be read", folder.path_of(name), errno);
  if (const int code = write_whole(file->get(), (is_gif ? gif_comment(record) : text_chunk(record)) + last); code != 0)
    fail_of_system("writing failed", folder.path_of(name), code);
}

std::string ffmpeg_metadata(const std::string& record) {
  std::string text = ";FFMETADATA1\n" + std::string(kTag) + "=";
  for (const char c : record) {
    if (std::string_view("=;#\\\n").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text + "\n";
}

bool has_name_of_film(const std::string& path) {
  const std::string ending = ending_of(path);
  for (const char* const one : {".mp4", ".mov", ".mkv", ".webm", ".gif", ".apng"})
    if (ending == one) return true;
  return false;
}

bool is_without_loss(const std::string& path) {
  return ending_of(path) == ".apng";
}

std::string read_film_record(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".gif") return gif_comments(value_or_fail(read_file(path)));
  if (ending != ".apng") {
    if (std::error_code none; !fs::exists(path, none)) value_or_fail(read_file(path));
    return tag_in(printed_by_ffmpeg(path, {"-f", "ffmetadata", "pipe:1"}));
  }
  const PngFile file = value_or_fail(read_png(path));
  const auto text =
      std::find_if(file.text.begin(), file.text.end(), [](const auto& chunk) { return chunk.first == kLateKeyword; });
  return text == file.text.end() ? "" : text->second;
}

std::vector<std::string> sha256_of_pictures(const std::string& path) {
  const std::string printed = printed_by_ffmpeg(
      path, {"-vsync", "0", "-map", "0:v:0", "-pix_fmt", "rgb24", "-f", "framehash", "-hash", "sha256", "pipe:1"});
  // The last field of each line that is no comment.
  std::vector<std::string> all;
  for (std::size_t at = 0; at < printed.size();) {
    const std::size_t end = std::min(printed.find('\n', at), printed.size());
    const std::string line = printed.substr(at, end - at);
    at = end + 1;
    if (line.empty() || line[0] == '#') continue;
    const std::size_t field = line.find_last_of(", ");
    all.push_back(line.substr(field == std::string::npos ? 0 : field + 1));
  }
  return all;
}

}  // namespace bihive::cli
