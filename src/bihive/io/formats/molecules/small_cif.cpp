// CIF of small molecules and crystals [IUCr-CIF] by gemmi: shares of the cell's vectors, and operations of symmetry,
// which fill the whole cell. Each data block with atoms is a frame.
#include <algorithm>
#include <array>
#include <cmath>
#include <gemmi/cif.hpp>
#include <limits>
#include <optional>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/formats/molecules/cif.h"
#include "bihive/io/formats/molecules/cif_elements.h"
#include "bihive/io/formats/molecules/cif_errors.h"
#include "bihive/io/formats/molecules/cif_symmetry.h"
#include "bihive/io/formats/molecules/listed_images.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/text/title.h"

namespace bihive {
namespace {

// Images of one site that are nearer than this are one atom on a special position, written with few digits. gemmi has
// the same distance.
constexpr double kSamePlace = 0.4;  // Angstrom

// A number that may have a standard uncertainty in brackets: 1.234(5).
std::optional<double> cif_number(const std::string& text) {
  return parse_double(std::string_view(text).substr(0, text.find('(')));
}

class CrystalReader {
 public:
  CrystalReader(gemmi::cif::Block& block, const std::string& file) : block_(block), file_(file) {
    spheres_.format = "CIF";
  }

  Result<RawSpheres> read() {
    unify_tags();
    if (Status cell = read_cell(); !cell) return cell.error();
    if (Status operations = read_operations(); !operations) return operations.error();
    read_formula();
    read_title();
    if (Status sites = read_sites(); !sites) return sites.error();
    finish();
    return std::move(spheres_);
  }

 private:
  Error error(const std::string& message, int line = 0, const std::string& hint = "") const {
    return {"block " + quote(block_.name) + ": " + message, file_, line, 0, hint};
  }

  // Newer dictionaries have a dot between category and item: _space_group.IT_number is _space_group_IT_number.
  void unify_tags() {
    const auto unify = [](std::string& tag) {
      if (const std::size_t dot = tag.find('.'); dot != std::string::npos) tag[dot] = '_';
    };
    for (gemmi::cif::Item& item : block_.items) {
      if (item.type == gemmi::cif::ItemType::Pair) unify(item.pair[0]);
      if (item.type == gemmi::cif::ItemType::Loop)
        for (std::string& tag : item.loop.tags) unify(tag);
    }
  }

  Status read_cell() {
    const char* const tags[6] = {"_cell_length_a",    "_cell_length_b",   "_cell_length_c",
                                 "_cell_angle_alpha", "_cell_angle_beta", "_cell_angle_gamma"};
    std::array<double, 6> numbers{};
    for (std::size_t i = 0; i < 6; ++i) {
      const gemmi::cif::Item* const item = block_.find_pair_item(tags[i]);
      const bool is_known = item != nullptr && !gemmi::cif::is_null(item->pair[1]);
      // The dictionary says that an angle which is not stated is 90 degrees.
      if (!is_known && i >= 3) {
        numbers[i] = 90;
        continue;
      }
      if (item == nullptr) return error("there is no " + std::string(tags[i]));
      if (!is_known) return error("the value of " + std::string(tags[i]) + " is unknown", item->line_number);
      const auto number = cif_number(item->pair[1]);
      if (!number)
        return error("expected a number for " + std::string(tags[i]) + " but found " + quote(item->pair[1]),
                     item->line_number);
      numbers[i] = *number;
    }
    alpha_ = numbers[3];
    gamma_ = numbers[5];
    spheres_.cell = unit_cell(numbers);
    if (!spheres_.cell) return error("the lengths and angles of _cell_ make no cell");
    return Done{};
  }

  Status read_operations() {
    Result<CifSymmetry> symmetry = symmetry_of(block_, alpha_, gamma_);
    if (!symmetry) return error(symmetry.error().message, static_cast<int>(symmetry.error().line));
    operations_ = std::move(symmetry->operations);
    if (!symmetry->rule.empty()) spheres_.rules.push_back(symmetry->rule);
    if (!symmetry->warning.empty()) spheres_.warnings.push_back(file_ + ": " + symmetry->warning);
    return Done{};
  }

  // What the file says of its elements beside the atoms.
  void read_formula() {
    if (const std::string* const formula = block_.find_value("_chemical_formula_sum"))
      elements_.add_formula(gemmi::cif::as_string(*formula));
    for (const std::string& symbol : block_.find_values("_atom_type_symbol"))
      elements_.add_type_symbol(gemmi::cif::as_string(symbol));
  }

  // The name of the substance, else the title of the publication.
  void read_title() {
    for (const char* const tag :
         {"_chemical_name_common", "_chemical_name_mineral", "_chemical_name_systematic", "_publ_section_title"}) {
      const std::string* const value = block_.find_value(tag);
      if (value == nullptr || gemmi::cif::is_null(*value)) continue;
      spheres_.title = title_from(gemmi::cif::as_string(*value));
      if (!spheres_.title.empty()) return;
    }
  }

  Status read_sites() {
    enum { kX, kY, kZ, kLabel, kSymbol, kOccupancy, kUiso, kBiso, kGroup };
    gemmi::cif::Table table =
        block_.find("_atom_site_", {"fract_x", "fract_y", "fract_z", "?label", "?type_symbol", "?occupancy",
                                    "?U_iso_or_equiv", "?B_iso_or_equiv", "?disorder_group"});
    if (!table.ok()) return error("expected _atom_site_fract_x, _atom_site_fract_y and _atom_site_fract_z");
    const gemmi::cif::Loop* const loop = table.get_loop();
    int line = 0;
    for (const gemmi::cif::Item& item : block_.items)
      if (item.type == gemmi::cif::ItemType::Loop && &item.loop == loop) line = item.line_number;
    if (loop)
      for (std::size_t i = 0; i < loop->tags.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (lower_case(loop->tags[i]) == lower_case(loop->tags[j]))
            return error("the column " + quote(loop->tags[i]) + " comes twice", line);
    if (Status status = check_memory(double(table.length()) * double(operations_.size()) * 8 * sizeof(double),
                                     "the atoms of a whole cell");
        !status)
      return error(status.error().message);
    std::int64_t without_place = 0;
    if (operations_.size() > 1) listed_.emplace(*spheres_.cell);
    for (gemmi::cif::Table::Row row : table) {
      const std::string label = row.has2(kLabel) ? row.str(kLabel) : "";
      Vec3d fraction;
      bool known = true;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string& text = row[static_cast<std::size_t>(axis)];
        known = known && !gemmi::cif::is_null(text);
        if (!known) break;
        const auto number = cif_number(text);
        const std::string what = "_atom_site_fract_" + std::string(1, "xyz"[axis]) + " of the atom " + quote(label);
        if (!number) return error("expected a number for " + what + " but found " + quote(text), line);
        // Larger ones have lost their place in the cell to rounding.
        if (!(std::abs(*number) < 1e6)) return error(what + " is no share of a cell: " + quote(text), line);
        fraction[axis] = *number;
      }
      if (!known) {
        ++without_place;
        continue;
      }
      const std::string symbol = row.has2(kSymbol) ? row.str(kSymbol) : "";
      const int stated = element_of_type_symbol(symbol);
      const int element = stated != 0 ? stated : elements_.of(symbol.empty() ? label : symbol);
      const auto number_in = [&row](std::size_t column, double otherwise) {
        return row.has2(column) ? cif_number(row[column]).value_or(otherwise) : otherwise;
      };
      constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
      constexpr double kBOfU = 78.95683520871486;  // 8 pi^2
      const double b = row.has2(kBiso) ? number_in(kBiso, kUnknown) : kBOfU * number_in(kUiso, kUnknown);
      has_b_ = has_b_ || !std::isnan(b);
      const double occupancy = number_in(kOccupancy, 1);
      if (listed_ && listed_->is_image_of_another(wrapped(fraction), element, occupancy)) {
        if (twice_++ == 0) first_twice_ = label;
        continue;
      }
      add_images(fraction, label, element, row.has2(kGroup) ? row.str(kGroup) : "", occupancy, b);
    }
    if (twice_ > 0)
      spheres_.warnings.push_back(
          file_ + ": " + std::to_string(twice_) + (twice_ == 1 ? " listed atom is" : " listed atoms are") +
          " at the place of an image of another one (first " + quote(first_twice_) + ") and not taken twice");
    if (without_place > 0)
      spheres_.warnings.push_back(file_ + ": " + spheres_have(without_place) +
                                  " no place ('?'), so the file's other atoms are shown");
    return Done{};
  }

  // The fractions inside of the cell.
  static Vec3d wrapped(Vec3d fraction) {
    for (int axis = 0; axis < 3; ++axis)
      for (int turn = 0; turn < 2; ++turn) fraction[axis] -= std::floor(fraction[axis]);
    return fraction;
  }

  // The images of a site inside of the cell, each once.
  void add_images(Vec3d fraction, const std::string& label, int element, const std::string& group, double occupancy,
                  double b) {
    const Vec3d va = spheres_.cell->vectors[0], vb = spheres_.cell->vectors[1], vc = spheres_.cell->vectors[2];
    const Vec3d as_listed = wrapped(fraction);
    std::vector<Vec3d> images;
    for (std::size_t i = 0; i < operations_.size(); ++i) {
      const Vec3d image = wrapped(operations_[i].of(fraction));
      const bool known = std::any_of(images.begin(), images.end(), [&](Vec3d other) {
        Vec3d step = image - other;
        for (int axis = 0; axis < 3; ++axis) step[axis] -= std::floor(step[axis] + 0.5);
        const Vec3d way = step.x * va + step.y * vb + step.z * vc;
        return dot(way, way) < kSamePlace * kSamePlace;
      });
      if (known) continue;
      images.push_back(image);
      if (listed_) listed_->add(image, as_listed, element, occupancy);
      const Vec3d at = image.x * va + image.y * vb + image.z * vc;
      spheres_.x.push_back(at.x);
      spheres_.y.push_back(at.y);
      spheres_.z.push_back(at.z);
      spheres_.attributes.element.push_back(static_cast<std::uint8_t>(element));
      occupancy_.values.push_back(occupancy);
      b_factor_.values.push_back(b);
      copy_.values.push_back(double(i + 1));
      names_.add(label);
      groups_.add(group);
    }
  }

  void finish() {
    SphereAttributes& attributes = spheres_.attributes;
    if (std::all_of(attributes.element.begin(), attributes.element.end(), [](auto number) { return number == 0; }))
      attributes.element.clear();
    attributes.numbers.push_back(std::move(occupancy_));
    if (has_b_) attributes.numbers.push_back(std::move(b_factor_));
    attributes.numbers.push_back(std::move(copy_));
    attributes.texts.push_back(printable_texts(names_.take("name")));
    if (!groups_.all_empty()) attributes.texts.push_back(printable_texts(groups_.take("disorder_group")));
    spheres_.rules.push_back(
        "atoms: the whole cell, all in it; 'copy 1' selects the atoms that the file lists, and other numbers those of "
        "other operations");
    spheres_.rules.push_back("images of one atom nearer than 0.4 Angstrom are one");
    if (elements_.has_guessed())
      spheres_.rules.push_back(
          "elements: of labels in capitals (HO1) the first letter, except BR, CL, FE, PT, SE and SI");
  }

  gemmi::cif::Block& block_;
  const std::string& file_;
  RawSpheres spheres_;
  std::vector<SymmetryOperation> operations_;
  LabelElements elements_;
  std::optional<ListedImages> listed_;
  std::int64_t twice_ = 0;
  std::string first_twice_;
  NamedNumbers occupancy_{"occupancy", {}}, b_factor_{"b_factor", {}}, copy_{"copy", {}};
  TextCollector names_, groups_;
  bool has_b_ = false;
  double alpha_ = 0, gamma_ = 0;  // of the cell, degrees
};

}  // namespace

bool is_cif(const FileHead& head) {
  TextScanner scanner = head.text;
  while (trim(scanner.line()).substr(0, 1) == "#")
    if (!scanner.next_filled_line()) return false;
  return lower_case(trim(scanner.line()).substr(0, 5)) == "data_";
}

bool is_small_cif(std::string_view text) {
  // The tags may be anywhere in the file. With a dot they stand beside places of mmCIF, too.
  constexpr std::string_view category = "_atom_site";
  bool has_dotted = false;
  for (std::size_t at = text.find(category); at != std::string_view::npos; at = text.find(category, at + 1)) {
    const std::string item = lower_case(text.substr(at + category.size(), 7));
    if (item == "_fract_") return true;
    if (item == ".cartn_") return false;
    has_dotted = has_dotted || item == ".fract_";
  }
  return has_dotted;
}

Result<RawSpheres> read_small_cif(std::string_view text, const std::string& file, std::int64_t frame) {
  try {
    namespace cif = gemmi::cif;
    cif::Document document;
    tao::pegtl::memory_input<> input(text.data(), text.size(), file);
    tao::pegtl::parse<cif::rules::file, CifActions, CifErrors>(input, document);
    std::int64_t frames = 0;
    cif::Block* wanted = nullptr;
    for (cif::Block& block : document.blocks) {
      if (block.find_values("_atom_site_fract_x").length() <= 0 &&
          block.find_values("_atom_site.fract_x").length() <= 0)
        continue;
      if (frames++ == frame) wanted = &block;
    }
    if (wanted == nullptr) return no_such_frame(file, frame, frames);
    Result<RawSpheres> spheres = CrystalReader(*wanted, file).read();
    if (spheres) {
      spheres->frames = frames;
      if (frames > 1) spheres->rules.push_back("frame: the data block " + quote(wanted->name));
    }
    return spheres;
  } catch (const CifFault& fault) {
    return fault.in(file);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    return Error{"reading CIF failed: " + printable(e.what()), file, 0, 0, ""};
  }
}

extern constexpr Format kCrystalCif(
    "CIF of crystals", "", Format::kText | Format::kFrames,
    [](const FileHead& head) { return is_cif(head) && is_small_cif(head.bytes); }, read_small_cif,
    "`data_` and `_atom_site_fract_` | the whole cell, by its symmetry | van der Waals, by element");

}  // namespace bihive
