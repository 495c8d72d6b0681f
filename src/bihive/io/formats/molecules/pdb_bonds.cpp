#include "bihive/io/formats/molecules/pdb_bonds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include "bihive/base/parse_number.h"
#include "bihive/io/formats/molecules/pdb_columns.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::size_t kFirstColumn = 7, kFieldWidth = 5, kMostFields = 5;  // the atom and four others

// Five columns for each number, right-justified. Where a record departs from that, its fields between blanks.
std::vector<std::int64_t> serials_of(std::string_view line) {
  std::vector<std::int64_t> serials;
  bool in_columns = true;
  for (std::size_t i = 0; i < kMostFields && in_columns; ++i) {
    const std::size_t first = kFirstColumn + kFieldWidth * i;
    const std::string_view columns = pdb_columns(line, first, first + kFieldWidth - 1);
    if (trim(columns).empty()) break;
    const auto serial = parse_int(trim(columns));
    in_columns = serial && columns.size() == kFieldWidth && columns.back() != ' ';
    if (in_columns) serials.push_back(*serial);
  }
  if (in_columns) return serials;

  serials.clear();
  TextScanner scanner(line.substr(std::min(line.size(), kFirstColumn - 1)), "");
  scanner.next_line();
  for (std::string_view field; serials.size() < kMostFields && scanner.next_field(field);) {
    const auto serial = parse_int(field);
    if (!serial) break;
    serials.push_back(*serial);
  }
  return serials;
}

}  // namespace

void PdbBonds::add_line(std::string_view line) {
  const std::vector<std::int64_t> serials = serials_of(line);
  for (std::size_t i = 1; i < serials.size(); ++i)
    if (serials[i] != serials[0]) pairs_.emplace_back(serials[0], serials[i]);
}

void PdbBonds::take(RawSpheres& spheres) {
  const NamedNumbers* const column = spheres.attributes.find_numbers("serial");
  if (pairs_.empty() || column == nullptr) return;

  // Of a serial number that several spheres have, the position is none.
  std::unordered_map<std::int64_t, std::int64_t> positions;
  for (std::size_t i = 0; i < column->values.size(); ++i) {
    if (!(std::abs(column->values[i]) < 0x1p53)) continue;
    const auto [known, is_new] = positions.try_emplace(static_cast<std::int64_t>(column->values[i]), i + 1);
    if (!is_new) known->second = 0;
  }
  const auto position_of = [&positions](std::int64_t serial) {
    const auto known = positions.find(serial);
    return known == positions.end() ? std::int64_t{0} : known->second;
  };

  // Records state a bond from both ends, and programs a double bond twice.
  std::sort(pairs_.begin(), pairs_.end());
  for (std::size_t i = 0; i < pairs_.size();) {
    std::size_t end = i;
    while (end < pairs_.size() && pairs_[end] == pairs_[i]) ++end;
    const BondOrder order = end - i == 2   ? BondOrder::double_bond
                            : end - i == 3 ? BondOrder::triple
                                           : BondOrder::unknown;
    add_bond(spheres, position_of(pairs_[i].first), position_of(pairs_[i].second), order);
    i = end;
  }
  pairs_.clear();
}

}  // namespace bihive
