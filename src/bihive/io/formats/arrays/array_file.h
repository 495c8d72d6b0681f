// A file that holds arrays of numbers under names: HDF5 or NetCDF. Others know the meaning of the arrays.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/packed/random_file.h"

namespace bihive {

struct ArrayFacts {
  std::string name;                   ///< HDF5: "/particles/all/position/value"; NetCDF: "coordinates"
  std::vector<std::int64_t> lengths;  ///< of each dimension; none: one number
};

/// An array that the file names and that is not read.
struct RefusedArray {
  std::string name;
  std::string what;  ///< a sentence: "the data set '/x' keeps its numbers in another file ('y.raw')"
  std::string hint;
  bool is_fault = true;  ///< false: the rest of the file is read without it
};

/// Any number of threads may read at a time.
class ArrayFile {
 public:
  virtual ~ArrayFile() = default;

  virtual const std::string& path() const = 0;
  /// Every array of numbers.
  virtual const std::vector<ArrayFacts>& arrays() const = 0;
  /// Groups and arrays that are named in it but are not read, as no reader opens another file or loads a plug-in.
  virtual const std::vector<RefusedArray>& refused() const { return none_refused_; }
  /// Remarks for the user on the file as a whole, one line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The part of an array that begins at `begin` and has `lengths` numbers along each dimension, row after row. It lies
  /// within the array. Errors: damaged bytes, a library that fails, more than the memory holds.
  virtual Result<std::vector<double>> read(const ArrayFacts& array, const std::vector<std::int64_t>& begin,
                                           const std::vector<std::int64_t>& lengths) const = 0;
  /// An attribute of an array or a group, or of the file ("/"), that is a text or one number; nothing if there is none.
  virtual std::optional<std::string> text(const std::string& object, const std::string& attribute) const = 0;
  /// An attribute that is one text or an array of some; often none.
  virtual std::vector<std::string> texts(const std::string& /*object*/, const std::string& /*attribute*/) const {
    return {};
  }
  virtual std::optional<double> number(const std::string& object, const std::string& attribute) const = 0;
  /// The names that stand for numbers in an array; often none.
  virtual std::vector<std::pair<double, std::string>> labels(const ArrayFacts&) const { return {}; }

  /// The array of that name, or null.
  const ArrayFacts* find(std::string_view name) const;
  Result<std::vector<double>> read_all(const ArrayFacts& array) const;
  /// The first refused array that belongs to what is asked for: it itself, the group above it, or all below it (an
  /// empty name: the whole file). Null if there is none. `faults`: those alone that are faults.
  const RefusedArray* find_refused(std::string_view name, bool faults) const;

 protected:
  std::vector<std::string> warnings_;

 private:
  std::vector<RefusedArray> none_refused_;
};

/// Whether the first bytes are those of the format.
bool looks_like_hdf5(std::string_view first_bytes);
bool looks_like_netcdf(std::string_view first_bytes);

/// HDF5, by libhdf5, which is looked for when it is called first. Errors: it is not there; a damaged file.
Result<std::shared_ptr<const ArrayFile>> open_hdf5(RandomFile file);
/// NetCDF in its classic forms (CDF-1, CDF-2, CDF-5). NetCDF-4 is HDF5.
Result<std::shared_ptr<const ArrayFile>> open_netcdf(RandomFile file);

}  // namespace bihive
