#include "bihive/base/open_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <ctime>

namespace bihive {

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

int write_whole(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written == 0) return EIO;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int flush_to_disk(int file) {
  while (::fsync(file) != 0)
    if (errno != EINTR) return errno == EINVAL ? 0 : errno;
  return 0;
}

std::string random_digits() {
  unsigned long long bits = 0;
  if (::getentropy(&bits, sizeof(bits)) != 0) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    bits =
        static_cast<unsigned long long>(now.tv_nsec) * 0x9e3779b97f4a7c15u ^ static_cast<unsigned long long>(getpid());
  }
  char digits[17];
  std::snprintf(digits, sizeof(digits), "%016llx", bits);
  return digits;
}

}  // namespace bihive
