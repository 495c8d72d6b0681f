#include "bihive/io/formats/arrays/hdf5_functions.h"

#include <dlfcn.h>

#include <string>

namespace bihive {
namespace {

std::mutex& hdf5_lock() {
  static std::mutex lock;
  return lock;
}

Result<Hdf5Functions> load_hdf5() {
  const char* const kLibrary = BIHIVE_HDF5_LIBRARY;
  const std::string hint = "install the library of the package libhdf5-dev (scripts/setup demo)";
  void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    return Error{std::string(kLibrary) + " reads HDF5 files, and is not installed", "", 0, 0, hint};
  Hdf5Functions functions;
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast)
#define BIHIVE_HDF5_LOAD(name)                                                        \
  functions.name = reinterpret_cast<decltype(functions.name)>(dlsym(library, #name)); \
  if (functions.name == nullptr) return Error{std::string(kLibrary) + " has no " #name, "", 0, 0, hint};
  BIHIVE_HDF5_FUNCTIONS(BIHIVE_HDF5_LOAD)
#undef BIHIVE_HDF5_LOAD
  const auto* const native_double = reinterpret_cast<const hid_t*>(dlsym(library, "H5T_NATIVE_DOUBLE_g"));
  const auto* const file_access = reinterpret_cast<const hid_t*>(dlsym(library, "H5P_CLS_FILE_ACCESS_ID_g"));
  const auto* const link_access = reinterpret_cast<const hid_t*>(dlsym(library, "H5P_CLS_LINK_ACCESS_ID_g"));
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  unsigned major = 0, minor = 0, release = 0;
  if (native_double == nullptr || file_access == nullptr || link_access == nullptr || functions.H5open() < 0 ||
      functions.H5get_libversion(&major, &minor, &release) < 0 || major != H5_VERS_MAJOR || minor != H5_VERS_MINOR)
    return Error{std::string(kLibrary) + " is of another version than bihive was built for", "", 0, 0,
                 "build bihive again"};
  functions.native_double = *native_double;
  functions.file_access = *file_access;
  functions.link_access = *link_access;
  return functions;
}

}  // namespace

Result<const Hdf5Functions*> hdf5_functions() {
  static const Result<Hdf5Functions> functions = load_hdf5();
  if (!functions) return functions.error();
  return &*functions;
}

Hdf5Turn::Hdf5Turn(const Hdf5Functions& hdf5) : hdf5_(hdf5), lock_(hdf5_lock()) {
  hdf5_.H5Eget_auto2(H5E_DEFAULT, &print_, &print_to_);
  hdf5_.H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  // Other users of the library in this process keep their plug-ins.
  hdf5_.H5PLget_loading_state(&plug_ins_);
  hdf5_.H5PLset_loading_state(0);
}

Hdf5Turn::~Hdf5Turn() {
  hdf5_.H5PLset_loading_state(plug_ins_);
  hdf5_.H5Eset_auto2(H5E_DEFAULT, print_, print_to_);
}

}  // namespace bihive
