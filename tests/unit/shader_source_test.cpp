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
  EXPECT_EQ(source.text,
            "#version 300 es\n#define N 3\n#define TREE\n"
            "#line 1 0\none\n#line 1 1\n#line 1 2\nB\n#line 2 1\nA\n#line 3 0\n#line 4 0\nfour\n");
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
  ShaderSource source;
  source.chunks = {"main.glsl", "a.glsl", "sphere.glsl"};
  EXPECT_EQ(source.with_names("2:13(7): error: `x' undeclared\n1:4(1): warning: 0:1\n"),
            "sphere.glsl:13(7): error: `x' undeclared\na.glsl:4(1): warning: 0:1\n");
  EXPECT_EQ(source.with_names("ERROR: 2:13: 'x' : undeclared identifier\n"),
            "ERROR: sphere.glsl:13: 'x' : undeclared identifier\n");
  EXPECT_EQ(source.with_names("1(13) : error C1008: undefined variable"),
            "a.glsl(13) : error C1008: undefined variable");
  EXPECT_EQ(source.with_names("7:13: who knows"), "7:13: who knows");
}

TEST(ShaderSource, every_chunk_of_the_library_assembles) {
#define BIHIVE_CHUNK(name) EXPECT_TRUE(assemble_shader(#name, {}).ok()) << #name;
  BIHIVE_SHADER_CHUNKS(BIHIVE_CHUNK)
#undef BIHIVE_CHUNK
  EXPECT_FALSE(assemble_shader("nowhere", {}).ok());
}

}  // namespace
}  // namespace bihive
