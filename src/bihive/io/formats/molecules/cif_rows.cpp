#include "bihive/io/formats/molecules/cif_rows.h"

#include <gemmi/cifdoc.hpp>
#include <limits>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// The tag in lower case if it is of one of the tables, else nothing.
std::string field_of(std::string_view tag) {
  const std::string lower = lower_case(tag);
  for (const char* const table :
       {"_pdbx_struct_assembly_gen.", "_pdbx_struct_oper_list.", "_struct_conn.", "_chem_comp_bond."})
    if (lower.rfind(table, 0) == 0) return lower;
  return lower == "_struct.title" || lower == "_entry.id" ? lower : std::string();
}

// "A,B,C", with blanks or line breaks in between.
std::vector<std::string> list_of(const std::string& text) {
  std::vector<std::string> items(1);
  for (const char c : text) {
    if (c == ',')
      items.emplace_back();
    else if (c != ' ' && c != '\n' && c != '\r' && c != '\t')
      items.back() += c;
  }
  for (std::string& item : items) item = printable(item);
  return items;
}

std::string value_of(const CifRow& row, const std::string& tag) {
  const auto found = row.find(tag);
  return found == row.end() ? std::string() : found->second;
}

}  // namespace

void CifRows::begin_loop() {
  fields_.clear();
  column_ = 0;
  row_.clear();
  ours_ = false;
}

void CifRows::add_loop_tag(std::string_view tag) {
  fields_.push_back(field_of(tag));
  ours_ = ours_ || !fields_.back().empty();
}

void CifRows::add_loop_value(std::string_view value) {
  if (!ours_) return;
  if (!fields_[column_].empty()) row_[fields_[column_]] = gemmi::cif::as_string(std::string(value));
  if (++column_ < fields_.size()) return;
  column_ = 0;
  rows_.push_back(row_);
}

void CifRows::add_pair_tag(std::string_view tag) {
  pair_field_ = field_of(tag);
}

void CifRows::add_pair_value(std::string_view value) {
  if (!pair_field_.empty()) pairs_[pair_field_] = gemmi::cif::as_string(std::string(value));
}

void CifRows::clear() {
  pairs_.clear();
  rows_.clear();
}

const std::vector<CifRow>& CifRows::rows() {
  if (!pairs_.empty()) rows_.push_back(std::exchange(pairs_, {}));
  return rows_;
}

std::string value_in(const std::vector<CifRow>& rows, const std::string& tag) {
  for (const CifRow& row : rows)
    if (std::string value = value_of(row, tag); !value.empty()) return value;
  return "";
}

Assemblies assemblies_from(const std::vector<CifRow>& rows) {
  const std::string gen = "_pdbx_struct_assembly_gen.", operators = "_pdbx_struct_oper_list.";
  Assemblies assemblies;
  for (const CifRow& row : rows) {
    if (const auto id = row.find(gen + "assembly_id"); id != row.end())
      assemblies.parts.push_back({printable(id->second), value_of(row, gen + "oper_expression"),
                                  list_of(value_of(row, gen + "asym_id_list"))});
    if (const auto id = row.find(operators + "id"); id != row.end()) {
      AssemblyOperator made;
      made.id = id->second;
      for (std::size_t i = 0; i < 12; ++i) {
        const std::string number = std::to_string(i / 4 + 1);
        const std::string key =
            i % 4 == 3 ? "vector[" + number + "]" : "matrix[" + number + "][" + std::to_string(i % 4 + 1) + "]";
        made.rows[i] = parse_double(value_of(row, operators + key)).value_or(std::numeric_limits<double>::quiet_NaN());
      }
      assemblies.operators.push_back(made);
    }
  }
  return assemblies;
}

}  // namespace bihive
