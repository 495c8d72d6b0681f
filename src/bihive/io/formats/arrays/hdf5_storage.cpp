#include "bihive/io/formats/arrays/hdf5_storage.h"

#include <algorithm>

#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// zlib packs at most a thousandfold. Other filters pack equal numbers to nothing, so that small data sets may have any
// share.
constexpr double kMostPacked = 1100, kAnyShareBytes = 1 << 26;

constexpr const char* kOneFile =
    "bihive opens no file that another one names: copy all into one file, for example with h5py";

RefusedArray lies_elsewhere(const std::string& name, const std::string& file) {
  return {name, "the data set " + quote(name) + " keeps its numbers in another file (" + quote(file) + ")", kOneFile,
          true};
}

std::string external_file(const Hdf5Functions& hdf5, hid_t facts) {
  char file[256] = {};
  off_t offset = 0;
  hsize_t size = 0;
  if (hdf5.H5Pget_external(facts, 0, sizeof file - 1, file, &offset, &size) < 0) return "?";
  return file;
}

std::string virtual_file(const Hdf5Functions& hdf5, hid_t facts) {
  char file[256] = {};
  std::size_t count = 0;
  if (hdf5.H5Pget_virtual_count(facts, &count) < 0 || count == 0) return "?";
  if (hdf5.H5Pget_virtual_filename(facts, 0, file, sizeof file) < 0) return "?";
  return file;
}

// The first filter that the library does not have by itself.
RefusedArray unknown_filter(const Hdf5Functions& hdf5, hid_t facts, const std::string& name) {
  const int filters = hdf5.H5Pget_nfilters(facts);
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    char filter[256] = {};
    const H5Z_filter_t id = hdf5.H5Pget_filter2(facts, static_cast<unsigned>(i), &flags, &values, nullptr,
                                                sizeof filter - 1, filter, &config);
    if (id >= 0 && hdf5.H5Zfilter_avail(id) > 0) continue;
    const std::string which = (*filter != '\0' ? quote(filter) + ", " : std::string()) + std::to_string(id);
    return {name,
            "the data set " + quote(name) + " is packed by a filter that libhdf5 has only as a plug-in (" + which + ")",
            "pack it again with gzip, where the plug-in is installed: h5repack -f GZIP=4 IN OUT", true};
  }
  return {name, "", "", false};
}

}  // namespace

RefusedArray refusal_of(const Hdf5Functions& hdf5, hid_t set, const std::string& name) {
  const Hdf5Handle facts(hdf5.H5Dget_create_plist(set), hdf5.H5Pclose);
  if (!facts.ok()) return {name, "libhdf5 cannot say where the data set " + quote(name) + " lies", "", true};
  if (hdf5.H5Pget_layout(facts.id()) == H5D_VIRTUAL) {
    const std::string file = virtual_file(hdf5, facts.id());
    if (file != ".") return lies_elsewhere(name, file);
    return {name, "the data set " + quote(name) + " is put together from others (a virtual data set)",
            "name one of these: FILE:/GROUP/NAME", true};
  }
  if (hdf5.H5Pget_external_count(facts.id()) != 0) return lies_elsewhere(name, external_file(hdf5, facts.id()));
  if (RefusedArray filter = unknown_filter(hdf5, facts.id(), name); !filter.what.empty()) return filter;
  const Hdf5Handle space(hdf5.H5Dget_space(set), hdf5.H5Sclose);
  if (space.ok() && hdf5.H5Sget_simple_extent_npoints(space.id()) > 0 && hdf5.H5Dget_storage_size(set) == 0)
    return {name, "the data set " + quote(name) + " has a shape, but none of its numbers was ever written", "", false};
  return {name, "", "", false};
}

std::string missing_bytes(const Hdf5Functions& hdf5, hid_t set, std::int64_t file_size,
                          const std::vector<hsize_t>& begin, const std::vector<hsize_t>& lengths) {
  const Hdf5Handle facts(hdf5.H5Dget_create_plist(set), hdf5.H5Pclose);
  const Hdf5Handle type(hdf5.H5Dget_type(set), hdf5.H5Tclose);
  const Hdf5Handle space(hdf5.H5Dget_space(set), hdf5.H5Sclose);
  if (!facts.ok() || !type.ok() || !space.ok()) return "libhdf5 cannot say where its numbers lie";
  const auto number_bytes = static_cast<double>(hdf5.H5Tget_size(type.id()));
  const auto in_file = static_cast<double>(file_size);
  const std::size_t rank = lengths.size();

  if (hdf5.H5Pget_layout(facts.id()) != H5D_CHUNKED) {
    const double claimed = number_bytes * static_cast<double>(hdf5.H5Sget_simple_extent_npoints(space.id()));
    const auto stored = static_cast<double>(hdf5.H5Dget_storage_size(set));
    return claimed <= std::min(stored, in_file) ? "" : "fewer numbers are there than its shape says";
  }

  // The chunks that hold the part, one after the other.
  std::vector<hsize_t> chunk(rank), at(rank);
  if (rank == 0 || hdf5.H5Pget_chunk(facts.id(), static_cast<int>(rank), chunk.data()) != static_cast<int>(rank))
    return "its chunks have no shape";
  double chunk_bytes = number_bytes;
  for (std::size_t k = 0; k < rank; ++k) {
    if (chunk[k] == 0) return "its chunks have no shape";
    chunk_bytes *= static_cast<double>(chunk[k]);
    at[k] = begin[k] / chunk[k] * chunk[k];
  }
  double stored = 0, unpacked = 0;
  for (;;) {
    hsize_t bytes = 0;
    if (hdf5.H5Dget_chunk_storage_size(set, at.data(), &bytes) < 0 || bytes == 0)
      return "some of its numbers were never written";
    stored += static_cast<double>(bytes);
    unpacked += chunk_bytes;
    if (stored > in_file) return "it claims more bytes than the file has";
    std::size_t k = rank;
    while (k > 0 && (at[k - 1] += chunk[k - 1]) >= begin[k - 1] + lengths[k - 1]) {
      at[k - 1] = begin[k - 1] / chunk[k - 1] * chunk[k - 1];
      --k;
    }
    if (k == 0) break;
  }
  return unpacked <= kAnyShareBytes + kMostPacked * stored ? "" : "it is packed beyond reason";
}

}  // namespace bihive
