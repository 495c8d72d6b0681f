#include "server/page_files.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "bihive/base/fnv.h"
#include "bihive/base/write_file.h"

namespace bihive::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1000;
constexpr std::size_t kMostBytes = 100'000'000;
// Shorter files fit into one packet without compression.
constexpr std::size_t kLeastPacked = 1000;

struct TypeOfEnding {
  const char* ending;
  const char* type;
  bool packs;
};
constexpr TypeOfEnding kTypes[] = {
    {".html", "text/html; charset=utf-8", true},
    {".js", "text/javascript; charset=utf-8", true},
    {".mjs", "text/javascript; charset=utf-8", true},
    {".css", "text/css; charset=utf-8", true},
    {".json", "application/json", true},
    {".map", "application/json", true},
    {".webmanifest", "application/manifest+json", true},
    {".wasm", "application/wasm", true},
    {".svg", "image/svg+xml", true},
    {".txt", "text/plain; charset=utf-8", true},
    {".pdb", "chemical/x-pdb", true},
    {".ico", "image/x-icon", true},
    {".png", "image/png", false},
    {".jpg", "image/jpeg", false},
    {".webp", "image/webp", false},
    {".woff2", "font/woff2", false},
};
constexpr TypeOfEnding kOtherType{"", "application/octet-stream", true};

const TypeOfEnding& type_of(const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  for (const TypeOfEnding& type : kTypes)
    if (ending == type.ending) return type;
  return kOtherType;
}

}  // namespace

std::string packed_by_gzip(const std::string& bytes) {
  constexpr int kGzip = 15 + 16;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, 9, Z_DEFAULT_STRATEGY) != Z_OK) return "";
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int code = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return code == Z_STREAM_END ? out : "";
}

PageFile make_page_file(const std::string& name, std::string bytes) {
  const TypeOfEnding& type = type_of(name);
  PageFile file;
  file.type = type.type;
  file.tag = fmt::format("{:016x}-{:x}", fnv1a(bytes), bytes.size());
  if (type.packs && bytes.size() >= kLeastPacked) {
    std::string small = packed_by_gzip(bytes);
    if (!small.empty() && small.size() < bytes.size())
      file.gzip = std::make_shared<const std::string>(std::move(small));
  }
  file.bytes = std::make_shared<const std::string>(std::move(bytes));
  return file;
}

Result<PageFiles> read_page(const std::string& folder) {
  PageFiles files;
  std::size_t total = 0;
  std::error_code code;
  fs::recursive_directory_iterator entry(folder, code);
  for (; !code && entry != fs::recursive_directory_iterator(); entry.increment(code)) {
    // Only regular files of this folder: a link may lead anywhere.
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    const fs::file_status status = entry->symlink_status(ignored);
    if (name.front() == '.' || fs::is_symlink(status)) {
      if (fs::is_directory(status)) entry.disable_recursion_pending();
      continue;
    }
    if (!fs::is_regular_file(status)) continue;

    // Stop before a wrong folder fills the memory.
    std::error_code unknown;
    total += static_cast<std::size_t>(entry->file_size(unknown));
    if (unknown || total > kMostBytes || files.size() >= kMostFiles)
      return Error{"this folder holds far more than bihive's page", folder, 0, 0, ""};

    Result<std::string> bytes = read_file(entry->path().string());
    if (!bytes) return bytes.error();
    files["/" + entry->path().lexically_relative(folder).generic_string()] = make_page_file(name, std::move(*bytes));
  }
  if (code) return Error{code.message(), folder, 0, 0, ""};
  if (files.count("/index.html") == 0) return Error{"there is no index.html in this folder", folder, 0, 0, ""};
  return files;
}

std::string find_page() {
  if (const char* named = std::getenv("BIHIVE_PAGE"); named != nullptr && *named != '\0') return named;
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  if (code) return "";
  const fs::path above = program.parent_path().parent_path();
  for (const fs::path& folder : {above / BIHIVE_SHARE_FOLDER / "bihive" / "web", above / "build-web" / "page"})
    if (fs::is_regular_file(folder / "index.html", code)) return folder.string();
  return "";
}

}  // namespace bihive::cli
