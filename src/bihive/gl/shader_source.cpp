#include "bihive/gl/shader_source.h"

#include <algorithm>
#include <cctype>

#include "bihive/base/ascii.h"
#include "bihive/gl/shader_chunks.h"

namespace bihive {
namespace {

constexpr std::string_view kInclude = "#include \"";

std::string file_of(std::string_view chunk) {
  return std::string(chunk) + ".glsl";
}

void add_line(ShaderSource& source, std::string_view line, const std::string& chunk, std::int64_t number) {
  source.text += std::string(line) + "\n";
  source.lines.push_back({chunk, number});
}

class Assembler {
 public:
  explicit Assembler(const ChunkFinder& find) : find_(find) {}

  // Appends a chunk unless it is there already; `from` and `line` say where it is included.
  Status append(std::string_view name, const std::string& from, std::int64_t line, ShaderSource& source) {
    const std::optional<std::string_view> text = find_(name);
    if (!text)
      return Error{"there is no shader chunk '" + std::string(name) + "'", from, static_cast<std::int64_t>(line), 0,
                   ""};
    source.chunks.push_back(file_of(name));

    std::int64_t number = 1;
    for (std::string_view rest = *text; !rest.empty(); ++number) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view here = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (here.substr(0, kInclude.size()) != kInclude) {
        add_line(source, here, file_of(name), number);
        continue;
      }
      const std::string_view other = here.substr(kInclude.size(), here.rfind('"') - kInclude.size());
      const bool there = std::find(source.chunks.begin(), source.chunks.end(), file_of(other)) != source.chunks.end();
      if (there) continue;
      if (Status status = append(other, file_of(name), number, source); !status) return status;
    }
    return Done{};
  }

 private:
  const ChunkFinder& find_;
};

}  // namespace

std::string ShaderSource::with_names(std::string_view log) const {
  // The first "0:LINE" or "0(LINE)" of each line of the log.
  std::string named;
  bool named_in_line = false;
  for (std::size_t i = 0; i < log.size();) {
    const bool starts = i == 0 || log[i - 1] == '\n' || log[i - 1] == ' ';
    const bool place = starts && !named_in_line && i + 2 < log.size() && log[i] == '0' &&
                       (log[i + 1] == ':' || log[i + 1] == '(') && is_digit(log[i + 2]);
    if (place) {
      std::size_t end = i + 2;
      std::size_t line = 0;
      while (end < log.size() && is_digit(log[end]) && line <= lines.size())
        line = 10 * line + static_cast<std::size_t>(log[end++] - '0');
      if (line >= 1 && line <= lines.size() && !lines[line - 1].chunk.empty()) {
        named += lines[line - 1].chunk + log[i + 1] + std::to_string(lines[line - 1].line);
        named_in_line = true;
        i = end;
        continue;
      }
    }
    if (log[i] == '\n') named_in_line = false;
    named += log[i++];
  }
  return named;
}

Result<ShaderSource> assemble_shader(std::string_view name, const std::vector<std::string>& defines,
                                     const ChunkFinder& find) {
  ShaderSource source;
  add_line(source, "#version 300 es", "", 0);
  for (const std::string& define : defines) add_line(source, "#define " + define, "", 0);
  if (const Status status = Assembler(find).append(name, "", 0, source); !status) return status.error();
  return source;
}

Result<ShaderSource> assemble_shader(std::string_view name, const std::vector<std::string>& defines) {
  return assemble_shader(name, defines, shader_chunk);
}

std::optional<std::string_view> shader_chunk(std::string_view name) {
#define BIHIVE_SHADER_CHUNK(chunk) \
  if (name == #chunk) return shader_chunk_##chunk();
  BIHIVE_SHADER_CHUNKS(BIHIVE_SHADER_CHUNK)
#undef BIHIVE_SHADER_CHUNK
  return std::nullopt;
}

}  // namespace bihive
