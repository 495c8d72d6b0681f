// Open files of the system.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace bihive {

/// An open file or folder, closed when destroyed.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

/// Writes everything. 0, or the errno of the failure.
int write_whole(int file, std::string_view bytes);

/// Flushes a file to the disk. 0, or the errno of the failure; a file that cannot be flushed is none.
int flush_to_disk(int file);

/// 16 unguessable hexadecimal digits.
std::string random_digits();

/// ".bihive-0123456789abcdef.part": an unguessable name for a file that is not complete.
std::string random_part_name();

}  // namespace bihive
