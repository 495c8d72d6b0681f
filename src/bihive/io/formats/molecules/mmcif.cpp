// mmCIF by gemmi's grammar of CIF, with actions of our own. They keep only the _atom_site category, in file order, and
// know the place of every value.
#include <algorithm>
#include <array>
#include <exception>
#include <gemmi/cif.hpp>
#include <iterator>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "bihive/base/parse_number.h"
#include "bihive/base/watch.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/formats/molecules/alternates.h"
#include "bihive/io/formats/molecules/atom_columns.h"
#include "bihive/io/formats/molecules/chem_comp.h"
#include "bihive/io/formats/molecules/cif.h"
#include "bihive/io/formats/molecules/cif_connections.h"
#include "bihive/io/formats/molecules/cif_elements.h"
#include "bihive/io/formats/molecules/cif_errors.h"
#include "bihive/io/formats/molecules/cif_rows.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/text/title.h"

namespace bihive {
namespace {

// Between two looks at whether the reading is cancelled.
constexpr std::int64_t kWatchedAtoms = 4096;

// The items of _atom_site that the reader takes.
enum Item {
  kX,
  kY,
  kZ,
  kGroup,
  kElement,
  kOccupancy,
  kBFactor,
  kModel,
  kAlternate,
  kInsertion,
  kAuthChain,
  kAuthSequence,
  kAuthAtom,
  kLabelChain,
  kLabelSequence,
  kLabelAtom,
  kAuthResidue,
  kLabelResidue,
  kEntity,
  kSerial,
  kItems
};
constexpr std::string_view kItemNames[kItems] = {
    "cartn_x",      "cartn_y",           "cartn_z",         "group_pdb",
    "type_symbol",  "occupancy",         "b_iso_or_equiv",  "pdbx_pdb_model_num",
    "label_alt_id", "pdbx_pdb_ins_code", "auth_asym_id",    "auth_seq_id",
    "auth_atom_id", "label_asym_id",     "label_seq_id",    "label_atom_id",
    "auth_comp_id", "label_comp_id",     "label_entity_id", "id"};

// The grammar throws this to end with an error that has its place.
struct Stop {
  Error error;
};

// A value as it stands in the file.
struct Value {
  std::string_view text;
  std::size_t line = 0, column = 0;

  bool missing() const { return text.empty() || text == "?" || text == "."; }
  std::string_view unquoted() const {
    const bool quoted = text.size() >= 2 && (text[0] == '\'' || text[0] == '"') && text.back() == text[0];
    return quoted ? text.substr(1, text.size() - 2) : text;
  }
};

using Row = std::array<Value, kItems>;

int item_of(std::string_view tag) {
  constexpr std::string_view category = "_atom_site.";
  const std::string lower = lower_case(tag);
  if (lower.compare(0, category.size(), category) != 0) return kItems;
  const auto found = std::find(std::begin(kItemNames), std::end(kItemNames), lower.substr(category.size()));
  return static_cast<int>(found - std::begin(kItemNames));
}

// The position of a tag among the lengths and angles of the cell; 6: it is none of them.
std::size_t cell_item_of(std::string_view tag) {
  constexpr std::array<std::string_view, 6> kTags{"_cell.length_a",    "_cell.length_b",   "_cell.length_c",
                                                  "_cell.angle_alpha", "_cell.angle_beta", "_cell.angle_gamma"};
  return static_cast<std::size_t>(std::find(kTags.begin(), kTags.end(), lower_case(tag)) - kTags.begin());
}

// Takes the values of _atom_site in the order in which the grammar meets them.
class AtomSites {
 public:
  AtomSites(const std::string& file, std::int64_t frame) : file_(file), frame_(frame) { spheres_.format = "mmCIF"; }

  // Only the first block with atoms is read.
  void begin_block() {
    add_atom(pair_row_);
    pair_row_ = {};
    pair_tags_.clear();
    done_ = done_ || atoms_ > 0;
    if (!done_) tables_.clear();
    if (!done_) {
      cell_ = {};
      states_cell_ = false;
    }
  }

  void begin_loop() {
    columns_.clear();
    column_ = 0;
    row_ = {};
    ours_ = false;
    loop_tags_.clear();
    cell_items_.clear();
    is_cell_ = false;
    tables_.begin_loop();
  }
  void add_loop_tag(const Value& tag) {
    tables_.add_loop_tag(tag.text);
    note_category(tag.text);
    columns_.push_back(item_of(tag.text));
    cell_items_.push_back(cell_item_of(tag.text));
    is_cell_ = is_cell_ || cell_items_.back() < cell_.size();
    ours_ = ours_ || columns_.back() != kItems;
    refuse_duplicate(tag, loop_tags_);
  }
  void add_loop_value(const Value& value) {
    if (!done_) tables_.add_loop_value(value.text);
    if (is_cell_) take_cell_of_loop(value);
    if (!ours_) return;
    const int item = columns_[column_];
    if (item != kItems) row_[static_cast<std::size_t>(item)] = value;
    last_ = value;
    if (++column_ < columns_.size()) return;
    column_ = 0;
    add_atom(row_);
  }
  void end_loop() const {
    if (column_ > 0)
      stop(last_, "the last row of this loop has " + std::to_string(column_) + " of its " +
                      std::to_string(columns_.size()) + " values");
  }

  // A single atom may stand outside a loop, as pairs of tag and value.
  void add_pair_tag(const Value& tag) {
    note_category(tag.text);
    pair_item_ = item_of(tag.text);
    cell_item_ = cell_item_of(tag.text);
    tables_.add_pair_tag(tag.text);
    if (pair_item_ != kItems) refuse_duplicate(tag, pair_tags_);
  }
  void add_pair_value(const Value& value) {
    if (!done_) tables_.add_pair_value(value.text);
    put_cell_item(cell_item_, value);
    if (pair_item_ != kItems) pair_row_[static_cast<std::size_t>(pair_item_)] = value;
  }

  Result<RawSpheres> finish() {
    begin_block();
    if (atoms_ == 0) return no_atoms();
    const auto models = static_cast<std::int64_t>(model_of_name_.size());
    if (frame_ < 0 || frame_ >= models) return no_such_frame(file_, frame_, models);
    spheres_.frames = models;
    take_cell();
    if (without_place_ > 0)
      spheres_.warnings.push_back(file_ + ": " + spheres_have(without_place_) +
                                  " no place ('?'), so the file's other atoms are shown");
    spheres_.rules.push_back("atoms: ATOM and HETATM of model " + std::to_string(frame_) + " (from 0)");
    columns_of_atoms_.take(spheres_.attributes);
    spheres_.title = title_from(value_in(tables_.rows(), "_struct.title"));
    spheres_.entry_id = entry_id_from(value_in(tables_.rows(), "_entry.id"));
    spheres_.assemblies = assemblies_from(tables_.rows());
    if (!spheres_.assemblies.parts.empty())
      spheres_.attributes.texts.push_back(printable_texts(label_chains_.take(std::string(kAssemblyChains))));
    add_connections(tables_.rows(), marks_, spheres_);
    add_component_bonds(tables_.rows(), marks_, spheres_);
    alternates_.remove_from(spheres_);
    return std::move(spheres_);
  }

  bool holds_monomers_alone() const { return atoms_ == 0 && is_monomer_; }

 private:
  [[noreturn]] void stop(const Value& at, const std::string& what) const {
    throw Stop{{what, file_, static_cast<std::int64_t>(at.line), static_cast<std::int64_t>(at.column), ""}};
  }

  void put_cell_item(std::size_t item, const Value& value) {
    if (done_ || item >= cell_.size()) return;
    const std::string_view digits = value.unquoted();
    cell_[item] = parse_double(digits.substr(0, digits.find('('))).value_or(0);
    states_cell_ = states_cell_ || !value.missing();
  }

  // A loop of one row says the same as pairs.
  void take_cell_of_loop(const Value& value) {
    if (cell_items_.empty()) return;
    put_cell_item(cell_items_.front(), value);
    cell_items_.erase(cell_items_.begin());
  }

  void take_cell() {
    if (is_placeholder_cell(cell_)) return;
    spheres_.cell = unit_cell(cell_);
    if (states_cell_ && !spheres_.cell)
      spheres_.warnings.push_back(file_ + ": the lengths and angles of _cell make no cell, so there is none");
  }

  // Two columns of one name would hide one of them.
  void refuse_duplicate(const Value& tag, std::unordered_set<std::string>& tags) const {
    if (!tags.insert(lower_case(tag.text)).second)
      stop(tag, "the item " + printable(tag.text) + " stands twice in one table");
  }

  // The kinds of CIF that hold no atoms of ours and that the file shows.
  void note_category(std::string_view tag) {
    const std::string lower = lower_case(tag.substr(0, 20));
    const auto begins_with = [&lower](std::string_view text) { return lower.compare(0, text.size(), text) == 0; };
    is_monomer_ = is_monomer_ || begins_with("_chem_comp_atom.");
    is_reflections_ = is_reflections_ || begins_with("_refln.") || begins_with("_refln_");
  }

  Error no_atoms() const {
    const std::string none = "there is no _atom_site category with Cartn_x, Cartn_y and Cartn_z in it: ";
    if (is_monomer_)
      return {none + "this CIF describes a monomer (_chem_comp_atom) without coordinates", file_, 0, 0,
              "take its file from the Chemical Component Dictionary"};
    if (is_reflections_)
      return {none + "this CIF holds reflections, not atoms", file_, 0, 0, "take the entry's file of coordinates"};
    return {none.substr(0, none.size() - 2), file_, 0, 0, "bihive reads the atoms of mmCIF files alone"};
  }

  double number(const Value& value, const std::string& what) const {
    // A standard uncertainty may follow in brackets: 1.234(5).
    std::string_view digits = value.unquoted();
    if (!digits.empty() && digits.back() == ')') digits = digits.substr(0, digits.find('('));
    const auto parsed = parse_double(digits);
    if (!parsed) stop(value, "expected a number for " + what + " but found " + quote(value.text));
    return *parsed;
  }

  double coordinate(const Value& value, const std::string& what) const {
    const double parsed = number(value, what);
    if (const char* fault = coordinate_fault(parsed)) stop(value, what + " " + fault + ": " + quote(value.text));
    return parsed;
  }

  void add_atom(const Row& row) {
    if (done_ || row[kX].text.empty() || row[kY].text.empty() || row[kZ].text.empty()) return;

    // Take atoms of one model only.
    if (++atoms_ % kWatchedAtoms == 0) stop_if_cancelled();
    const auto next_model = static_cast<std::int64_t>(model_of_name_.size());
    const auto model = model_of_name_.try_emplace(std::string(row[kModel].text), next_model).first->second;
    if (model != frame_) return;
    if (row[kX].missing() || row[kY].missing() || row[kZ].missing()) {
      ++without_place_;
      return;
    }
    spheres_.x.push_back(coordinate(row[kX], "Cartn_x"));
    spheres_.y.push_back(coordinate(row[kY], "Cartn_y"));
    spheres_.z.push_back(coordinate(row[kZ], "Cartn_z"));
    const int element = element_of_type_symbol(row[kElement].unquoted());
    spheres_.attributes.element.push_back(static_cast<std::uint8_t>(element));
    const double occupancy = row[kOccupancy].missing() ? 1 : number(row[kOccupancy], "occupancy");
    const double b_factor = row[kBFactor].missing() ? 0 : number(row[kBFactor], "B_iso_or_equiv");
    columns_of_atoms_.add(names_of(row), occupancy, b_factor);

    const Value& label_chain = chosen(row, kLabelChain, kAuthChain);
    label_chains_.add(label_chain.missing() ? std::string_view() : label_chain.unquoted());

    // A residue is named by its chain and number with insertion code: the author's, else the label's.
    const std::string_view mark = row[kAlternate].unquoted();
    const bool has_mark = !row[kAlternate].missing() && !mark.empty();
    marks_ += has_mark ? mark.front() : char{0};
    if (!has_mark) return;
    const auto text = [&row](Item author, Item label) { return chosen(row, author, label).unquoted(); };
    const std::string residue = std::string(text(kAuthChain, kLabelChain)) + ' ' +
                                std::string(text(kAuthSequence, kLabelSequence)) + ' ' +
                                std::string(row[kInsertion].text);
    alternates_.add({residue, text(kAuthResidue, kLabelResidue), text(kAuthAtom, kLabelAtom), mark.front(), occupancy},
                    spheres_.size() - 1);
  }

  // The author's item, else the label's.
  static const Value& chosen(const Row& row, Item author, Item label) {
    return row[row[author].missing() ? label : author];
  }

  static AtomNames names_of(const Row& row) {
    const auto text = [](const Value& value) { return value.missing() ? std::string_view() : value.unquoted(); };
    AtomNames names;
    names.record = lower_case(text(row[kGroup])) == "hetatm" ? "HETATM" : "ATOM";
    names.serial = text(row[kSerial]);
    names.chain = text(chosen(row, kAuthChain, kLabelChain));
    names.residue_number = text(chosen(row, kAuthSequence, kLabelSequence));
    names.insertion = text(row[kInsertion]);
    names.residue = text(chosen(row, kAuthResidue, kLabelResidue));
    names.name = text(chosen(row, kAuthAtom, kLabelAtom));
    names.entity = text(row[kEntity]);
    return names;
  }

  std::string file_;
  std::int64_t frame_;
  bool done_ = false;
  std::vector<int> columns_;  // of the loop: items, kItems for all other items
  std::size_t column_ = 0;
  bool ours_ = false;  // the loop has an item that is read
  Row row_{};
  Value last_;
  std::unordered_set<std::string> loop_tags_, pair_tags_;  // in lower case, to find duplicates
  bool is_monomer_ = false, is_reflections_ = false;
  int pair_item_ = kItems;
  std::vector<std::size_t> cell_items_;  // of the columns of a loop whose first values come
  bool is_cell_ = false;                 // some column is of the cell
  std::array<double, 6> cell_{};         // as unit_cell() takes them; 0: missing
  std::size_t cell_item_ = 6;            // the item of the last tag; 6: none of them
  Row pair_row_{};
  bool states_cell_ = false;
  std::int64_t atoms_ = 0;  // of all models
  std::int64_t without_place_ = 0;
  std::unordered_map<std::string, std::int64_t> model_of_name_;
  RawSpheres spheres_;
  AtomColumns columns_of_atoms_;
  Alternates alternates_;
  TextCollector label_chains_;
  std::string marks_;  // of alternate locations; 0: none
  CifRows tables_;
};

// The actions for the rules of the grammar.
namespace rules = gemmi::cif::rules;
template <class Rule>
struct Action : tao::pegtl::nothing<Rule> {};

template <class Input>
Value value_of(const Input& in) {
  return {{in.begin(), in.size()}, in.iterator().line, in.iterator().column};
}
template <>
struct Action<rules::datablockname> {
  template <class Input>
  static void apply(const Input&, AtomSites& sites) {
    sites.begin_block();
  }
};
template <>
struct Action<rules::str_global> {
  template <class Input>
  static void apply(const Input&, AtomSites& sites) {
    sites.begin_block();
  }
};
template <>
struct Action<rules::str_loop> {
  template <class Input>
  static void apply(const Input&, AtomSites& sites) {
    sites.begin_loop();
  }
};
template <>
struct Action<rules::loop_tag> {
  template <class Input>
  static void apply(const Input& in, AtomSites& sites) {
    sites.add_loop_tag(value_of(in));
  }
};
template <>
struct Action<rules::loop_value> {
  template <class Input>
  static void apply(const Input& in, AtomSites& sites) {
    sites.add_loop_value(value_of(in));
  }
};
template <>
struct Action<rules::loop> {
  template <class Input>
  static void apply(const Input&, AtomSites& sites) {
    sites.end_loop();
  }
};
template <>
struct Action<rules::item_tag> {
  template <class Input>
  static void apply(const Input& in, AtomSites& sites) {
    sites.add_pair_tag(value_of(in));
  }
};
template <>
struct Action<rules::item_value> {
  template <class Input>
  static void apply(const Input& in, AtomSites& sites) {
    sites.add_pair_value(value_of(in));
  }
};

Result<RawSpheres> read_mmcif(std::string_view text, const std::string& file, std::int64_t frame) {
  // The head of a long CIF may hold no atoms yet.
  if (is_small_cif(text)) return read_small_cif(text, file, frame);
  AtomSites sites(file, frame);
  try {
    tao::pegtl::memory_input<> input(text.data(), text.size(), file);
    tao::pegtl::parse<rules::file, Action, CifErrors>(input, sites);
    Result<RawSpheres> spheres = sites.finish();
    if (spheres || !sites.holds_monomers_alone()) return spheres;
    Result<std::optional<RawSpheres>> monomer = read_chem_comp(text, file, frame);
    if (!monomer) return monomer.error();
    return *monomer ? std::move(**monomer) : std::move(spheres);
  } catch (const Stop& stop) {
    return stop.error;
  } catch (const CifFault& fault) {
    return fault.in(file);
  } catch (const std::exception& e) {
    return Error{"reading CIF failed: " + std::string(e.what()), file, 0, 0, ""};
  }
}

}  // namespace

extern constexpr Format kMmcif(
    "mmCIF", ".cif .mmcif .pdbx .bcif", Format::kText | Format::kFrames, is_cif, read_mmcif,
    "`data_` | ATOM and HETATM of one model; the likeliest of alternate locations | van der Waals, by element");

}  // namespace bihive
