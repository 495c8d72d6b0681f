#include "bihive/io/packed/binary_cif.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <new>
#include <utility>
#include <vector>

#include "bihive/base/memory.h"
#include "bihive/io/packed/binary_number.h"
#include "bihive/io/packed/message_pack.h"
#include "bihive/io/packed/unpackers.h"

namespace bihive {
namespace binary_cif {
namespace {

using Kind = MessagePackValue::Kind;
using Value = MessagePackValue;
using Integers = std::vector<std::int64_t>;

// Why the data cannot be unpacked.
struct Fault {
  std::string what;
};
// The sink needs no more.
struct Enough {};

const Value& member(const Value& map, std::string_view key, Kind kind) {
  const Value* const found = map.find(key);
  if (found == nullptr || found->kind != kind) throw Fault{fmt::format("'{}' is missing or of another type", key)};
  return *found;
}

double number_of(const Value& map, std::string_view key) {
  const Value* const found = map.find(key);
  if (found == nullptr || (found->kind != Kind::integer && found->kind != Kind::number))
    throw Fault{fmt::format("the number '{}' is missing", key)};
  return found->number;
}

std::int64_t count_of(const Value& map, std::string_view key) {
  const std::int64_t count = member(map, key, Kind::integer).integer;
  if (count < 0) throw Fault{fmt::format("'{}' is negative", key)};
  return count;
}

// The data of a column on the way from bytes to numbers or texts.
struct Data {
  enum class Form { bytes, integers, numbers, texts };

  Form form = Form::bytes;
  std::string_view bytes;
  Integers integers;  // of texts: positions in `texts`, -1: none
  std::vector<double> numbers;
  bool single = false;  // the numbers are of binary32
  std::vector<std::string_view> texts;

  std::size_t size() const { return form == Form::numbers ? numbers.size() : integers.size(); }
};

// Memory that a count in the file asks for; more than there is refuses the file.
void check_room(double values) {
  constexpr double kSmall = 1 << 20;
  if (values * sizeof(double) <= kSmall) return;
  if (const Status status = check_memory(values * sizeof(double), "a column of it"); !status)
    throw Fault{status.error().message};
}

// Integers of up to 32 bits are exact in the binary64 that number_at() returns.
template <class To>
std::vector<To> numbers_in(std::string_view bytes, const NumberType& type) {
  if (bytes.size() % type.size != 0) throw Fault{"a column has half a number"};
  check_room(static_cast<double>(bytes.size() / type.size));
  std::vector<To> numbers(bytes.size() / type.size);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = static_cast<To>(number_at(bytes.data() + i * type.size, type));
  return numbers;
}

// The types of ByteArray, by their codes.
constexpr struct {
  std::int64_t code;
  NumberType type;
} kByteArrayTypes[] = {{1, {'i', 1}}, {2, {'i', 2}}, {3, {'i', 4}},  {4, {'u', 1}},
                       {5, {'u', 2}}, {6, {'u', 4}}, {32, {'f', 4}}, {33, {'f', 8}}};

void undo_byte_array(const Value& how, Data& data) {
  if (data.form != Data::Form::bytes) throw Fault{"'ByteArray' is not the last step"};
  const std::int64_t code = member(how, "type", Kind::integer).integer;
  const auto* const row = std::find_if(std::begin(kByteArrayTypes), std::end(kByteArrayTypes),
                                       [code](const auto& one) { return one.code == code; });
  if (row == std::end(kByteArrayTypes)) throw Fault{"'ByteArray' has an unknown type"};
  if (row->type.kind == 'f') {
    data.form = Data::Form::numbers;
    data.single = row->type.size == sizeof(float);
    data.numbers = numbers_in<double>(data.bytes, row->type);
  } else {
    data.form = Data::Form::integers;
    data.integers = numbers_in<std::int64_t>(data.bytes, row->type);
  }
}

// Integers become numbers.
template <class NumberOf>
void to_numbers(const Value& how, Data& data, const NumberOf& number_of_integer) {
  check_room(static_cast<double>(data.integers.size()));
  data.single = member(how, "srcType", Kind::integer).integer == 32;
  data.numbers.resize(data.integers.size());
  for (std::size_t i = 0; i < data.numbers.size(); ++i) {
    const double number = number_of_integer(static_cast<double>(data.integers[i]));
    data.numbers[i] = data.single ? double(static_cast<float>(number)) : number;
  }
  data.form = Data::Form::numbers;
  Integers().swap(data.integers);
}

void undo_run_length(const Value& how, Data& data) {
  const std::int64_t size = count_of(how, "srcSize");
  check_room(static_cast<double>(size));
  if (data.integers.size() % 2 != 0) throw Fault{"'RunLength' has half a run"};
  Integers all;
  for (std::size_t i = 0; i < data.integers.size(); i += 2) {
    const std::int64_t count = data.integers[i + 1];
    if (count < 0 || count > size - static_cast<std::int64_t>(all.size())) throw Fault{"'RunLength' has too long runs"};
    all.insert(all.end(), static_cast<std::size_t>(count), data.integers[i]);
  }
  data.integers = std::move(all);
}

void undo_delta(const Value& how, Data& data) {
  // Sums wrap around; no valid file has such ones.
  auto sum = static_cast<std::uint64_t>(member(how, "origin", Kind::integer).integer);
  for (std::int64_t& integer : data.integers) {
    sum += static_cast<std::uint64_t>(integer);
    integer = static_cast<std::int64_t>(sum);
  }
}

// A number at the limit of its bytes goes on in the next one.
void undo_integer_packing(const Value& how, Data& data) {
  const std::int64_t bytes = count_of(how, "byteCount");
  if (bytes != 1 && bytes != 2) throw Fault{"'IntegerPacking' has neither 1 nor 2 bytes"};
  const Value* const is_unsigned = how.find("isUnsigned");
  const bool has_sign = is_unsigned == nullptr || is_unsigned->integer == 0;
  const std::int64_t most = (std::int64_t{1} << (8 * bytes - (has_sign ? 1 : 0))) - 1;
  const std::int64_t least = has_sign ? -most - 1 : -1;
  Integers all;
  std::int64_t sum = 0;
  for (const std::int64_t part : data.integers) {
    sum += part;
    if (part == most || part == least) continue;
    all.push_back(sum);
    sum = 0;
  }
  data.integers = std::move(all);
}

Data undone(const Value& encodings, std::string_view bytes, bool may_be_texts);

// Where each unit of UTF-16 begins in a text of UTF-8, and its end: offsets count these units.
std::vector<std::size_t> units_of(std::string_view text) {
  std::vector<std::size_t> units;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xc0) == 0x80) continue;
    units.push_back(i);
    if (byte >= 0xf0) units.push_back(i);
  }
  units.push_back(text.size());
  return units;
}

void undo_string_array(const Value& how, Data& data) {
  const std::string_view all = member(how, "stringData", Kind::text).text;
  const Data offsets =
      undone(member(how, "offsetEncoding", Kind::array), member(how, "offsets", Kind::bytes).text, false);
  const std::vector<std::size_t> units = units_of(all);
  for (std::size_t i = 0; i + 1 < offsets.integers.size(); ++i) {
    const std::int64_t from = offsets.integers[i], to = offsets.integers[i + 1];
    if (from < 0 || to < from || to >= static_cast<std::int64_t>(units.size()))
      throw Fault{"'StringArray' has an offset beyond its texts"};
    const std::size_t first = units[static_cast<std::size_t>(from)];
    data.texts.push_back(all.substr(first, units[static_cast<std::size_t>(to)] - first));
  }
  data.integers = undone(member(how, "dataEncoding", Kind::array), data.bytes, false).integers;
  for (const std::int64_t text : data.integers)
    if (text < -1 || text >= static_cast<std::int64_t>(data.texts.size()))
      throw Fault{"'StringArray' names a text that is not there"};
  data.form = Data::Form::texts;
}

// Undoes the steps, the last one first.
Data undone(const Value& encodings, std::string_view bytes, bool may_be_texts) {
  Data data;
  data.bytes = bytes;
  for (auto how = encodings.items.rbegin(); how != encodings.items.rend(); ++how) {
    const std::string_view kind = member(*how, "kind", Kind::text).text;
    if (kind == "ByteArray") {
      undo_byte_array(*how, data);
      continue;
    }
    if (kind == "StringArray" && may_be_texts && data.form == Data::Form::bytes) {
      undo_string_array(*how, data);
      continue;
    }
    if (data.form != Data::Form::integers) throw Fault{fmt::format("the step '{}' has no whole numbers", kind)};
    if (kind == "RunLength") {
      undo_run_length(*how, data);
    } else if (kind == "Delta") {
      undo_delta(*how, data);
    } else if (kind == "IntegerPacking") {
      undo_integer_packing(*how, data);
    } else if (kind == "FixedPoint") {
      const double factor = number_of(*how, "factor");
      if (!(factor != 0)) throw Fault{"'FixedPoint' has no factor"};
      to_numbers(*how, data, [factor](double integer) { return integer / factor; });
    } else if (kind == "IntervalQuantization") {
      const double least = number_of(*how, "min"), most = number_of(*how, "max"), steps = number_of(*how, "numSteps");
      if (!(steps > 1)) throw Fault{"'IntervalQuantization' has no steps"};
      to_numbers(*how, data, [=](double integer) { return least + integer * ((most - least) / (steps - 1)); });
    } else {
      throw Fault{fmt::format("the step '{}' is unknown", kind)};
    }
  }
  if (data.form == Data::Form::bytes) throw Fault{"a column has bytes without a meaning"};
  if (!may_be_texts && data.form != Data::Form::integers) throw Fault{"whole numbers are of another kind"};
  return data;
}

// ---- The text of CIF ----

bool is_bare(std::string_view text) {
  if (text.empty() || text == "." || text == "?" ||
      std::string_view("_#$'\"[];").find(text[0]) != std::string_view::npos)
    return false;
  for (const std::string_view word : {"data_", "loop_", "save_", "stop_", "global_"}) {
    const std::string_view begin = text.substr(0, word.size());
    if (std::equal(begin.begin(), begin.end(), word.begin(), word.end(),
                   [](char a, char b) { return (a | 0x20) == (b | 0x20); }))
      return false;
  }
  return std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; });
}

// A quote ends a quoted text only before a blank.
bool can_quote(std::string_view text, char quote) {
  if (text.find_first_of("\r\n") != std::string_view::npos) return false;
  for (std::size_t at = text.find(quote); at != std::string_view::npos; at = text.find(quote, at + 1))
    if (at + 1 == text.size() || text[at + 1] == ' ' || text[at + 1] == '\t') return false;
  return true;
}

void append_text(std::string_view text, std::string& out) {
  if (is_bare(text)) {
    out += text;
  } else if (can_quote(text, '\'')) {
    out.append("'").append(text).append("'");
  } else if (can_quote(text, '"')) {
    out.append("\"").append(text).append("\"");
  } else {
    out += "\n;";
    for (std::size_t i = 0; i < text.size(); ++i) {
      out += text[i];
      if (text[i] == '\n' && i + 1 < text.size() && text[i + 1] == ';') out += ' ';
    }
    out += "\n;\n";
  }
}

struct Column {
  std::string_view name;
  Data data;
  Integers mask;  // 0: there, 1: '.', 2: '?'; empty: all are there
};

Column column_from(const Value& map, std::int64_t rows) {
  Column column;
  column.name = member(map, "name", Kind::text).text;
  try {
    const Value& data = member(map, "data", Kind::map);
    column.data = undone(member(data, "encoding", Kind::array), member(data, "data", Kind::bytes).text, true);
    const Value* const mask = map.find("mask");
    if (mask != nullptr && mask->kind == Kind::map)
      column.mask =
          undone(member(*mask, "encoding", Kind::array), member(*mask, "data", Kind::bytes).text, false).integers;
  } catch (const Fault& fault) {
    throw Fault{fmt::format("column '{}': {}", column.name, fault.what)};
  }
  const auto expected = static_cast<std::size_t>(rows);
  if (column.data.size() != expected || (!column.mask.empty() && column.mask.size() != expected))
    throw Fault{fmt::format("column '{}' has not the {} rows of its category", column.name, rows)};
  return column;
}

void append_value(const Column& column, std::size_t row, std::string& out) {
  const Data& data = column.data;
  if (!column.mask.empty() && column.mask[row] != 0) {
    out += column.mask[row] == 1 ? '.' : '?';
  } else if (data.form == Data::Form::texts) {
    const std::int64_t text = data.integers[row];
    if (text < 0)
      out += '.';
    else
      append_text(data.texts[static_cast<std::size_t>(text)], out);
  } else if (data.form == Data::Form::integers) {
    fmt::format_to(std::back_inserter(out), "{}", data.integers[row]);
  } else if (!std::isfinite(data.numbers[row])) {
    out += '?';
  } else if (data.single) {
    fmt::format_to(std::back_inserter(out), "{}", static_cast<float>(data.numbers[row]));
  } else {
    fmt::format_to(std::back_inserter(out), "{}", data.numbers[row]);
  }
}

// Names must not break the text.
void check_name(std::string_view name) {
  if (name.empty() ||
      std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; }))
    throw Fault{"a name is empty or has blanks"};
}

class TextOfCif {
 public:
  explicit TextOfCif(const PieceSink& sink) : sink_(sink) {}

  // Returns the sink's error.
  Status write(const Value& file) {
    for (const Value& block : member(file, "dataBlocks", Kind::array).items) {
      const Value* const header = block.find("header");
      std::string name = header == nullptr ? "" : std::string(header->text);
      std::replace_if(
          name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; }, '_');
      text_ += "data_" + name + "\n";
      for (const Value& category : member(block, "categories", Kind::array).items)
        if (Status status = write_category(category); !status) return status;
    }
    return give();
  }

 private:
  Status write_category(const Value& category) {
    const std::string_view name = member(category, "name", Kind::text).text;
    check_name(name);
    const std::int64_t rows = count_of(category, "rowCount");
    std::vector<Column> columns;
    for (const Value& column : member(category, "columns", Kind::array).items)
      columns.push_back(column_from(column, rows));
    if (rows == 0 || columns.empty()) return Done{};
    const auto append_name = [&](const Column& column) {
      check_name(column.name);
      text_.append(name[0] == '_' ? "" : "_").append(name).append(".").append(column.name);
    };
    // One row stands as pairs of names and values.
    if (rows == 1) {
      for (const Column& column : columns) {
        append_name(column);
        text_ += ' ';
        append_value(column, 0, text_);
        text_ += '\n';
      }
      text_ += "#\n";
      return Done{};
    }
    text_ += "loop_\n";
    for (const Column& column : columns) {
      append_name(column);
      text_ += '\n';
    }
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
      for (const Column& column : columns) {
        append_value(column, row, text_);
        text_ += ' ';
      }
      text_ += '\n';
      if (text_.size() < kUnpackedPieceBytes) continue;
      if (Status status = give(); !status) return status;
    }
    text_ += "#\n";
    return Done{};
  }

  Status give() {
    const Result<bool> more = sink_(text_);
    text_.clear();
    if (!more) return more.error();
    if (!*more) throw Enough{};
    return Done{};
  }

  const PieceSink& sink_;
  std::string text_;
};

}  // namespace
}  // namespace binary_cif

bool is_binary_cif(std::string_view first_bytes) {
  if (first_bytes.size() < kPackingMarkBytes || first_bytes[0] != '\x83') return false;
  for (const std::string_view key : {"\xa7version",
                                     "\xa7"
                                     "encoder",
                                     "\xaa"
                                     "dataBloc"})
    if (first_bytes.substr(1, key.size()) == key) return true;
  return false;
}

Result<bool> BinaryCifFilter::take(std::string_view piece) {
  if (!passes_) {
    const double size = static_cast<double>(bytes_.size() + piece.size());
    if (size > memory_bytes())
      if (Status status = check_memory(size, "what is packed in it"); !status)
        return packed_fault(status.error().message, name_);
    bytes_ += piece;
    if (bytes_.size() < kPackingMarkBytes || is_binary_cif(bytes_)) return true;
    passes_ = true;
    piece = bytes_;
  }
  const Result<bool> more = sink_(piece);
  if (!bytes_.empty()) std::string().swap(bytes_);
  return more;
}

Status BinaryCifFilter::finish() try {
  if (passes_ || bytes_.empty()) return Done{};
  if (!is_binary_cif(bytes_)) {
    const Result<bool> more = sink_(bytes_);
    return more ? Status(Done{}) : more.error();
  }
  const Result<MessagePackValue> file = parse_message_pack(bytes_);
  if (!file) return packed_fault("the BinaryCIF data is damaged: " + file.error().message, name_);
  return binary_cif::TextOfCif(sink_).write(*file);
} catch (const binary_cif::Fault& fault) {
  return packed_fault("the BinaryCIF data is damaged: " + fault.what, name_);
} catch (const binary_cif::Enough&) {
  return Done{};
} catch (const std::bad_alloc&) {
  return packed_fault(no_memory_for("unpacking it").message, name_);
}

}  // namespace bihive
