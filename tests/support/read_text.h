// Reads spheres from text in a test, and reports an error in one line.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "bihive/io/read_spheres.h"

namespace bihive::test {

/// The spheres of a file with this text; the test fails on an error.
inline SphereFile read_text(std::string_view text, const std::string& name, const ReadOptions& options = {}) {
  Result<SphereFile> file = read_spheres_from_memory(text, name, options);
  EXPECT_TRUE(file.ok()) << file.error().to_string();
  return file.ok() ? *file : SphereFile{};
}

/// The error message for this text; the test fails if there is no error.
inline std::string error_of(std::string_view text, const std::string& name, const ReadOptions& options = {}) {
  const Result<SphereFile> file = read_spheres_from_memory(text, name, options);
  EXPECT_FALSE(file.ok()) << name << " was read, but should not have been";
  return file.ok() ? "" : file.error().to_string();
}

/// The text with `to` in the place of the first `from`; the test fails where there is none.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

inline ReadOptions at_frame(std::int64_t frame) {
  ReadOptions options;
  options.frame = frame;
  return options;
}

/// The values of a named number, or nothing.
inline std::vector<double> numbers_of(const SphereFile& file, const std::string& name) {
  for (const NamedNumbers& column : file.spheres.attributes().numbers)
    if (column.name == name) return column.values;
  return {};
}

/// The texts of a column, by id; none without the column.
inline std::vector<std::string> texts_of(const SphereFile& file, const char* name) {
  const NamedTexts* const column = file.spheres.attributes().find_texts(name);
  std::vector<std::string> all;
  for (std::int64_t id = 0; column != nullptr && id < file.spheres.size(); ++id)
    all.push_back(column->of(static_cast<std::size_t>(id)));
  return all;
}

inline std::vector<std::string> number_names(const SphereFile& file) {
  std::vector<std::string> names;
  for (const NamedNumbers& column : file.spheres.attributes().numbers) names.push_back(column.name);
  return names;
}

}  // namespace bihive::test
