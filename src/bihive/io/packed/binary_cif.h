// BinaryCIF [BinaryCIF]: the categories of an mmCIF file as packed columns. It is unpacked to the text of that file, so
// that one reader reads both.
#pragma once

#include <string>
#include <string_view>

#include "bihive/io/packed/unpack.h"

namespace bihive {

/// By the first kPackingMarkBytes: a map that begins with a key of BinaryCIF.
bool is_binary_cif(std::string_view first_bytes);

/// Passes pieces on, BinaryCIF as text once all of it is there. `name` is for messages.
class BinaryCifFilter {
 public:
  BinaryCifFilter(std::string name, const PieceSink& sink) : name_(std::move(name)), sink_(sink) {}

  /// As PieceSink. Errors: those of the sink; more than the memory holds.
  Result<bool> take(std::string_view piece);
  /// After the last piece. Errors: those of the sink; damaged data.
  Status finish();

 private:
  std::string name_;
  const PieceSink& sink_;
  std::string bytes_;  // the first ones, until there are enough to tell; all of BinaryCIF
  bool passes_ = false;
};

}  // namespace bihive
