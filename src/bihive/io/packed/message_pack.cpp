#include "bihive/io/packed/message_pack.h"

#include <string>

#include "bihive/io/packed/binary_number.h"

namespace bihive {
namespace message_pack {
namespace {

using Kind = MessagePackValue::Kind;

constexpr int kMostDepth = 16;
constexpr std::int64_t kMostValues = 1 << 22;

class Parser {
 public:
  explicit Parser(std::string_view bytes) : rest_(bytes) {}

  Status parse(MessagePackValue& value, int depth) {
    if (depth > kMostDepth) return fault("it is nested too deep");
    if (++values_ > kMostValues) return fault("it has more than 4 million values");
    std::uint64_t first = 0;
    if (!take(1, first)) return ends_early();
    if (first < 0x80) return put_integer(static_cast<std::int64_t>(first), value);
    if (first >= 0xe0) return put_integer(static_cast<std::int64_t>(first) - 0x100, value);
    if (first < 0x90) return parse_items(Kind::map, 2 * (first & 0xf), value, depth);
    if (first < 0xa0) return parse_items(Kind::array, first & 0xf, value, depth);
    if (first < 0xc0) return put_view(Kind::text, first & 0x1f, value);
    switch (first) {
      case 0xc0:
        return Done{};
      case 0xc2:
      case 0xc3:
        return put_integer(static_cast<std::int64_t>(first & 1), value, Kind::boolean);
      case 0xc4:
      case 0xc5:
      case 0xc6:
        return parse_view(Kind::bytes, 1 << (first - 0xc4), value);
      case 0xca:
      case 0xcb:
        return parse_number(first == 0xca ? 4 : 8, value);
      case 0xcc:
      case 0xcd:
      case 0xce:
      case 0xcf:
        return parse_integer(1 << (first - 0xcc), false, value);
      case 0xd0:
      case 0xd1:
      case 0xd2:
      case 0xd3:
        return parse_integer(1 << (first - 0xd0), true, value);
      case 0xd9:
      case 0xda:
      case 0xdb:
        return parse_view(Kind::text, 1 << (first - 0xd9), value);
      case 0xdc:
      case 0xdd:
      case 0xde:
      case 0xdf: {
        std::uint64_t count = 0;
        if (!take(first % 2 == 0 ? 2 : 4, count)) return ends_early();
        return first < 0xde ? parse_items(Kind::array, count, value, depth)
                            : parse_items(Kind::map, 2 * count, value, depth);
      }
      default:
        return fault("it has a type of an extension");
    }
  }

 private:
  static Error fault(const std::string& what) { return {what, "", 0, 0, ""}; }
  static Error ends_early() { return fault("it ends early"); }

  // A big-endian number of `size` bytes.
  bool take(std::size_t size, std::uint64_t& number) {
    if (rest_.size() < size) return false;
    number = 0;
    for (std::size_t i = 0; i < size; ++i) number = number << 8 | static_cast<unsigned char>(rest_[i]);
    rest_.remove_prefix(size);
    return true;
  }

  static Status put_integer(std::int64_t integer, MessagePackValue& value, Kind kind = Kind::integer) {
    value.kind = kind;
    value.integer = integer;
    value.number = static_cast<double>(integer);
    return Done{};
  }

  Status parse_integer(int size, bool is_signed, MessagePackValue& value) {
    std::uint64_t number = 0;
    if (!take(static_cast<std::size_t>(size), number)) return ends_early();
    if (is_signed) {
      const int unused = 64 - 8 * size;
      return put_integer(static_cast<std::int64_t>(number << unused) >> unused, value);
    }
    if (number >> 63 == 0) return put_integer(static_cast<std::int64_t>(number), value);
    value.kind = Kind::number;
    value.number = static_cast<double>(number);
    return Done{};
  }

  Status parse_number(std::size_t size, MessagePackValue& value) {
    std::uint64_t bits = 0;
    if (!take(size, bits)) return ends_early();
    value.kind = Kind::number;
    value.number = size == 4 ? double(same_bits<float>(static_cast<std::uint32_t>(bits))) : same_bits<double>(bits);
    return Done{};
  }

  Status put_view(Kind kind, std::uint64_t size, MessagePackValue& value) {
    if (rest_.size() < size) return ends_early();
    value.kind = kind;
    value.text = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return Done{};
  }

  Status parse_view(Kind kind, int size_of_size, MessagePackValue& value) {
    std::uint64_t size = 0;
    if (!take(static_cast<std::size_t>(size_of_size), size)) return ends_early();
    return put_view(kind, size, value);
  }

  // The list grows with what is there: the count may be a lie.
  Status parse_items(Kind kind, std::uint64_t count, MessagePackValue& value, int depth) {
    value.kind = kind;
    for (std::uint64_t i = 0; i < count; ++i) {
      value.items.emplace_back();
      if (Status status = parse(value.items.back(), depth + 1); !status) return status;
    }
    return Done{};
  }

  std::string_view rest_;
  std::int64_t values_ = 0;
};

}  // namespace
}  // namespace message_pack

const MessagePackValue* MessagePackValue::find(std::string_view key) const {
  if (kind != Kind::map) return nullptr;
  for (std::size_t i = 0; i + 1 < items.size(); i += 2)
    if (items[i].kind == Kind::text && items[i].text == key) return &items[i + 1];
  return nullptr;
}

Result<MessagePackValue> parse_message_pack(std::string_view bytes) {
  MessagePackValue value;
  if (Status status = message_pack::Parser(bytes).parse(value, 0); !status) return status.error();
  return value;
}

}  // namespace bihive
