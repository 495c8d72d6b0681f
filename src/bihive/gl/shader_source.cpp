#include "bihive/gl/shader_source.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "bihive/gl/shader_chunks.h"

namespace bihive {
namespace {

constexpr std::string_view kInclude = "#include \"";

std::string file_of(std::string_view chunk) {
  return std::string(chunk) + ".glsl";
}

std::string line_directive(std::size_t line, std::size_t chunk) {
  return "#line " + std::to_string(line) + " " + std::to_string(chunk) + "\n";
}

class Assembler {
 public:
  explicit Assembler(const ChunkFinder& find) : find_(find) {}

  // Appends a chunk that is not there yet; `from` and `line` say who wants it.
  Status append(std::string_view name, const std::string& from, std::size_t line, ShaderSource& source) {
    const std::optional<std::string_view> text = find_(name);
    if (!text)
      return Error{"there is no shader chunk '" + std::string(name) + "'", from, static_cast<std::int64_t>(line), 0,
                   ""};
    const std::size_t number = source.chunks.size();
    source.chunks.push_back(file_of(name));
    source.text += line_directive(1, number);

    std::size_t line_number = 1;
    for (std::string_view rest = *text; !rest.empty(); ++line_number) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view here = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (here.substr(0, kInclude.size()) != kInclude) {
        source.text += std::string(here) + "\n";
        continue;
      }
      const std::string_view other = here.substr(kInclude.size(), here.rfind('"') - kInclude.size());
      const bool there = std::find(source.chunks.begin(), source.chunks.end(), file_of(other)) != source.chunks.end();
      if (!there)
        if (Status status = append(other, file_of(name), line_number, source); !status) return status;
      source.text += line_directive(line_number + 1, number);
    }
    return Done{};
  }

 private:
  const ChunkFinder& find_;
};

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

std::string ShaderSource::with_names(std::string_view log) const {
  // A number between two colons, or before the first colon or bracket of a line, and a number behind it.
  std::string named;
  bool named_in_line = false;
  for (std::size_t i = 0; i < log.size();) {
    std::size_t end = i;
    while (end < log.size() && is_digit(log[end])) ++end;
    const bool starts = i == 0 || log[i - 1] == '\n' || log[i - 1] == ' ';
    const bool place = end > i && starts && !named_in_line && end + 1 < log.size() &&
                       (log[end] == ':' || log[end] == '(') && is_digit(log[end + 1]);
    if (place) {
      const auto number =
          static_cast<std::size_t>(std::strtoul(std::string(log.substr(i, end - i)).c_str(), nullptr, 10));
      if (number < chunks.size()) {
        named += chunks[number];
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
  source.text = "#version 300 es\n";
  for (const std::string& define : defines) source.text += "#define " + define + "\n";
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
