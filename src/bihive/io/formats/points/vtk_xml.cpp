// VTK's XML format [VTK-format]: files of PolyData (.vtp), UnstructuredGrid (.vtu) and StructuredGrid (.vts). The
// elements and attributes that VTK writes are found by their tags; appended raw bytes are no XML, so no XML library
// reads all of it.
#include <algorithm>
#include <map>
#include <optional>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/points/vtk_arrays.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/text/text_scanner.h"

#if BIHIVE_HAS_ZLIB
#include <zlib.h>
#endif

namespace bihive {
namespace {

using XmlAttributes = std::map<std::string, std::string>;

struct DataArray {
  XmlAttributes attributes;
  std::size_t piece = 0;
  bool is_places = false;
  std::string_view content;
  std::int64_t line = 0;
};

bool is_xml_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// The bytes of base64 text up to its padding or to another character; blanks are skipped. `used` counts the characters.
std::string from_base64(std::string_view text, std::size_t most, std::size_t& used) {
  std::string bytes;
  bytes.reserve(std::min(most, text.size() / 4 * 3 + 3));
  std::uint32_t bits = 0;
  int have = 0;
  for (used = 0; used < text.size() && bytes.size() < most; ++used) {
    const char c = text[used];
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+') value = 62;
    if (c == '/') value = 63;
    if (value < 0) {
      if (is_xml_space(c)) continue;
      break;
    }
    bits = (bits << 6 | static_cast<std::uint32_t>(value)) & 0xffffff;
    if (++have == 1) continue;
    bytes += static_cast<char>(bits >> (8 - 2 * have) & 0xff);
    if (have == 4) have = 0;
  }
  // A group of four ends here: padding belongs to it.
  while (used < text.size() && text[used] == '=') ++used;
  return bytes;
}

std::optional<NumberType> xml_type(std::string_view name) {
  struct Named {
    std::string_view name;
    NumberType type;
  };
  static constexpr Named names[] = {
      {"Float32", {'f', 4}}, {"Float64", {'f', 8}}, {"Int8", {'i', 1}},   {"UInt8", {'u', 1}}, {"Int16", {'i', 2}},
      {"UInt16", {'u', 2}},  {"Int32", {'i', 4}},   {"UInt32", {'u', 4}}, {"Int64", {'i', 8}}, {"UInt64", {'u', 8}}};
  for (const Named& one : names)
    if (one.name == name) return one.type;
  return std::nullopt;
}

class VtkXmlReader {
 public:
  VtkXmlReader(std::string_view bytes, const std::string& file, const ColumnChoice& choice)
      : bytes_(bytes), file_(file), choice_(choice) {}

  Result<RawSpheres> read() {
    if (Status status = find_arrays(); !status) return status.error();
    // Pieces follow each other. An array that is not in all pieces with points is left out.
    std::string left_out;
    const std::vector<std::vector<const DataArray*>> kept = common_arrays(left_out);
    std::vector<double> places;
    std::vector<PointArray> arrays;
    for (const std::vector<const DataArray*>& pieces : kept) {
      const DataArray& first = *pieces.front();
      arrays.push_back({printable(value_of(first, "Name")),
                        components_of(first),
                        value_of(first, "type").substr(0, 5) != "Float",
                        {}});
    }
    std::size_t with_points = 0;
    for (std::size_t piece = 0; piece < points_of_piece_.size(); ++piece) {
      const std::int64_t points = points_of_piece_[piece];
      if (points == 0) continue;
      const std::size_t before = places.size();
      for (const DataArray& array : arrays_) {
        if (array.piece != piece || !array.is_places) continue;
        if (components_of(array) != 3) return error(array, "places must have three components");
        if (Status status = decode(array, points, places); !status) return status.error();
      }
      if (places.size() != before + 3 * static_cast<std::size_t>(points))
        return Error{"a piece of " + std::to_string(points) + " points has places of others or none", file_, 0, 0, ""};
      for (std::size_t i = 0; i < kept.size(); ++i)
        if (Status status = decode(*kept[i][with_points], points, arrays[i].values); !status) return status.error();
      ++with_points;
    }
    if (places.empty()) return Error{"there are no Points in it", file_, 0, 0, ""};
    return spheres_of_arrays(places, arrays, left_out, file_, choice_);
  }

 private:
  // Arrays of numbers that all pieces with points have, each with its form in every one of these pieces.
  std::vector<std::vector<const DataArray*>> common_arrays(std::string& left_out) const {
    // Arrays of one name are told apart by their order.
    using Key = std::pair<std::string, int>;
    std::map<Key, std::vector<const DataArray*>> found;
    std::vector<Key> order;
    std::size_t with_points = 0;
    for (std::size_t piece = 0; piece < points_of_piece_.size(); ++piece) {
      if (points_of_piece_[piece] == 0) continue;
      ++with_points;
      std::map<std::string, int> times;
      for (const DataArray& array : arrays_) {
        if (array.piece != piece || array.is_places) continue;
        const Key key{value_of(array, "Name"), times[value_of(array, "Name")]++};
        std::vector<const DataArray*>& forms = found[key];
        if (forms.empty()) order.push_back(key);
        const bool fits = forms.empty() || components_of(array) == components_of(*forms.front());
        if (xml_type(value_of(array, "type")) && fits) forms.push_back(&array);
      }
    }
    std::vector<std::vector<const DataArray*>> common;
    for (const Key& key : order)
      if (std::vector<const DataArray*>& forms = found[key]; forms.size() == with_points)
        common.push_back(std::move(forms));
      else
        left_out += " " + quote(key.first);
    return common;
  }

  static std::string value_of(const DataArray& array, const std::string& key) {
    const auto found = array.attributes.find(key);
    return found == array.attributes.end() ? "" : found->second;
  }
  static std::int64_t components_of(const DataArray& array) {
    const auto number = parse_int(value_of(array, "NumberOfComponents"));
    return number && *number > 0 && *number <= 1000 ? *number : 1;
  }
  Error error(const DataArray& array, const std::string& message) const {
    return {"the array " + quote(value_of(array, "Name")) + ": " + message, file_, array.line, 0, ""};
  }

  Error error_at(std::size_t place, const std::string& message, const std::string& hint = "") {
    return {message, file_, line_at(place), 0, hint};
  }

  // Places come in order, so each line end is counted once.
  std::int64_t line_at(std::size_t place) {
    line_ += std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(counted_),
                        bytes_.begin() + static_cast<std::ptrdiff_t>(place), '\n');
    counted_ = place;
    return line_;
  }

  // The name and the attributes of a tag's text.
  static std::string take_tag(std::string_view text, XmlAttributes& attributes) {
    std::size_t at = 0;
    const auto skip = [&] {
      while (at < text.size() && is_xml_space(text[at])) ++at;
    };
    while (at < text.size() && !is_xml_space(text[at]) && text[at] != '/') ++at;
    const std::string name(text.substr(0, at));
    for (skip(); at < text.size() && attributes.size() < 50; skip()) {
      const std::size_t equals = text.find('=', at);
      if (equals == std::string_view::npos) break;
      const std::string key(trim(text.substr(at, equals - at)));
      at = equals + 1;
      skip();
      if (at >= text.size() || (text[at] != '"' && text[at] != '\'')) break;
      const std::size_t end = text.find(text[at], at + 1);
      if (end == std::string_view::npos) break;
      const std::string_view value = text.substr(at + 1, end - at - 1);
      attributes[key] = std::string(key == "Name" ? value : trim(value));
      at = end + 1;
    }
    return name;
  }

  Status find_arrays() {
    std::string section;
    bool in_file = false;
    for (std::size_t at = bytes_.find('<'); at != std::string_view::npos; at = bytes_.find('<', at)) {
      const std::string_view rest = bytes_.substr(at);
      const bool comment = rest.substr(0, 4) == "<!--";
      const std::string_view mark = comment ? "-->" : ">";
      const std::size_t end = bytes_.find(mark, at + 1);
      if (end == std::string_view::npos) return error_at(at, "the file ends inside of a tag");
      const std::size_t behind = end + mark.size();
      if (comment || rest.substr(0, 2) == "<?" || rest.substr(0, 2) == "<!") {
        at = behind;
        continue;
      }
      XmlAttributes attributes;
      if (rest.substr(0, 2) == "</") {
        if (trim(bytes_.substr(at + 2, end - at - 2)) == section) section.clear();
        at = behind;
        continue;
      }
      const std::string name = take_tag(bytes_.substr(at + 1, end - at - 1), attributes);
      const bool is_closed = bytes_[end - 1] == '/';
      if (name == "VTKFile") {
        in_file = true;
        if (Status status = read_head(at, attributes); !status) return status;
      } else if (!in_file) {
        return error_at(at, "expected the element VTKFile first");
      } else if (name == "Piece") {
        const auto points = parse_int(attributes["NumberOfPoints"]);
        if (!points || *points < 0 || *points > (std::int64_t{1} << 40))
          return error_at(at, "expected NumberOfPoints in the piece but found " + quote(attributes["NumberOfPoints"]),
                          "one piece by itself is read, not the list of pieces of a .pvtp");
        points_of_piece_.push_back(*points);
      } else if (name == "Points" || name == "PointData") {
        if (!is_closed) section = name;
      } else if (name == "DataArray" && !section.empty() && !points_of_piece_.empty()) {
        if (arrays_.size() > 1000) return error_at(at, "expected at most 1000 arrays");
        DataArray array;
        array.attributes = std::move(attributes);
        array.piece = points_of_piece_.size() - 1;
        array.is_places = section == "Points";
        array.line = line_at(at);
        if (!is_closed) {
          const std::size_t next = std::min(bytes_.find('<', behind), bytes_.size());
          array.content = bytes_.substr(behind, next - behind);
        }
        arrays_.push_back(std::move(array));
      } else if (name == "AppendedData") {
        const std::size_t underscore = bytes_.find('_', behind);
        if (underscore == std::string_view::npos) return error_at(at, "expected '_' before the appended data");
        appended_ = bytes_.substr(underscore + 1);
        appended_is_raw_ = attributes["encoding"] == "raw";
        return Done{};
      }
      at = behind;
    }
    if (!in_file) return Error{"expected the element VTKFile", file_, 0, 0, ""};
    return Done{};
  }

  Status read_head(std::size_t at, XmlAttributes& attributes) {
    const std::string kind = attributes["type"], compressor = attributes["compressor"];
    if (kind != "PolyData" && kind != "UnstructuredGrid" && kind != "StructuredGrid")
      return error_at(at, "VTK's XML of " + quote(kind) + " has no points that are read",
                      "PolyData (.vtp), UnstructuredGrid (.vtu) and StructuredGrid (.vts) are read");
    big_endian_ = attributes["byte_order"] == "BigEndian";
    header_bytes_ = attributes["header_type"] == "UInt64" ? 8 : 4;
    compressed_ = !compressor.empty();
    if (compressed_ && compressor != "vtkZLibDataCompressor")
      return error_at(at, "its arrays are packed by " + quote(compressor),
                      "zlib alone is read: write the file with the compressor vtkZLibDataCompressor or none");
    return Done{};
  }

  // Adds the array's numbers: as many as `points` times its components.
  Status decode(const DataArray& array, std::int64_t points, std::vector<double>& values) {
    const auto type = xml_type(value_of(array, "type"));
    if (!type) return error(array, "the type " + quote(value_of(array, "type")) + " is not read");
    const std::int64_t total = points * components_of(array);
    // Without a format it is text, as VTK reads it, unless there is an offset.
    std::string format = value_of(array, "format");
    if (format.empty()) format = value_of(array, "offset").empty() ? "ascii" : "appended";
    numbers_ += double(total);
    if (Status memory = check_memory(numbers_ * sizeof(double), "the arrays of the file"); !memory)
      return error(array, memory.error().message);
    if (format == "ascii") return decode_text(array, total, values);
    std::string_view source = array.content;
    bool raw = false;
    if (format == "appended") {
      const auto offset = parse_int(value_of(array, "offset"));
      if (!offset || *offset < 0 || static_cast<std::uint64_t>(*offset) > appended_.size())
        return error(array, "its offset is not in the appended data");
      source = appended_.substr(static_cast<std::size_t>(*offset));
      raw = appended_is_raw_;
    } else if (format != "binary") {
      return error(array, "the format " + quote(format) + " is none of ascii, binary and appended");
    }
    const auto size = static_cast<std::size_t>(total) * type->size;
    Result<std::string> bytes = compressed_ ? unpack(array, source, raw, size) : plain(array, source, raw, size);
    if (!bytes) return bytes.error();
    // Arrays lie beside each other. If they lay in each other, few bytes would be many numbers.
    if (stored_ > bytes_.size()) return error(array, "the arrays have more bytes than the file");
    NumberType of = *type;
    of.big_endian = big_endian_;
    values.reserve(values.size() + static_cast<std::size_t>(total));
    for (std::size_t i = 0; i < static_cast<std::size_t>(total); ++i)
      values.push_back(number_at(bytes->data() + i * of.size, of));
    return Done{};
  }

  Status decode_text(const DataArray& array, std::int64_t total, std::vector<double>& values) const {
    std::size_t at = 0;
    const std::string_view text = array.content;
    if (total > static_cast<std::int64_t>(text.size() / 2 + 1)) return error(array, "it ends too early");
    values.reserve(values.size() + static_cast<std::size_t>(total));
    for (std::int64_t i = 0;; ++i) {
      while (at < text.size() && is_xml_space(text[at])) ++at;
      const std::size_t begin = at;
      while (at < text.size() && !is_xml_space(text[at])) ++at;
      const std::string_view word = text.substr(begin, at - begin);
      if (word.empty() && i == total) return Done{};
      if (word.empty() || i == total)
        return error(array, "expected " + std::to_string(total) + " numbers but found " +
                                (word.empty() ? std::to_string(i) : "more"));
      const auto number = parse_double(word);
      if (!number) return error(array, "expected a number but found " + quote(word));
      values.push_back(*number);
    }
  }

  // Takes up to this many bytes; fewer if the source ends.
  static std::string take(std::string_view& source, bool raw, std::size_t most) {
    std::size_t used = std::min(most, source.size());
    std::string bytes = raw ? std::string(source.substr(0, used)) : from_base64(source, most, used);
    source.remove_prefix(used);
    return bytes;
  }

  std::uint64_t header_number(const std::string& bytes, std::size_t i) const {
    return bits_at(bytes.data() + i * header_bytes_, header_bytes_, big_endian_);
  }

  // The number of bytes, then the bytes.
  Result<std::string> plain(const DataArray& array, std::string_view source, bool raw, std::size_t size) {
    std::string bytes = take(source, raw, header_bytes_ + size);
    if (bytes.size() < header_bytes_) return error(array, "it ends before its length");
    // Some programs pad the length, so that the bytes begin anew.
    if (bytes.size() == header_bytes_) bytes += take(source, raw, size);
    const std::uint64_t stated = header_number(bytes, 0);
    if (stated != size || bytes.size() != header_bytes_ + size)
      return error(array, "expected " + std::to_string(size) + " bytes, but it states " + std::to_string(stated) +
                              " and has " + std::to_string(bytes.size() - header_bytes_));
    bytes.erase(0, header_bytes_);
    stored_ += bytes.size();
    return bytes;
  }

  // The number of blocks, the bytes of one and of the last, the packed bytes of each; then the blocks. In base64 the
  // numbers stand by themselves.
#if BIHIVE_HAS_ZLIB
  Result<std::string> unpack(const DataArray& array, std::string_view source, bool raw, std::size_t size) {
    std::string_view start = source;
    const std::string first = take(start, raw, header_bytes_);
    if (first.size() < header_bytes_) return error(array, "it ends before its length");
    const std::uint64_t blocks = header_number(first, 0);
    if (blocks > source.size()) return error(array, "it ends before its blocks");
    const std::size_t head_bytes = static_cast<std::size_t>(3 + blocks) * header_bytes_;
    if (size == 0 && blocks == 0) return std::string();
    const std::string head = take(source, raw, head_bytes);
    if (head.size() < head_bytes) return error(array, "it ends before its blocks");
    const std::uint64_t block_size = header_number(head, 1), last_size = header_number(head, 2);
    std::uint64_t packed_total = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::uint64_t packed_size = header_number(head, 3 + i);
      if (packed_size > source.size()) return error(array, "it ends inside of its blocks");
      packed_total += packed_size;
    }
    const std::string packed =
        take(source, raw, static_cast<std::size_t>(std::min<std::uint64_t>(packed_total, source.size())));
    stored_ += packed.size();
    std::string bytes;
    std::size_t at = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
      const auto packed_size = static_cast<std::size_t>(header_number(head, 3 + i));
      const std::uint64_t wanted = i + 1 == blocks && last_size != 0 ? last_size : block_size;
      // zlib packs at most a thousandfold, so a wrong size is found before memory is taken for it.
      if (packed_size > packed.size() - at || wanted > size - bytes.size() || wanted / 1100 > packed_size)
        return error(array, "its blocks do not fit its points");
      const std::size_t before = bytes.size();
      bytes.resize(before + static_cast<std::size_t>(wanted));
      auto length = static_cast<uLongf>(wanted);
      const int state = uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &length,
                                   reinterpret_cast<const Bytef*>(packed.data() + at), static_cast<uLong>(packed_size));
      if (state != Z_OK || length != wanted)
        return error(array, "its packed block " + std::to_string(i) + " is damaged");
      at += packed_size;
    }
    if (bytes.size() != size)
      return error(array, "expected " + std::to_string(size) + " bytes but found " + std::to_string(bytes.size()));
    return bytes;
  }
#else
  Result<std::string> unpack(const DataArray& array, std::string_view, bool, std::size_t) const {
    return error(array,
                 "it is packed, and this build of bihive was made without zlib: write the file without a compressor");
  }
#endif

  std::string_view bytes_;
  const std::string& file_;
  const ColumnChoice& choice_;
  std::vector<std::int64_t> points_of_piece_;
  std::vector<DataArray> arrays_;
  std::string_view appended_;
  bool appended_is_raw_ = false, big_endian_ = false, compressed_ = false;
  std::size_t header_bytes_ = 4;
  double numbers_ = 0;      // of all arrays so far
  std::size_t stored_ = 0;  // their bytes in the file
  std::size_t counted_ = 0;
  std::int64_t line_ = 1;
};

bool is_vtk_xml(const FileHead& file) {
  const std::string_view head = file.bytes;
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head[first] == '<' && head.find("<VTKFile") != std::string_view::npos;
}

Result<RawSpheres> read_vtk_xml(std::string_view bytes, const std::string& file, std::int64_t frame,
                                const ColumnChoice& choice) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  return VtkXmlReader(bytes, file, choice).read();
}

}  // namespace

extern constexpr Format kVtkXml(
    "VTK XML", ".vtp .vtu .vts", Format::kColumns, is_vtk_xml, read_vtk_xml,
    "`<VTKFile` | points and their numbers, in text, binary and packed | the file's, else from distances");

}  // namespace bihive
