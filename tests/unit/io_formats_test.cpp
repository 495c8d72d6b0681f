// The table of formats, and the pages and lists of other languages that say the same. BIHIVE_UPDATE_DOCS=1 writes the
// blocks of the pages anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "bihive/io/formats/formats.h"
#include "bihive/io/known_formats.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::string kTop = BIHIVE_SOURCE_DIR "/";

std::string text_in(const std::string& name) {
  std::ifstream file(kTop + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> split(std::string_view text) {
  std::istringstream stream{std::string(text)};
  return {std::istream_iterator<std::string>(stream), {}};
}

ReadOptions at_radius_one() {
  ReadOptions options;
  options.radius = 1;
  return options;
}

// The endings of all formats, and of the trajectories.
std::vector<std::string> all_endings() {
  std::vector<std::string> all;
  const auto take = [&all](std::string_view files) {
    for (const std::string& one : split(files))
      if (one[0] == '.') all.push_back(one);
  };
  for (const Format* format : formats()) take(format->files);
  for (const TrajectoryFormat* format : trajectory_formats()) take(format->files);
  return all;
}

// The text between "<!-- NAME -->" and "<!-- /NAME -->" of a page is `wanted`.
void expect_block(const std::string& page, const std::string& name, const std::string& wanted) {
  const std::string begin = "<!-- " + name + " -->", end = "<!-- /" + name + " -->";
  std::string text = text_in(page);
  const std::size_t first = text.find(begin), last = text.find(end);
  ASSERT_TRUE(first != std::string::npos && last != std::string::npos && first < last) << page << ": " << begin;
  const std::size_t from = first + begin.size();
  if (text.substr(from, last - from) == wanted) return;
  if (std::getenv("BIHIVE_UPDATE_DOCS") != nullptr) {
    std::ofstream(kTop + page, std::ios::binary) << text.replace(from, last - from, wanted);
    FAIL() << "updated " << page;
  }
  FAIL() << page << " is old: BIHIVE_UPDATE_DOCS=1 build-release/tests/unit_tests --file unit/io_formats";
}

std::string table_of_formats() {
  std::vector<const Format*> rows(formats().begin(), formats().end());
  std::sort(rows.begin(), rows.end(),
            [](const Format* a, const Format* b) { return lower_case(a->name) < lower_case(b->name); });
  std::string table = "\n| format | names of files | known by | taken | radius |\n|---|---|---|---|---|\n";
  for (const Format* row : rows)
    table += "| " + std::string(row->name) + " | " + (row->files.empty() ? "" : "`" + std::string(row->files) + "`") +
             " | " + std::string(row->docs) + " |\n";
  return table +
         "| scene file (JSON) | `.json` | `{` | spheres, camera, lights, materials, plane: "
         "[scene_format.md](scene_format.md) | own, or from a named file |\n";
}

// "GRO, PDB and XYZ": those for which it is so.
std::string those(Format::Has what) {
  std::set<std::string> names;
  for (const Format* format : formats())
    if (format->has(what)) names.insert(std::string(format->name));
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : name == *names.rbegin() ? " and " : ", ") + name;
  return list;
}

TEST(Formats, HaveWholeRows) {
  std::set<std::string_view> names;
  std::set<std::int64_t> numbers;
  for (const Format* format : formats()) {
    SCOPED_TRACE(format->name);
    EXPECT_TRUE(names.insert(format->name).second);
    EXPECT_EQ(&format_named(format->name), format);
    EXPECT_NE(format->recognise, nullptr);
    EXPECT_TRUE(std::visit([](const auto reader) { return reader != nullptr; }, format->reader));
    EXPECT_EQ(std::count(format->docs.begin(), format->docs.end(), '|'), 2);
    const bool is_indexed = std::holds_alternative<TextReader>(format->reader);
    EXPECT_EQ(format->index_number >= 0, is_indexed);
    EXPECT_TRUE(!is_indexed || (format->has(Format::kText) && numbers.insert(format->index_number).second));
    EXPECT_TRUE(format->has(Format::kFrames) || std::holds_alternative<PlainReader>(format->reader) ||
                std::holds_alternative<ColumnReader>(format->reader));
    EXPECT_TRUE(format->has(Format::kColumns) || !std::holds_alternative<ColumnReader>(format->reader));
  }
  for (const TrajectoryFormat* format : trajectory_formats()) {
    EXPECT_TRUE(names.insert(format->name).second) << format->name;
    EXPECT_EQ(format->alone.empty(), format->files.empty()) << format->name;
  }
  const std::vector<std::string> endings = all_endings();
  EXPECT_THAT(std::set<std::string>(endings.begin(), endings.end()), SizeIs(endings.size())) << "an ending twice";
}

// An index that an older version kept is read by a newer one.
TEST(Formats, KeepTheirNumbersInAnIndex) {
  const std::pair<const char*, std::int64_t> numbers[] = {
      {"PDB", 0}, {"PQR", 1}, {"XYZ", 3}, {"GRO", 4}, {"LAMMPS dump", 5}};
  for (const auto& [name, number] : numbers) EXPECT_EQ(format_named(name).index_number, number) << name;
}

TEST(Formats, KnowEndingsOfPackedFiles) {
  EXPECT_EQ(unpacked_ending_of("a/b.PDB.gz"), ".pdb");
  EXPECT_EQ(unpacked_ending_of("b.xyz.zst"), ".xyz");
  for (const char* name : {"", "pdb", "a.pdb/b"}) EXPECT_EQ(unpacked_ending_of(name), "") << name;
}

// Programs in Fortran write them in every format of text.
TEST(Formats, TakeExponentsOfFortran) {
  const std::pair<const char*, const char*> files[] = {
      {"a.xyz", "1\n\nO 1.0D+00 2.0d0 -3.5D-1\n"},
      {"a.csv", "x,y,z\n1.0D+00,2.0d0,-3.5D-1\n"},
      {"a.lmp", "t\n\n1 atoms\n1 atom types\n0.0D0 1.0D1 xlo xhi\n\nAtoms # atomic\n\n1 1 1.0D+00 2.0d0 -3.5D-1\n"},
      {"a.dump",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0.0D0 1.0D1\n0 9\n0 9\n"
       "ITEM: ATOMS id x y z\n1 1.0D+00 2.0d0 -3.5D-1\n"},
      {"POSCAR", "O\n1.0D0\n9 0 0\n0 9 0\n0 0 9\nO\n1\nCartesian\n1.0D+00 2.0d0 -3.5D-1\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
       "1.0D+00 2.0d0 -3.5D-1\n"}};
  for (const auto& [name, text] : files)
    EXPECT_EQ(test::read_text(text, name, at_radius_one()).spheres.centre(0), (Vec3d{1, 2, double(-0.35F)})) << name;
}

TEST(FormatPages, AreOfTheseFormats) {
  expect_block("docs/formats.md", "table of formats", table_of_formats());
  expect_block("docs/formats.md", "what formats have",
               "\n- Any number of frames: " + those(Format::kFrames) + ".\n- Columns to choose: " +
                   those(Format::kColumns) + ".\n- Files of which each rank reads its own part (" +
                   "[many_machines.md](many_machines.md)): " + those(Format::kParts) + ".\n");
  expect_block("README.md", "formats", names_of_formats(FormatsThat::hold_spheres));
  const std::string schema = text_in("docs/scene.schema.json"), page = text_in("docs/formats.md");
  for (const TrajectoryFormat* format : trajectory_formats()) {
    EXPECT_THAT(page, HasSubstr("\n| " + split(format->name)[0] + " ["));
    EXPECT_THAT(schema, HasSubstr(split(format->name)[0]));
  }
}

// The page sorts files before it has read any.
TEST(FormatPages, TheBrowserKnowsTrajectories) {
  std::string endings;
  for (const TrajectoryFormat* format : trajectory_formats())
    for (const std::string& ending : split(format->files)) endings += (endings.empty() ? "" : "|") + ending.substr(1);
  EXPECT_THAT(text_in("web/src/sources.ts"), HasSubstr("/\\.(" + endings + ")$/i"));
}

}  // namespace
}  // namespace bihive
