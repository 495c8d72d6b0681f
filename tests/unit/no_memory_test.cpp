// Where memory is short, reading returns an error and throws nothing: each call of `new` fails once.
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/io/read_spheres.h"

namespace {

// Calls of `new` on this thread until one fails; below 0: none fails.
thread_local long calls_left = -1;

void* allocate(std::size_t size) {
  if (calls_left == 0) {
    calls_left = -1;
    throw std::bad_alloc();
  }
  if (calls_left > 0) --calls_left;
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
// All forms, so that each pair is of this file: other tests share the program, and the address sanitizer compares them.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return allocate(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t& nothrow) noexcept {
  return operator new(size, nothrow);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace bihive {
namespace {

// Calls `read` once for each of its calls of `new`, and lets that one fail. Returns how many there were.
int fail_each(const std::function<bool()>& read) {
  for (int failing = 0; failing < 100000; ++failing) {
    bool succeeded = false;
    calls_left = failing;
    try {
      succeeded = read();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "call " << failing << " of new: " << error.what();
    }
    const bool all_given = calls_left >= 0;
    calls_left = -1;
    if (all_given) {
      EXPECT_TRUE(succeeded);
      return failing;
    }
  }
  ADD_FAILURE() << "no end";
  return 0;
}

class NoMemory : public testing::Test {
 protected:
  void SetUp() override {
    path_ = (std::filesystem::temp_directory_path() / ("bihive_no_memory_" + std::to_string(getpid()))).string();
    std::ofstream(path_) << text_;
  }
  void TearDown() override { std::filesystem::remove(path_); }

  const std::string text_ =
      "3\nwater, so that the text is not a short one\nO 0 0 0\nH 0.757 0.586 0\nH -0.757 0.586 0\n";
  std::string path_;
};

TEST_F(NoMemory, for_a_file) {
  EXPECT_GT(fail_each([&] { return read_file(path_).ok(); }), 1);
}

TEST_F(NoMemory, for_an_open_file) {
  const std::string name = "a name that is longer than a text without memory of its own";
  EXPECT_GT(fail_each([&] {
              std::FILE* const file = std::fopen(path_.c_str(), "r");
              const Result<std::string> read = read_descriptor(fileno(file), name);
              std::fclose(file);
              return read.ok();
            }),
            1);
}

TEST_F(NoMemory, for_packed_bytes) {
  const gzFile packed = gzopen(path_.c_str(), "wb");
  gzwrite(packed, text_.data(), static_cast<unsigned>(text_.size()));
  gzclose(packed);
  const std::string bytes = *read_file(path_);
  ASSERT_EQ(*unpack_if_packed(bytes, path_), text_);
  // The copies that it takes are made before.
  std::vector<std::string> copies(100, bytes);
  EXPECT_GT(fail_each([&] {
              if (copies.empty()) return false;
              std::string copy = std::move(copies.back());
              copies.pop_back();
              return unpack_if_packed(std::move(copy), path_).ok();
            }),
            1);
}

TEST_F(NoMemory, for_spheres) {
  EXPECT_GT(fail_each([&] { return read_spheres(path_, {}).ok(); }), 10);
}

}  // namespace
}  // namespace bihive
