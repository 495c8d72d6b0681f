// MessagePack [MessagePack], a binary form of JSON: what BinaryCIF is made of.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

/// A value of a document. Texts and bytes are views of its bytes. Whole numbers beyond 63 bits become `number`.
struct MessagePackValue {
  enum class Kind { nil, boolean, integer, number, text, bytes, array, map };

  Kind kind = Kind::nil;
  std::int64_t integer = 0;  ///< boolean: 0 or 1
  double number = 0;         ///< of an integer too
  std::string_view text;
  std::vector<MessagePackValue> items;  ///< of a map: key, value, key, value

  /// The first value of this key in a map; null: there is none.
  const MessagePackValue* find(std::string_view key) const;
};

/// The first value in the bytes. Errors, without a file's name: it ends early, has types of extensions, is nested more
/// than 16 deep, or has more than 4 million values.
Result<MessagePackValue> parse_message_pack(std::string_view bytes);

}  // namespace bihive
