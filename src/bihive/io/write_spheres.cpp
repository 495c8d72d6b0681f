#include "bihive/io/write_spheres.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <unordered_set>

#include "bihive/base/parse_number.h"
#include "bihive/geometry/rounding_loss.h"
#include "bihive/io/elements.h"
#include "bihive/io/npy.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/io/write_molecules.h"

namespace bihive {
namespace {

// The shortest decimal that reads as the same number again. A number of 24 bits needs fewer digits, if single precision
// holds it and they cannot round up beyond its range.
void append_number(double value, std::string& out) {
  const float rounded = static_cast<float>(value);
  if (std::isnormal(rounded) && double(rounded) == value && std::abs(value) < 3.4e38)
    fmt::format_to(std::back_inserter(out), "{}", rounded);
  else
    fmt::format_to(std::back_inserter(out), "{}", value);
}

bool fits_single(const SphereSet& spheres) {
  const auto fits = [](double value) { return double(static_cast<float>(value)) == value; };
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d c = spheres.centre(id);
    if (!fits(c.x) || !fits(c.y) || !fits(c.z) || !fits(spheres.radius(id))) return false;
  }
  return true;
}

WrittenSpheres as_npy(const SphereSet& spheres) {
  const auto rows_of = [&spheres](auto zero) {
    std::vector<decltype(zero)> rows;
    rows.reserve(4 * static_cast<std::size_t>(spheres.size()));
    for (std::int64_t id = 0; id < spheres.size(); ++id) {
      const Vec3d c = spheres.centre(id);
      for (const double value : {c.x, c.y, c.z, spheres.radius(id)}) rows.push_back(static_cast<decltype(zero)>(value));
    }
    return npy_bytes(rows, {spheres.size(), 4});
  };
  return {fits_single(spheres) ? rows_of(0.0F) : rows_of(0.0), {}};
}

// One column of a table: its name, its kind in the format's words, and its text for a sphere.
struct OutColumn {
  std::string name, kind;
  std::function<void(std::size_t, std::string&)> append;
};

// The columns that a format holds of a set, in their order. What it cannot hold goes to `left_out`.
class ColumnsOut {
 public:
  ColumnsOut(const SphereSet& spheres, SphereFileFormat format) : spheres_(spheres), format_(format) {}

  std::vector<OutColumn> columns;
  std::vector<std::string> left_out;

  void collect() {
    if (format_ != SphereFileFormat::ply) add_element();
    add_places();
    const SphereAttributes& attributes = spheres_.attributes();
    if (format_ == SphereFileFormat::xyz) return note_all_attributes();
    add_number("radius", "R", [this](std::size_t i) { return spheres_.radius(static_cast<std::int64_t>(i)); });
    if (format_ == SphereFileFormat::ply && !attributes.element.empty())
      add("atomic_number", "uchar",
          [&attributes](std::size_t i, std::string& out) { out += std::to_string(attributes.element[i]); });
    add_type();
    add_colours();
    if (!attributes.opacity.empty())
      add_number("opacity", "R", [&attributes](std::size_t i) { return double(attributes.opacity[i]); });
    for (const NamedNumbers& numbers : attributes.numbers)
      add_number(
          free_name(numbers.name), "R", [&numbers](std::size_t i) { return numbers.values[i]; }, /*wide=*/true);
    for (const NamedTexts& texts : attributes.texts) add_texts(texts);
    if (!attributes.outline_px.empty() || !attributes.crease.empty() || !attributes.clips.empty())
      left_out.push_back("outlines, creases and clips: a scene file (.json) holds them");
  }

 private:
  void add(const std::string& name, const std::string& kind, std::function<void(std::size_t, std::string&)> append) {
    used_.insert(lower_case(name));
    columns.push_back({name, kind, std::move(append)});
  }

  template <class Value>
  void add_number(const std::string& name, const std::string& kind, Value value, bool wide = false) {
    const std::string of_ply = wide || !single_ ? "double" : "float";
    add(name, format_ == SphereFileFormat::ply ? of_ply : kind,
        [value](std::size_t i, std::string& out) { append_number(value(i), out); });
  }

  // Extended XYZ names the three places together, so its columns follow each other.
  void add_places() {
    single_ = fits_single(spheres_);
    const bool all_digits = needs_all_digits(spheres_);
    const std::string of_ply = single_ ? "float" : "double";
    for (int axis = 0; axis < 3; ++axis)
      add(std::string(1, "xyz"[axis]), format_ == SphereFileFormat::ply ? of_ply : "R",
          [this, axis, all_digits](std::size_t i, std::string& out) {
            const double value = spheres_.centre(static_cast<std::int64_t>(i))[axis];
            if (all_digits)
              fmt::format_to(std::back_inserter(out), "{}", value);
            else
              append_number(value, out);
          });
  }

  // Symbols if all are known: a symbol of none would be read as a label.
  void add_element() {
    const std::vector<std::uint8_t>& element = spheres_.attributes().element;
    const bool all_known = !element.empty() && std::find(element.begin(), element.end(), 0) == element.end();
    const bool xyz = format_ == SphereFileFormat::xyz;
    if (xyz || all_known) {
      const char* const name = format_ == SphereFileFormat::csv ? "element" : "species";
      return add(name, "S", [&element](std::size_t i, std::string& out) {
        const std::string symbol = element.empty() ? "" : element_symbol(element[i]);
        out += symbol.empty() ? "X" : symbol;
      });
    }
    if (format_ == SphereFileFormat::csv && element.empty()) return;
    add(format_ == SphereFileFormat::csv ? "atomic_number" : "Z", "I",
        [&element](std::size_t i, std::string& out) { out += std::to_string(element.empty() ? 0 : element[i]); });
  }

  void add_type() {
    const SphereAttributes& attributes = spheres_.attributes();
    if (attributes.type.empty()) return;
    const NamedTexts* const labels = attributes.find_texts("type");
    if (labels == nullptr || format_ == SphereFileFormat::ply)
      return add("type", format_ == SphereFileFormat::ply ? "int" : "I",
                 [&attributes](std::size_t i, std::string& out) { out += std::to_string(attributes.type[i]); });
    add("type", "S", [this, labels](std::size_t i, std::string& out) { append_text(labels->of(i), out); });
  }

  void add_colours() {
    const std::vector<Vec3f>& colour = spheres_.attributes().colour;
    if (colour.empty()) return;
    const char* const names[3] = {"red", "green", "blue"};
    for (int part = 0; part < 3; ++part)
      add_number(names[part], "R", [&colour, part](std::size_t i) { return double(colour[i][part]); });
  }

  void add_texts(const NamedTexts& texts) {
    if (format_ == SphereFileFormat::ply) {
      left_out.push_back("the texts '" + texts.name + "': PLY holds numbers alone");
      return;
    }
    if (texts.name == "type" && !spheres_.attributes().type.empty()) return;
    if (format_ == SphereFileFormat::extended_xyz) {
      const bool changed = std::any_of(texts.texts.begin(), texts.texts.end(), [](const std::string& one) {
        return one.empty() || one.find_first_of(" \t") != std::string::npos;
      });
      if (changed) left_out.push_back("of the texts '" + texts.name + "': empty ones became '.', blanks in them '_'");
    }
    if (format_ == SphereFileFormat::csv && !safe_in_csv(texts)) return;
    add(free_name(texts.name), "S", [this, &texts](std::size_t i, std::string& out) { append_text(texts.of(i), out); });
  }

  // A column of CSV is read as numbers if its first entry is one; then a text would be an error.
  bool safe_in_csv(const NamedTexts& texts) {
    const auto first =
        std::find_if(texts.text_of_sphere.begin(), texts.text_of_sphere.end(),
                     [&texts](std::int32_t text) { return !texts.texts[static_cast<std::size_t>(text)].empty(); });
    if (first == texts.text_of_sphere.end()) return false;  // all empty: nothing to say
    if (!parse_double(texts.texts[static_cast<std::size_t>(*first)])) return true;
    const bool all = std::all_of(texts.texts.begin(), texts.texts.end(),
                                 [](const std::string& one) { return one.empty() || parse_double(one); });
    left_out.push_back(all ? "the texts '" + texts.name + "' are numbers to who reads the file"
                           : "the texts '" + texts.name + "': the first one looks like a number");
    return all;
  }

  void append_text(const std::string& text, std::string& out) const {
    if (format_ == SphereFileFormat::extended_xyz) {
      if (text.empty()) out += '.';
      for (const char c : text) out += c == ' ' || c == '\t' ? '_' : c;
      return;
    }
    out += csv_field(text);
  }

  // A name that no other column has, that means nothing else in the format, and that breaks no header.
  std::string free_name(const std::string& wanted) const {
    static const std::unordered_set<std::string> reserved = {
        "x",   "y",     "z",    "radius",  "diameter",     "element", "symbol", "species", "atomic_number", "type",
        "red", "green", "blue", "opacity", "transparency", "r",       "pos",    "color",   "colour",        "numbers"};
    std::string name;
    // A semicolon anywhere in a header of CSV would be taken for the separator.
    const std::string_view bad = format_ == SphereFileFormat::csv ? ";" : " \t:=\"'";
    for (const char c : wanted) name += bad.find(c) != std::string_view::npos ? '_' : c;
    if (name.empty() || parse_double(name)) name = "_" + name;
    while (reserved.count(lower_case(name)) > 0 || used_.count(lower_case(name)) > 0) name += '_';
    return name;
  }

  void note_all_attributes() {
    const SphereAttributes& attributes = spheres_.attributes();
    std::string names = "radius";
    for (const NamedNumbers& numbers : attributes.numbers) names += ", " + numbers.name;
    for (const NamedTexts& texts : attributes.texts) names += ", " + texts.name;
    if (!attributes.type.empty()) names += ", type";
    if (!attributes.colour.empty()) names += ", colour";
    if (!attributes.opacity.empty()) names += ", opacity";
    left_out.push_back(names + ": plain XYZ holds symbols and places alone; extended XYZ (.extxyz) holds them");
  }

  const SphereSet& spheres_;
  SphereFileFormat format_;
  bool single_ = true;
  std::unordered_set<std::string> used_;
};

// In quotes, where a backslash is before what would end or change it.
std::string quoted_value(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string header_of_extended_xyz(const std::vector<OutColumn>& columns, std::string_view title) {
  std::string header = "Properties=";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) header += ':';
    if (columns[i].name == "x" || columns[i].name == "red") {
      header += columns[i].name == "x" ? "pos:R:3" : "colour:R:3";
      i += 2;
    } else {
      header += columns[i].name + ':' + columns[i].kind + ":1";
    }
  }
  if (!title.empty()) header += " title=" + quoted_value(title);
  return header + '\n';
}

std::string header_of_csv(const std::vector<OutColumn>& columns) {
  std::string header;
  for (const OutColumn& column : columns) header += (header.empty() ? "" : ",") + csv_field(column.name);
  return header + '\n';
}

std::string header_of_ply(const std::vector<OutColumn>& columns, std::int64_t count) {
  std::string header = "ply\nformat ascii 1.0\ncomment spheres; colours are linear, 0 to 1\nelement vertex " +
                       std::to_string(count) + '\n';
  for (const OutColumn& column : columns) header += "property " + column.kind + ' ' + column.name + '\n';
  return header + "end_header\n";
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",;\"\t\r\n") == std::string::npos && text == trim(text)) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

WrittenSpheres write_spheres(const SphereSet& spheres, SphereFileFormat format, std::string_view title) {
  if (format == SphereFileFormat::sdf) return write_sdf(spheres, title);
  if (format == SphereFileFormat::mol2) return write_mol2(spheres, title);
  ColumnsOut table(spheres, format);
  if (format == SphereFileFormat::npy) {
    WrittenSpheres written = as_npy(spheres);
    const SphereAttributes& attributes = spheres.attributes();
    if (!attributes.element.empty() || !attributes.type.empty() || !attributes.colour.empty() ||
        !attributes.opacity.empty() || !attributes.numbers.empty() || !attributes.texts.empty())
      written.left_out.push_back("all but places and radii: NPY holds one array");
    return written;
  }
  table.collect();

  WrittenSpheres written;
  written.left_out = std::move(table.left_out);
  const std::string count = std::to_string(spheres.size()) + '\n';
  if (format == SphereFileFormat::xyz) written.bytes = count + '\n';
  if (format == SphereFileFormat::extended_xyz) written.bytes = count + header_of_extended_xyz(table.columns, title);
  if (format == SphereFileFormat::csv) written.bytes = header_of_csv(table.columns);
  if (format == SphereFileFormat::ply) written.bytes = header_of_ply(table.columns, spheres.size());

  const char separator = format == SphereFileFormat::csv ? ',' : ' ';
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (i > 0) written.bytes += separator;
      table.columns[i].append(static_cast<std::size_t>(id), written.bytes);
    }
    written.bytes += '\n';
  }
  return written;
}

}  // namespace bihive
