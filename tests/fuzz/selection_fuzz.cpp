// The language of selections on any text: a mask of the set's size, or an error at a place of the text.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "bihive/io/read_spheres.h"
#include "bihive/select/selection.h"
#include "read_and_check.h"

namespace {

using bihive::fuzz::require;

// In a skewed cell, so that `within` knows images.
constexpr std::string_view kAtoms =
    "CRYST1   30.000   20.000   25.000  80.00  95.00 110.00 P 1           1          \n"
    "ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00 20.25           N  \n"
    "ATOM      2  CA  ALA A   1      12.104   6.134  -6.504  1.00 20.25           C  \n"
    "HETATM    3  O   HOH B   2      10.125   0.000   3.000  0.50 15.00           O  \n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto atoms = bihive::read_spheres_from_memory(kAtoms, "a.pdb", {});
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto mask = bihive::select_spheres(atoms->spheres, text);
  if (mask) {
    require(mask->size() == static_cast<std::size_t>(atoms->spheres.size()));
    require(bihive::check_selection(text).ok());
    return 0;
  }
  const bihive::Error& error = mask.error();
  require(!error.message.empty() && error.line >= 1 && error.column >= 1);
  require(error.column <= static_cast<std::int64_t>(size) + 1);
  require(!bihive::caret_lines(text, error).empty());
  return 0;
}
