// Where the numbers of a data set lie: in this file, as bytes that are really there, or somewhere else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/io/formats/arrays/array_file.h"
#include "bihive/io/formats/arrays/hdf5_functions.h"

namespace bihive {

/// An open object of the library.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  hid_t id() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The reason why a data set of that name is not read: another file holds its numbers, a plug-in would have to unpack
/// them, or none was ever written. Its `what` is empty if it can be read. It opens no file; ask before any other call
/// that looks at the set, as a virtual one may open its sources to tell its shape.
RefusedArray refusal_of(const Hdf5Functions& hdf5, hid_t set, const std::string& name);

/// Whether the file can hold this many bytes of a data set: stored in it, or packed within reason.
/// The message of an error, or an empty text.
std::string missing_bytes(const Hdf5Functions& hdf5, hid_t set, std::int64_t file_size,
                          const std::vector<hsize_t>& begin, const std::vector<hsize_t>& lengths);

}  // namespace bihive
