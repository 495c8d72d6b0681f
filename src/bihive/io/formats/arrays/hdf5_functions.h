// The functions of libhdf5, which is looked for when a file needs it: linked with it and the 35 libraries that it
// brings, every start of a program took 26 ms more (docs/decisions/0033-hdf5-when-it-is-needed.md).
#pragma once

#include <hdf5.h>

#include <mutex>

#include "bihive/base/result.h"

// NOLINTBEGIN(cppcoreguidelines-macro-usage)
#define BIHIVE_HDF5_FUNCTIONS(X)  \
  X(H5open)                       \
  X(H5get_libversion)             \
  X(H5free_memory)                \
  X(H5Zfilter_avail)              \
  X(H5PLget_loading_state)        \
  X(H5PLset_loading_state)        \
  X(H5Fopen)                      \
  X(H5Fclose)                     \
  X(H5Pcreate)                    \
  X(H5Pclose)                     \
  X(H5Pset_fapl_core)             \
  X(H5Pset_file_image)            \
  X(H5Pset_elink_cb)              \
  X(H5Pget_layout)                \
  X(H5Pget_chunk)                 \
  X(H5Pget_external_count)        \
  X(H5Pget_external)              \
  X(H5Pget_virtual_count)         \
  X(H5Pget_virtual_filename)      \
  X(H5Pget_nfilters)              \
  X(H5Pget_filter2)               \
  X(H5Gget_info)                  \
  X(H5Lget_name_by_idx)           \
  X(H5Oopen)                      \
  X(H5Oclose)                     \
  X(H5Iget_type)                  \
  X(H5Dget_space)                 \
  X(H5Dget_type)                  \
  X(H5Dget_create_plist)          \
  X(H5Dget_storage_size)          \
  X(H5Dget_chunk_storage_size)    \
  X(H5Dread)                      \
  X(H5Screate_simple)             \
  X(H5Sclose)                     \
  X(H5Sget_simple_extent_ndims)   \
  X(H5Sget_simple_extent_dims)    \
  X(H5Sget_simple_extent_npoints) \
  X(H5Sselect_hyperslab)          \
  X(H5Tget_class)                 \
  X(H5Tget_size)                  \
  X(H5Tget_super)                 \
  X(H5Tclose)                     \
  X(H5Tconvert)                   \
  X(H5Tis_variable_str)           \
  X(H5Tget_nmembers)              \
  X(H5Tget_member_name)           \
  X(H5Tget_member_value)          \
  X(H5Aexists)                    \
  X(H5Aopen)                      \
  X(H5Aget_type)                  \
  X(H5Aget_space)                 \
  X(H5Aread)                      \
  X(H5Aclose)                     \
  X(H5Eget_auto2)                 \
  X(H5Eset_auto2)
// NOLINTEND(cppcoreguidelines-macro-usage)

namespace bihive {

struct Hdf5Functions {
// NOLINTNEXTLINE(bugprone-macro-parentheses): it declares the name
#define BIHIVE_HDF5_DECLARE(name) decltype(&::name) name = nullptr;
  BIHIVE_HDF5_FUNCTIONS(BIHIVE_HDF5_DECLARE)
#undef BIHIVE_HDF5_DECLARE
  hid_t native_double = -1, file_access = -1, link_access = -1;
};

/// Loads the library when it is called first. Error: it is not there, or of another version than the headers.
Result<const Hdf5Functions*> hdf5_functions();

/// One thread at a time is in the library, which prints nothing and loads no plug-ins meanwhile.
class Hdf5Turn {
 public:
  explicit Hdf5Turn(const Hdf5Functions& hdf5);
  ~Hdf5Turn();
  Hdf5Turn(const Hdf5Turn&) = delete;
  Hdf5Turn& operator=(const Hdf5Turn&) = delete;

 private:
  const Hdf5Functions& hdf5_;
  std::unique_lock<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* print_to_ = nullptr;
  unsigned plug_ins_ = 0;
};

}  // namespace bihive
