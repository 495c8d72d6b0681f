// ctest: asan-long
#include "bihive/gl/shader_source.h"

#include <gtest/gtest.h>

#include <map>

#include "bihive/gl/shader_chunks.h"

namespace bihive {
namespace {

Result<ShaderSource> assemble(const std::map<std::string, std::string, std::less<>>& chunks, std::string_view name,
                              const std::vector<std::string>& defines = {}) {
  return assemble_shader(name, defines, [&](std::string_view wanted) -> std::optional<std::string_view> {
    const auto found = chunks.find(wanted);
    if (found == chunks.end()) return std::nullopt;
    return found->second;
  });
}

TEST(ShaderSource, each_chunk_comes_once_where_it_is_wanted_first) {
  const ShaderSource source =
      assemble({{"main", "one\n#include \"a\"\n#include \"b\"\nfour\n"}, {"a", "#include \"b\"\nA\n"}, {"b", "B\n"}},
               "main", {"N 3", "TREE"})
          .value();
  EXPECT_EQ(source.text, "#version 300 es\n#define N 3\n#define TREE\none\nB\nA\nfour\n");
  std::string origins;
  for (const ShaderSource::Origin& origin : source.lines)
    origins += origin.chunk + ":" + std::to_string(origin.line) + " ";
  EXPECT_EQ(origins, ":0 :0 :0 main.glsl:1 b.glsl:1 a.glsl:2 main.glsl:4 ");
  EXPECT_EQ(source.chunks, (std::vector<std::string>{"main.glsl", "a.glsl", "b.glsl"}));
}

TEST(ShaderSource, an_unknown_chunk_is_an_error_with_its_place) {
  const Result<ShaderSource> source =
      assemble({{"main", "one\n#include \"a\"\n"}, {"a", "\n\n#include \"none\"\n"}}, "main");
  ASSERT_FALSE(source.ok());
  EXPECT_EQ(source.error().to_string(), "a.glsl:3: there is no shader chunk 'none'");
  EXPECT_EQ(assemble({}, "main").error().to_string(), "there is no shader chunk 'main'");
}

TEST(ShaderSource, messages_of_every_driver_name_the_chunk) {
  const ShaderSource source =
      assemble({{"main", "#include \"a\"\none\ntwo\n"}, {"a", "A\nB\n"}}, "main", {"N 3"}).value();
  EXPECT_EQ(source.with_names("0:4(7): error: `x' undeclared\n0:6(1): warning: 0:4\n"),
            "a.glsl:2(7): error: `x' undeclared\nmain.glsl:3(1): warning: 0:4\n");
  EXPECT_EQ(source.with_names("ERROR: 0:5: 'x' : undeclared identifier\n"),
            "ERROR: main.glsl:2: 'x' : undeclared identifier\n");
  EXPECT_EQ(source.with_names("0(3) : error C1008: undefined variable"), "a.glsl(1) : error C1008: undefined variable");
  EXPECT_EQ(source.with_names("0:2: of no chunk"), "0:2: of no chunk");
  EXPECT_EQ(source.with_names("0:99999999999999999999: who knows"), "0:99999999999999999999: who knows");
}

TEST(ShaderSource, every_chunk_of_the_library_assembles) {
#define BIHIVE_CHUNK(name) EXPECT_TRUE(assemble_shader(#name, {}).ok()) << #name;
  BIHIVE_SHADER_CHUNKS(BIHIVE_CHUNK)
#undef BIHIVE_CHUNK
  EXPECT_FALSE(assemble_shader("nowhere", {}).ok());
}

}  // namespace
}  // namespace bihive
