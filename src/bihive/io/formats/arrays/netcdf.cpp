// NetCDF in its classic forms [NetCDF]: a head that lists dimensions, attributes and variables, then the variables'
// numbers, big endian. Variables over the one dimension that grows lie record by record.
#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/io/formats/arrays/array_file.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/packed/byte_reader.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/without_throwing.h"

namespace bihive {
namespace {

// Files of simulations have some dozens of each.
constexpr std::uint64_t kMostInList = 10000;
constexpr std::uint64_t kMostNameBytes = 4096;
constexpr std::int64_t kMostHeadBytes = std::int64_t{64} << 20;

constexpr std::uint32_t kDimensionList = 10, kVariableList = 11, kAttributeList = 12;

// NC_BYTE, NC_CHAR, NC_SHORT, NC_INT, NC_FLOAT, NC_DOUBLE, then those of CDF-5: NC_UBYTE to NC_UINT64.
constexpr NumberType kNetcdfTypes[] = {{'i', 0}, {'i', 1}, {'u', 1}, {'i', 2}, {'i', 4}, {'f', 4},
                                       {'f', 8}, {'u', 1}, {'u', 2}, {'u', 4}, {'i', 8}, {'u', 8}};
constexpr std::uint32_t kNetcdfChar = 2;

NumberType netcdf_type(std::uint32_t type) {
  NumberType found = kNetcdfTypes[type];
  found.big_endian = true;
  return found;
}

struct NetcdfAttribute {
  std::string text;              // if it is one
  std::optional<double> number;  // if it is one number
};
using NetcdfAttributes = std::map<std::string, NetcdfAttribute>;

struct NetcdfVariable {
  std::uint32_t type = 0;
  std::uint64_t begin = 0;
  bool grows = false;
  std::uint64_t row_bytes = 0;  // of one record, or of all of it
  NetcdfAttributes attributes;
};

class NetcdfFile : public ArrayFile {
 public:
  explicit NetcdfFile(RandomFile file) : file_(std::move(file)) {}

  const std::string& path() const override { return file_.path(); }
  const std::vector<ArrayFacts>& arrays() const override { return arrays_; }

  Status open() {
    // The head's length is not stated: take more of the file until it is whole.
    for (std::int64_t count = std::min<std::int64_t>(1 << 16, file_.size());; count *= 8) {
      count = std::min(count, file_.size());
      const Result<std::string> bytes = file_.read(0, count);
      if (!bytes) return bytes.error();
      arrays_.clear();
      variables_.clear();
      attributes_.clear();
      warnings_.clear();
      ends_early_ = false;
      if (Status status = read_head(*bytes); !status) {
        if (!ends_early_) return status;
        if (count < file_.size() && count < kMostHeadBytes) continue;
        return damaged("it ends in its head");
      }
      return Done{};
    }
  }

  Result<std::vector<double>> read(const ArrayFacts& array, const std::vector<std::int64_t>& begin,
                                   const std::vector<std::int64_t>& lengths) const override {
    const auto found = variables_.find(array.name);
    BIHIVE_CHECK(found != variables_.end() && begin.size() == array.lengths.size());
    const NetcdfVariable& variable = found->second;
    const NumberType type = netcdf_type(variable.type);
    double total = sizeof(double);
    for (const std::int64_t length : lengths) total *= static_cast<double>(length);
    if (Status status = check_memory(total, "the array " + quote(array.name)); !status)
      return Error{status.error().message, path(), 0, 0, ""};

    // The longest run of numbers that lie behind each other: the last dimension that is not taken as a whole, and all
    // behind it. A record ends each run of a variable that grows.
    const std::size_t rank = lengths.size();
    const std::size_t first_whole = variable.grows ? 1 : 0;
    std::size_t split = rank;
    std::int64_t run = 1;
    while (split > first_whole) {
      --split;
      run *= lengths[split];
      if (lengths[split] != array.lengths[split]) break;
    }
    std::vector<double> values;
    std::vector<std::int64_t> at(begin.begin(), begin.begin() + static_cast<std::ptrdiff_t>(split));
    if (std::any_of(lengths.begin(), lengths.end(), [](std::int64_t length) { return length == 0; })) return values;
    for (;;) {
      // Where the run begins.
      std::uint64_t place = variable.begin, inner = 0;
      for (std::size_t k = 0; k < rank; ++k) {
        const auto index = static_cast<std::uint64_t>(k < split ? at[k] : begin[k]);
        if (k == 0 && variable.grows)
          place += index * record_bytes_;
        else
          inner = inner * static_cast<std::uint64_t>(array.lengths[k]) + index;
      }
      place += inner * type.size;
      const Result<std::string> bytes =
          file_.read(static_cast<std::int64_t>(place), run * static_cast<std::int64_t>(type.size));
      if (!bytes) return bytes.error();
      for (std::size_t i = 0; i < bytes->size(); i += type.size) values.push_back(number_at(bytes->data() + i, type));
      // The next run.
      std::size_t k = split;
      while (k > 0 && ++at[k - 1] == begin[k - 1] + lengths[k - 1]) {
        at[k - 1] = begin[k - 1];
        --k;
      }
      if (k == 0) return values;
    }
  }

  std::optional<std::string> text(const std::string& object, const std::string& attribute) const override {
    const NetcdfAttribute* const found = attribute_of(object, attribute);
    if (found == nullptr || found->number) return std::nullopt;
    return found->text;
  }
  std::optional<double> number(const std::string& object, const std::string& attribute) const override {
    const NetcdfAttribute* const found = attribute_of(object, attribute);
    return found == nullptr ? std::nullopt : found->number;
  }

 private:
  Error damaged(const std::string& what) const { return {"the NetCDF file is damaged: " + what, path(), 0, 0, ""}; }
  Error cut() {
    ends_early_ = true;
    return damaged("it ends in its head");
  }
  const NetcdfAttribute* attribute_of(const std::string& object, const std::string& attribute) const {
    const auto variable = variables_.find(object);
    if (variable == variables_.end() && object != "/") return nullptr;
    const NetcdfAttributes& all = object == "/" ? attributes_ : variable->second.attributes;
    const auto found = all.find(attribute);
    return found == all.end() ? nullptr : &found->second;
  }

  // A count or a length, of 4 bytes before CDF-5.
  bool take_size(ByteReader& head, std::uint64_t& size) const {
    if (version_ == 5) return head.take(size);
    std::uint32_t small = 0;
    const bool taken = head.take(small);
    size = small;
    return taken;
  }

  // The tag and the count of a list; an absent one has zeros.
  Status take_list(ByteReader& head, std::uint32_t wanted, std::uint64_t& count) {
    std::uint32_t tag = 0;
    if (!head.take(tag) || !take_size(head, count)) return cut();
    if (tag == 0 && count == 0) return Done{};
    if (tag != wanted || count > kMostInList) return damaged("a list of its head has an unknown mark or length");
    return Done{};
  }

  Status take_padded(ByteReader& head, std::uint64_t count, std::string_view& bytes) {
    if (!head.take(static_cast<std::size_t>(count), bytes) || !head.skip((4 - count % 4) % 4)) return cut();
    return Done{};
  }

  Status take_name(ByteReader& head, std::string& name) {
    std::uint64_t length = 0;
    if (!take_size(head, length)) return cut();
    if (length > kMostNameBytes) return damaged("a name is too long");
    std::string_view bytes;
    if (Status status = take_padded(head, length, bytes); !status) return status;
    name = std::string(bytes);
    return Done{};
  }

  Status take_type(ByteReader& head, std::uint32_t& type) {
    if (!head.take(type)) return cut();
    if (type < 1 || type >= std::size(kNetcdfTypes)) return damaged("a number has an unknown type");
    return Done{};
  }

  Status take_attributes(ByteReader& head, NetcdfAttributes& attributes) {
    std::uint64_t count = 0;
    if (Status status = take_list(head, kAttributeList, count); !status) return status;
    for (std::uint64_t i = 0; i < count; ++i) {
      std::string name;
      std::uint32_t type = 0;
      std::uint64_t length = 0;
      if (Status status = take_name(head, name); !status) return status;
      if (Status status = take_type(head, type); !status) return status;
      if (!take_size(head, length)) return cut();
      const NumberType kind = netcdf_type(type);
      if (length > static_cast<std::uint64_t>(kMostHeadBytes)) return damaged("an attribute is too long");
      std::string_view bytes;
      if (Status status = take_padded(head, length * kind.size, bytes); !status) return status;
      NetcdfAttribute& attribute = attributes[name];
      attribute = {};
      if (type == kNetcdfChar)
        attribute.text = std::string(bytes.substr(0, bytes.find('\0')));
      else if (length == 1)
        attribute.number = number_at(bytes.data(), kind);
    }
    return Done{};
  }

  Status read_head(std::string_view bytes) {
    ByteReader head(bytes, ByteOrder::big);
    std::string_view magic;
    if (!head.take(4, magic)) return cut();
    version_ = magic[3];
    std::uint64_t records = 0, count = 0;
    if (!take_size(head, records)) return cut();

    // Dimensions; the one of length 0 grows.
    if (Status status = take_list(head, kDimensionList, count); !status) return status;
    std::vector<std::uint64_t> dimensions;
    for (std::uint64_t i = 0; i < count; ++i) {
      std::string name;
      std::uint64_t length = 0;
      if (Status status = take_name(head, name); !status) return status;
      if (!take_size(head, length)) return cut();
      dimensions.push_back(length);
    }
    if (Status status = take_attributes(head, attributes_); !status) return status;

    // Variables.
    if (Status status = take_list(head, kVariableList, count); !status) return status;
    std::vector<std::pair<std::string, std::vector<std::uint64_t>>> named;
    for (std::uint64_t i = 0; i < count; ++i)
      if (Status status = read_variable(head, dimensions, named); !status) return status;
    return place_variables(named, records);
  }

  Status read_variable(ByteReader& head, const std::vector<std::uint64_t>& dimensions,
                       std::vector<std::pair<std::string, std::vector<std::uint64_t>>>& named) {
    std::string name;
    std::uint64_t rank = 0;
    if (Status status = take_name(head, name); !status) return status;
    if (!take_size(head, rank)) return cut();
    if (rank > 32) return damaged("a variable has more than 32 dimensions");
    NetcdfVariable variable;
    std::vector<std::uint64_t> lengths;
    for (std::uint64_t k = 0; k < rank; ++k) {
      std::uint64_t id = 0;
      if (!take_size(head, id)) return cut();
      if (id >= dimensions.size()) return damaged("a variable has a dimension that does not exist");
      if (dimensions[id] == 0 && k == 0) variable.grows = true;
      if (dimensions[id] == 0 && k > 0) return damaged("a variable grows along another dimension than the first");
      lengths.push_back(dimensions[id]);
    }
    if (Status status = take_attributes(head, variable.attributes); !status) return status;
    if (Status status = take_type(head, variable.type); !status) return status;
    std::uint64_t stated_bytes = 0;
    std::uint32_t begin = 0;
    if (!take_size(head, stated_bytes)) return cut();
    if (version_ == 1 ? !head.take(begin) : !head.take(variable.begin)) return cut();
    if (version_ == 1) variable.begin = begin;
    // The stated length may be wrong where it is large: the dimensions tell.
    variable.row_bytes = netcdf_type(variable.type).size;
    for (std::size_t k = variable.grows ? 1 : 0; k < lengths.size(); ++k) {
      if (lengths[k] > std::uint64_t(std::numeric_limits<std::int64_t>::max()) / variable.row_bytes)
        return damaged("the variable " + quote(name) + " is too large");
      variable.row_bytes *= lengths[k];
    }
    if (variables_.contains(name)) return damaged("the variable " + quote(name) + " comes twice");
    variables_[name] = std::move(variable);
    named.emplace_back(name, std::move(lengths));
    return Done{};
  }

  // Says where each one lies. The number of records of a file that is cut, or still written, is that of whole records.
  Status place_variables(const std::vector<std::pair<std::string, std::vector<std::uint64_t>>>& named,
                         std::uint64_t records) {
    const auto size = static_cast<std::uint64_t>(file_.size());
    std::size_t growing = 0;
    for (const auto& [name, variable] : variables_) growing += variable.grows ? 1 : 0;
    record_bytes_ = 0;
    for (const auto& [name, variable] : variables_) {
      if (!variable.grows) continue;
      const std::uint64_t padded = growing == 1 ? variable.row_bytes : (variable.row_bytes + 3) / 4 * 4;
      if (padded > size) return records == 0 ? Status(Done{}) : damaged("its records lie outside of it");
      record_bytes_ += padded;
    }
    // Variables lie beside each other. If they lay in each other, few bytes would be many numbers.
    std::uint64_t whole = record_bytes_ > size ? 0 : records, fixed_bytes = 0;
    for (const auto& [name, variable] : variables_) {
      if (variable.begin > size) return damaged("the variable " + quote(name) + " lies outside of it");
      const std::uint64_t left = size - variable.begin;
      if (!variable.grows && variable.row_bytes > left)
        return damaged("the variable " + quote(name) + " lies outside of it");
      if (!variable.grows && (fixed_bytes += variable.row_bytes) > size)
        return damaged("its variables have more bytes than it has");
      if (variable.grows)
        whole = std::min(whole, variable.row_bytes > left || record_bytes_ == 0
                                    ? 0
                                    : (left - variable.row_bytes) / record_bytes_ + 1);
    }
    warn_of_cut(growing, records, whole);
    for (const auto& [name, lengths] : named) {
      const NetcdfVariable& variable = variables_[name];
      if (variable.type == kNetcdfChar) continue;
      ArrayFacts facts{name, {}};
      for (const std::uint64_t length : lengths) facts.lengths.push_back(static_cast<std::int64_t>(length));
      if (variable.grows) facts.lengths[0] = static_cast<std::int64_t>(whole);
      arrays_.push_back(std::move(facts));
    }
    return Done{};
  }

  // A file that was still written states no number of records; then bytes behind the whole ones tell.
  void warn_of_cut(std::size_t growing, std::uint64_t records, std::uint64_t whole) {
    if (growing == 0 || whole >= records) return;
    const std::uint64_t unstated = version_ == 5 ? std::numeric_limits<std::uint64_t>::max() : 0xFFFFFFFF;
    std::uint64_t begin = std::numeric_limits<std::uint64_t>::max();
    for (const auto& [name, variable] : variables_)
      if (variable.grows) begin = std::min(begin, variable.begin);
    constexpr std::uint64_t kPadding = 3;
    if (records == unstated && static_cast<std::uint64_t>(file_.size()) <= begin + whole * record_bytes_ + kPadding)
      return;
    warnings_.push_back("the file ends inside frame " + std::to_string(whole) + ", which is left out: it may be cut");
  }

  RandomFile file_;
  char version_ = 1;
  bool ends_early_ = false;
  std::uint64_t record_bytes_ = 0;
  NetcdfAttributes attributes_;
  std::map<std::string, NetcdfVariable> variables_;
  std::vector<ArrayFacts> arrays_;
};

}  // namespace

Result<std::shared_ptr<const ArrayFile>> open_netcdf(RandomFile file) {
  const std::string name = file.path();
  return without_throwing(name, [&]() -> Result<std::shared_ptr<const ArrayFile>> {
    auto opened = std::make_shared<NetcdfFile>(std::move(file));
    if (Status status = opened->open(); !status) return status.error();
    return std::shared_ptr<const ArrayFile>(std::move(opened));
  });
}

}  // namespace bihive
