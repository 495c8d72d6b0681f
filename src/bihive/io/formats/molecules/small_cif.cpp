// CIF of small molecules and crystals [IUCr-CIF] by gemmi: shares of the cell's vectors, and operations of symmetry,
// which fill the whole cell. Each data block with atoms is a frame.
#include <algorithm>
#include <array>
#include <cmath>
#include <gemmi/cif.hpp>
#include <gemmi/symmetry.hpp>
#include <limits>
#include <optional>

#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/elements.h"
#include "bihive/io/formats/molecules/cif.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// Images of one site that are nearer than this are one atom on a special position, written with few digits. gemmi has
// the same distance.
constexpr double kSamePlace = 0.4;  // Angstrom
// A face-centred cubic group has 192.
constexpr std::size_t kMostOperations = 192;

struct Operation {
  std::array<std::array<double, 3>, 3> turn{};
  std::array<double, 3> shift{};

  Vec3d of(Vec3d f) const {
    Vec3d image;
    for (int i = 0; i < 3; ++i) {
      const auto& row = turn[static_cast<std::size_t>(i)];
      image[i] = row[0] * f.x + row[1] * f.y + row[2] * f.z + shift[static_cast<std::size_t>(i)];
    }
    return image;
  }
};

Operation operation_of(const gemmi::Op& op) {
  Operation made;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) made.turn[i][j] = double(op.rot[i][j]) / gemmi::Op::DEN;
    made.shift[i] = double(op.tran[i]) / gemmi::Op::DEN;
  }
  return made;
}

// A number that may have a standard uncertainty in brackets: 1.234(5).
std::optional<double> cif_number(const std::string& text) {
  return parse_double(std::string_view(text).substr(0, text.find('(')));
}

// "C", "Fe3+", "O2-", or a label: "C12", "Cl1A".
int element_of_text(std::string_view text) {
  std::size_t letters = 0;
  while (letters < text.size() && letters < 2 &&
         ((text[letters] >= 'A' && text[letters] <= 'Z') || (text[letters] >= 'a' && text[letters] <= 'z')))
    ++letters;
  const int of_two = letters == 2 ? atomic_number(text.substr(0, 2)) : 0;
  return of_two ? of_two : letters > 0 ? atomic_number(text.substr(0, 1)) : 0;
}

// "x+.5, y, z+.333" as "x+12/24, y, z+8/24": gemmi reads fractions. Decimals that are near none stay as they are.
std::string with_fractions(const std::string& text) {
  std::string made;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find_first_not_of("0123456789.", at);
    end = std::min(end, text.size());
    const std::string_view number = std::string_view(text).substr(at, end - at);
    const auto value = number.find('.') == std::string_view::npos ? std::nullopt : parse_double(number);
    const double parts = value ? *value * gemmi::Op::DEN : 0;
    if (value && parts < 1000 && std::abs(parts - std::round(parts)) < 0.02)
      made += std::to_string(std::lround(parts)) + "/" + std::to_string(gemmi::Op::DEN);
    else
      made += number;
    if (end == at) made += text[end++];
    at = end;
  }
  return made;
}

class CrystalReader {
 public:
  CrystalReader(gemmi::cif::Block& block, const std::string& file) : block_(block), file_(file) {
    spheres_.format = "CIF";
  }

  Result<RawSpheres> read() {
    if (Status cell = read_cell(); !cell) return cell.error();
    if (Status operations = read_operations(); !operations) return operations.error();
    if (Status sites = read_sites(); !sites) return sites.error();
    finish();
    return std::move(spheres_);
  }

 private:
  Error error(const std::string& message, int line = 0, const std::string& hint = "") const {
    return {"block " + quote(block_.name) + ": " + message, file_, line, 0, hint};
  }

  Status read_cell() {
    const char* const tags[6] = {"_cell_length_a",    "_cell_length_b",   "_cell_length_c",
                                 "_cell_angle_alpha", "_cell_angle_beta", "_cell_angle_gamma"};
    std::array<double, 6> numbers{};
    for (std::size_t i = 0; i < 6; ++i) {
      const gemmi::cif::Item* const item = block_.find_pair_item(tags[i]);
      if (item == nullptr) return error("there is no " + std::string(tags[i]));
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

  // The operations that the file lists, else those of the group that it names.
  Status read_operations() {
    for (const char* const tag : {"_space_group_symop_operation_xyz", "_symmetry_equiv_pos_as_xyz"}) {
      gemmi::cif::Column column = block_.find_values(tag);
      if (column.length() <= 0) continue;
      const int line = column.item() ? column.item()->line_number : 0;
      if (static_cast<std::size_t>(column.length()) > kMostOperations)
        return error("expected at most 192 operations of symmetry", line);
      for (int i = 0; i < column.length(); ++i) {
        const std::string text = column.str(i);
        try {
          if (text.size() > 80) throw std::runtime_error("too long");
          operations_.push_back(operation_of(gemmi::parse_triplet(with_fractions(text))));
        } catch (const std::runtime_error&) {
          return error("expected an operation of symmetry such as 'x, y+1/2, -z' but found " + quote(text), line);
        }
      }
      spheres_.rules.push_back("symmetry: the " + std::to_string(operations_.size()) + " operations of the file");
      return Done{};
    }
    std::string name;
    const gemmi::SpaceGroup* group = nullptr;
    for (const char* const tag : {"_space_group_name_Hall", "_symmetry_space_group_name_Hall"})
      if (const std::string* const value = block_.find_value(tag); value && !group && !gemmi::cif::is_null(*value)) {
        name = gemmi::cif::as_string(*value);
        for (const gemmi::SpaceGroup& one : gemmi::spacegroup_tables::main)
          if (!group && name == one.hall) group = &one;
      }
    for (const char* const tag : {"_space_group_name_H-M_alt", "_symmetry_space_group_name_H-M",
                                  "_space_group_IT_number", "_symmetry_Int_Tables_number"})
      if (const std::string* const value = block_.find_value(tag); value && !group && !gemmi::cif::is_null(*value)) {
        name = gemmi::cif::as_string(*value);
        if (name.empty() || name.size() >= 80) continue;
        // Some groups have hexagonal and rhombohedral axes; the cell's angles tell which these are.
        if (const auto number = parse_int(name)) {
          const gemmi::SpaceGroup* const numbered =
              *number >= 1 && *number <= 230 ? gemmi::find_spacegroup_by_number(static_cast<int>(*number)) : nullptr;
          if (numbered != nullptr) group = gemmi::find_spacegroup_by_name(numbered->hm, alpha_, gamma_);
        } else {
          group = gemmi::find_spacegroup_by_name(name, alpha_, gamma_);
        }
      }
    if (group == nullptr) {
      operations_.push_back(operation_of(gemmi::Op::identity()));
      if (name.empty())
        spheres_.rules.push_back("symmetry: none, as the file states none");
      else
        spheres_.warnings.push_back(file_ + ": the space group " + quote(name) +
                                    " is unknown, so the atoms stay without their images");
      return Done{};
    }
    for (const gemmi::Op& op : group->operations()) operations_.push_back(operation_of(op));
    spheres_.rules.push_back("symmetry: the " + std::to_string(operations_.size()) + " operations of the group " +
                             group->xhm());
    return Done{};
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
      const std::string symbol = row.has2(kSymbol) ? row.str(kSymbol) : label;
      const auto number_in = [&row](std::size_t column, double otherwise) {
        return row.has2(column) ? cif_number(row[column]).value_or(otherwise) : otherwise;
      };
      constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
      constexpr double kBOfU = 78.95683520871486;  // 8 pi^2
      const double b = row.has2(kBiso) ? number_in(kBiso, kUnknown) : kBOfU * number_in(kUiso, kUnknown);
      has_b_ = has_b_ || !std::isnan(b);
      add_images(fraction, label, symbol, row.has2(kGroup) ? row.str(kGroup) : "", number_in(kOccupancy, 1), b);
    }
    if (without_place > 0)
      spheres_.warnings.push_back(file_ + ": " + spheres_have(without_place) +
                                  " no place ('?'), so the file's other atoms are shown");
    return Done{};
  }

  // The images of a site inside of the cell, each once.
  void add_images(Vec3d fraction, const std::string& label, const std::string& symbol, const std::string& group,
                  double occupancy, double b) {
    const Vec3d va = spheres_.cell->vectors[0], vb = spheres_.cell->vectors[1], vc = spheres_.cell->vectors[2];
    std::vector<Vec3d> images;
    for (std::size_t i = 0; i < operations_.size(); ++i) {
      Vec3d image = operations_[i].of(fraction);
      for (int axis = 0; axis < 3; ++axis)
        for (int turn = 0; turn < 2; ++turn) image[axis] -= std::floor(image[axis]);
      const bool known = std::any_of(images.begin(), images.end(), [&](Vec3d other) {
        Vec3d step = image - other;
        for (int axis = 0; axis < 3; ++axis) step[axis] -= std::floor(step[axis] + 0.5);
        const Vec3d way = step.x * va + step.y * vb + step.z * vc;
        return dot(way, way) < kSamePlace * kSamePlace;
      });
      if (known) continue;
      images.push_back(image);
      const Vec3d at = image.x * va + image.y * vb + image.z * vc;
      spheres_.x.push_back(at.x);
      spheres_.y.push_back(at.y);
      spheres_.z.push_back(at.z);
      spheres_.attributes.element.push_back(static_cast<std::uint8_t>(element_of_text(symbol)));
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
  }

  gemmi::cif::Block& block_;
  const std::string& file_;
  RawSpheres spheres_;
  std::vector<Operation> operations_;
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
  // The tags may be anywhere in the file.
  constexpr std::string_view tag = "_atom_site_";
  for (std::size_t at = text.find(tag); at != std::string_view::npos; at = text.find(tag, at + tag.size()))
    if (lower_case(text.substr(at + tag.size(), 6)) == "fract_") return true;
  return false;
}

Result<RawSpheres> read_small_cif(std::string_view text, const std::string& file, std::int64_t frame) {
  try {
    namespace cif = gemmi::cif;
    cif::Document document;
    tao::pegtl::memory_input<> input(text.data(), text.size(), file);
    tao::pegtl::parse<cif::rules::file, cif::Action, cif::Errors>(input, document);
    std::int64_t frames = 0;
    cif::Block* wanted = nullptr;
    for (cif::Block& block : document.blocks) {
      if (block.find_values("_atom_site_fract_x").length() <= 0) continue;
      if (frames++ == frame) wanted = &block;
    }
    if (wanted == nullptr) return no_such_frame(file, frame, frames);
    Result<RawSpheres> spheres = CrystalReader(*wanted, file).read();
    if (spheres) {
      spheres->frames = frames;
      if (frames > 1) spheres->rules.push_back("frame: the data block " + quote(wanted->name));
    }
    return spheres;
  } catch (const tao::pegtl::parse_error& e) {
    const tao::pegtl::position at = e.positions().empty() ? tao::pegtl::position(1, 1, 1, file) : e.positions().front();
    return Error{"this is no CIF: " + std::string(e.message()), file, static_cast<std::int64_t>(at.line),
                 static_cast<std::int64_t>(at.column), ""};
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
