// HDF5 [HDF5], by its library.
#include <algorithm>
#include <functional>
#include <new>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/base/memory.h"
#include "bihive/io/formats/arrays/array_file.h"
#include "bihive/io/formats/arrays/hdf5_functions.h"
#include "bihive/io/formats/arrays/hdf5_storage.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/without_throwing.h"

namespace bihive {
namespace {

// Limits of a file: no simulation has more, and links may go round in circles.
constexpr int kMostGroupsInGroups = 12;
constexpr std::size_t kMostObjects = 20000;
constexpr int kMostDimensions = 8;
constexpr std::size_t kMostTextBytes = 4096;
constexpr hssize_t kMostTexts = 16;

// The flag H5F_ACC_RDONLY and the number H5P_DEFAULT: the macros call the library.
constexpr unsigned kHdf5ReadOnly = 0;
constexpr hid_t kHdf5Default = 0;

// Bytes in memory get a name that no file can have: the library refuses one that is there.
constexpr const char* kNoFile = "/dev/null/in_memory";

using Handle = Hdf5Handle;

// Called before the library follows a link into another file, which ends there.
extern "C" herr_t refuse_link(const char*, const char*, const char* file, const char*, unsigned*, hid_t, void* linked) {
  try {
    *static_cast<std::string*>(linked) = file == nullptr || *file == '\0' ? "?" : file;
  } catch (const std::bad_alloc&) {
    // The link is refused without its name.
  }
  return -1;
}

class Hdf5File : public ArrayFile {
 public:
  Hdf5File(const Hdf5Functions& hdf5, RandomFile file) : h_(hdf5), file_(std::move(file)) {}
  ~Hdf5File() override {
    const Hdf5Turn turn(h_);
    if (id_ >= 0) h_.H5Fclose(id_);
    if (links_ >= 0) h_.H5Pclose(links_);
  }
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  const std::string& path() const override { return file_.path(); }
  const std::vector<ArrayFacts>& arrays() const override { return arrays_; }
  const std::vector<RefusedArray>& refused() const override { return refused_; }

  Status open() {
    const Result<std::string> image = !file_.has_path() ? image_of_file() : std::string();
    if (!image) return image.error();
    const Hdf5Turn turn(h_);
    links_ = h_.H5Pcreate(h_.link_access);
    if (links_ < 0 || h_.H5Pset_elink_cb(links_, refuse_link, &linked_file_) < 0)
      return damaged("libhdf5 takes no rule for links");
    if (image->empty()) {
      // The library opens files by name. This name is that of the file which is open here.
      descriptor_ = file_.another_descriptor();
      id_ = h_.H5Fopen(("/proc/self/fd/" + std::to_string(descriptor_.get())).c_str(), kHdf5ReadOnly, kHdf5Default);
    } else {
      // Bytes without a name: those of a packed file, or of the standard input.
      constexpr std::size_t kGrowth = std::size_t{1} << 20;
      const Handle access(h_.H5Pcreate(h_.file_access), h_.H5Pclose);
      if (!access.ok() || h_.H5Pset_fapl_core(access.id(), kGrowth, false) < 0 ||
          h_.H5Pset_file_image(access.id(), const_cast<char*>(image->data()), image->size()) < 0)
        return damaged("libhdf5 takes no bytes");
      id_ = h_.H5Fopen(kNoFile, kHdf5ReadOnly, access.id());
    }
    if (id_ < 0) return damaged("libhdf5 cannot open it");
    std::size_t objects = 0;
    const Handle root(h_.H5Oopen(id_, "/", links_), h_.H5Oclose);
    return root.ok() ? list(root.id(), "", 0, objects) : damaged("libhdf5 cannot open it");
  }

  Result<std::vector<double>> read(const ArrayFacts& array, const std::vector<std::int64_t>& begin,
                                   const std::vector<std::int64_t>& lengths) const override {
    double total = sizeof(double);
    for (const std::int64_t length : lengths) total *= static_cast<double>(length);
    if (total == 0) return std::vector<double>();
    const std::vector<hsize_t> from(begin.begin(), begin.end()), count(lengths.begin(), lengths.end());
    const int rank = static_cast<int>(count.size());

    const Hdf5Turn turn(h_);
    const Handle set(h_.H5Oopen(id_, array.name.c_str(), links_), h_.H5Oclose);
    if (!set.ok()) return cannot_read(array);
    if (const std::string missing = missing_bytes(h_, set.id(), file_.size(), from, count); !missing.empty())
      return Error{"the data set " + quote(array.name) + ": " + missing, path(), 0, 0, ""};
    if (Status status = check_memory(total, "the data set " + quote(array.name)); !status)
      return Error{status.error().message, path(), 0, 0, ""};
    std::vector<double> values(static_cast<std::size_t>(total / sizeof(double)));
    const Handle space(h_.H5Dget_space(set.id()), h_.H5Sclose);
    if (!space.ok()) return cannot_read(array);
    if (rank > 0 && h_.H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, from.data(), nullptr, count.data(), nullptr) < 0)
      return cannot_read(array);
    const hsize_t one = 1;
    const Handle target(h_.H5Screate_simple(std::max(rank, 1), rank > 0 ? count.data() : &one, nullptr), h_.H5Sclose);
    if (!target.ok() ||
        h_.H5Dread(set.id(), h_.native_double, target.id(), space.id(), kHdf5Default, values.data()) < 0)
      return cannot_read(array);
    return values;
  }

  std::optional<std::string> text(const std::string& object, const std::string& attribute) const override {
    std::vector<std::string> found = texts(object, attribute);
    return found.size() == 1 ? std::optional(std::move(found.front())) : std::nullopt;
  }

  std::vector<std::string> texts(const std::string& object, const std::string& attribute) const override {
    std::vector<std::string> found;
    with_attribute(object, attribute, kMostTexts, [&](hid_t id, hid_t type, std::size_t count) {
      if (h_.H5Tget_class(type) != H5T_STRING) return;
      if (h_.H5Tis_variable_str(type) > 0) {
        std::vector<char*> bytes(count, nullptr);
        if (h_.H5Aread(id, type, bytes.data()) < 0) return;
        for (char* const one : bytes) {
          if (one != nullptr) found.emplace_back(one);
          if (one != nullptr) h_.H5free_memory(one);
        }
        return;
      }
      const std::size_t size = h_.H5Tget_size(type);
      if (size == 0 || size > kMostTextBytes) return;
      std::string bytes(size * count, '\0');
      if (h_.H5Aread(id, type, bytes.data()) < 0) return;
      for (std::size_t i = 0; i < count; ++i) {
        const std::string one = bytes.substr(i * size, size);
        found.emplace_back(trim(one.substr(0, one.find('\0'))));
      }
    });
    return found;
  }

  std::optional<double> number(const std::string& object, const std::string& attribute) const override {
    std::optional<double> found;
    with_attribute(object, attribute, 1, [&](hid_t id, hid_t type, std::size_t) {
      const H5T_class_t kind = h_.H5Tget_class(type);
      double value = 0;
      if ((kind == H5T_INTEGER || kind == H5T_FLOAT) && h_.H5Aread(id, h_.native_double, &value) >= 0) found = value;
    });
    return found;
  }

  std::vector<std::pair<double, std::string>> labels(const ArrayFacts& array) const override {
    std::vector<std::pair<double, std::string>> found;
    const Hdf5Turn turn(h_);
    const Handle set(h_.H5Oopen(id_, array.name.c_str(), links_), h_.H5Oclose);
    if (!set.ok()) return found;
    const Handle type(h_.H5Dget_type(set.id()), h_.H5Tclose);
    if (!type.ok() || h_.H5Tget_class(type.id()) != H5T_ENUM) return found;
    const Handle base(h_.H5Tget_super(type.id()), h_.H5Tclose);
    const int count = h_.H5Tget_nmembers(type.id());
    if (!base.ok() || h_.H5Tget_size(base.id()) > sizeof(double)) return found;
    for (int i = 0; i < std::min(count, 1000); ++i) {
      char* const name = h_.H5Tget_member_name(type.id(), static_cast<unsigned>(i));
      double value = 0;
      if (name != nullptr && h_.H5Tget_member_value(type.id(), static_cast<unsigned>(i), &value) >= 0 &&
          h_.H5Tconvert(base.id(), h_.native_double, 1, &value, nullptr, kHdf5Default) >= 0)
        found.emplace_back(value, name);
      h_.H5free_memory(name);
    }
    return found;
  }

 private:
  // The library keeps a copy of it.
  Result<std::string> image_of_file() const {
    if (Status status = check_memory(2 * static_cast<double>(file_.size()), "the file"); !status)
      return Error{status.error().message, path(), 0, 0, ""};
    return file_.read(0, file_.size());
  }
  Error damaged(const std::string& what) const { return {"the HDF5 file is damaged: " + what, path(), 0, 0, ""}; }
  Error cannot_read(const ArrayFacts& array) const {
    return damaged("libhdf5 cannot read the data set " + quote(array.name));
  }

  // All data sets of numbers below a group.
  Status list(hid_t group, const std::string& name, int depth, std::size_t& objects) {
    H5G_info_t info = {};
    if (h_.H5Gget_info(group, &info) < 0) return damaged("libhdf5 cannot read the group " + quote(name + "/"));
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      if (++objects > kMostObjects)
        return Error{"the HDF5 file holds more than " + std::to_string(kMostObjects) + " objects", path(), 0, 0, ""};
      char link[1024];
      const ssize_t length =
          h_.H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, link, sizeof link, kHdf5Default);
      if (length <= 0 || length >= static_cast<ssize_t>(sizeof link)) continue;
      const std::string path_of_object = name + "/" + link;
      linked_file_.clear();
      const Handle object(h_.H5Oopen(group, link, links_), h_.H5Oclose);
      if (!linked_file_.empty())
        refused_.push_back(
            {path_of_object, quote(path_of_object) + " is a link into another file (" + quote(linked_file_) + ")",
             "bihive opens no file that another one names: copy all into one file, for example with h5py", true});
      // A link to nowhere is none.
      if (!object.ok()) continue;
      const H5I_type_t kind = h_.H5Iget_type(object.id());
      if (kind == H5I_DATASET) take(object.id(), path_of_object);
      if (kind == H5I_GROUP && depth < kMostGroupsInGroups)
        if (Status status = list(object.id(), path_of_object, depth + 1, objects); !status) return status;
    }
    return Done{};
  }

  void take(hid_t set, const std::string& name) {
    const Handle type(h_.H5Dget_type(set), h_.H5Tclose);
    if (!type.ok()) return;
    const H5T_class_t kind = h_.H5Tget_class(type.id());
    if (kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_ENUM) return;
    if (RefusedArray refused = refusal_of(h_, set, name); !refused.what.empty()) {
      refused_.push_back(std::move(refused));
      return;
    }
    const Handle space(h_.H5Dget_space(set), h_.H5Sclose);
    if (!space.ok()) return;
    const int rank = h_.H5Sget_simple_extent_ndims(space.id());
    if (rank < 0 || rank > kMostDimensions) return;
    hsize_t lengths[kMostDimensions] = {};
    if (rank > 0 && h_.H5Sget_simple_extent_dims(space.id(), lengths, nullptr) < 0) return;
    // An array without space has no numbers.
    if (rank == 0 && h_.H5Sget_simple_extent_npoints(space.id()) != 1) return;
    ArrayFacts facts{name, {}};
    for (int k = 0; k < rank; ++k) {
      if (lengths[k] > hsize_t{1} << 60) return;
      facts.lengths.push_back(static_cast<std::int64_t>(lengths[k]));
    }
    arrays_.push_back(std::move(facts));
  }

  // Calls `take_it` with an attribute of 1 to `most` values, its type and their number, if there is such a one.
  void with_attribute(const std::string& object, const std::string& attribute, hssize_t most,
                      const std::function<void(hid_t, hid_t, std::size_t)>& take_it) const {
    const Hdf5Turn turn(h_);
    const Handle owner(h_.H5Oopen(id_, object.c_str(), links_), h_.H5Oclose);
    if (!owner.ok() || h_.H5Aexists(owner.id(), attribute.c_str()) <= 0) return;
    const Handle found(h_.H5Aopen(owner.id(), attribute.c_str(), kHdf5Default), h_.H5Aclose);
    if (!found.ok()) return;
    const Handle type(h_.H5Aget_type(found.id()), h_.H5Tclose);
    const Handle space(h_.H5Aget_space(found.id()), h_.H5Sclose);
    if (!type.ok() || !space.ok()) return;
    const hssize_t count = h_.H5Sget_simple_extent_npoints(space.id());
    if (count >= 1 && count <= most) take_it(found.id(), type.id(), static_cast<std::size_t>(count));
  }

  const Hdf5Functions& h_;
  RandomFile file_;
  Descriptor descriptor_;
  hid_t id_ = -1, links_ = -1;
  std::string linked_file_;  // the file of the link that was met last
  std::vector<ArrayFacts> arrays_;
  std::vector<RefusedArray> refused_;
};

}  // namespace

Result<std::shared_ptr<const ArrayFile>> open_hdf5(RandomFile file) {
  const std::string name = file.path();
  return without_throwing(name, [&]() -> Result<std::shared_ptr<const ArrayFile>> {
    const Result<const Hdf5Functions*> functions = hdf5_functions();
    if (!functions) return Error{functions.error().message, name, 0, 0, functions.error().hint};
    auto opened = std::make_shared<Hdf5File>(**functions, std::move(file));
    if (Status status = opened->open(); !status) return status.error();
    return std::shared_ptr<const ArrayFile>(std::move(opened));
  });
}

}  // namespace bihive
