// Files with many frames, made anew for tests; and whether two readings are the same bit for bit.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "bihive/io/read_spheres.h"
#include "bihive/math/rng.h"

namespace bihive::test {

struct Film {
  std::string name;  ///< of the file, with its ending
  std::string bytes;
};

/// Everything of a reading as bytes: equal texts are equal readings.
class Fingerprint {
 public:
  explicit Fingerprint(const SphereFile& file) {
    const SphereSet& set = file.spheres;
    for (const auto* axis : {&set.x(), &set.y(), &set.z(), &set.r()}) add(*axis);
    add(set.scale_exponent());
    add(set.origin());
    add(set.vanishing_radii());
    add(set.cell());
    add(set.images().counts);
    add(set.images().vectors);
    const SphereAttributes& attributes = set.attributes();
    add(attributes.element);
    add(attributes.type);
    add(attributes.colour);
    add(attributes.opacity);
    for (const NamedNumbers& column : attributes.numbers) {
      add(column.name);
      add(column.values);
    }
    for (const NamedTexts& column : attributes.texts) {
      add(column.name);
      add(column.texts);
      add(column.text_of_sphere);
    }
    add(file.format);
    add(file.frames);
    add(file.rules);
    add(file.warnings);
    add(file.assemblies);
    add(file.time_ps);
    add(file.step);
    add(file.recentred_by);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  // It has bytes between its members, which mean nothing.
  void add(const Cell& cell) {
    add(cell.origin);
    add(cell.vectors);
    add(cell.periodic);
  }
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
  }

  std::string bytes_;
};

/// The reading, or its error, as bytes.
inline std::string outcome(const Result<SphereFile>& file) {
  return file ? Fingerprint(*file).bytes() : "error: " + file.error().to_string();
}

inline std::string formatted(const char* format, double x, double y, double z) {
  char text[100];
  std::snprintf(text, sizeof text, format, x, y, z);
  return text;
}

/// One file for each text format with many frames, and variants of them. The number of spheres changes from frame to
/// frame, from 1 up to `most`.
inline std::vector<Film> make_films(int frames, int most, std::uint64_t seed = 1) {
  SplitMix64 rng(seed);
  const auto place = [&rng](const char* format) {
    const double x = 20 * rng.next_double(), y = 20 * rng.next_double(), z = 20 * rng.next_double();
    return formatted(format, x, y, z);
  };
  const char* const elements[] = {"C", "O", "N", "H"};
  std::string pdb =
      "REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n"
      "REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000\n"
      "REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000\n"
      "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        5.00000\n";
  std::string pdb_of_one_cell = "CRYST1   30.000   31.000   32.000  90.00  90.00  90.00 P 1           1\n";
  std::string pqr, xyz, labels, extended, gro, dump, scaled, cif;
  for (int frame = 0; frame < frames; ++frame) {
    const int count = 1 + static_cast<int>(rng.next_double() * most);
    const std::string number = std::to_string(frame), counted = std::to_string(count);
    pdb += "CRYST1" + formatted("%9.3f%9.3f%9.3f", 30 + frame, 31, 32) + "  90.00  90.00  90.00 P 1           1\n";
    pdb += "MODEL " + number + "\n";
    pdb_of_one_cell += "MODEL " + number + "\n";
    if (frame % 3 == 0) xyz += "\n\n";
    xyz += counted + "\nframe " + number + "\n";
    labels += counted + "\nframe " + number + "\n";
    extended += counted + "\nLattice=\"" + formatted("%g 0 0 0 %g 0 0 0 %g", 10 + frame, 11, 12) +
                "\" Properties=species:S:1:pos:R:3:radius:R:1:charge:R:1 Time=" + number + "\n";
    gro += "water t= " + number + ".5 step= " + number + "0\n" + counted + "\n";
    const std::string head = "ITEM: TIMESTEP\n" + number + "00\nITEM: NUMBER OF ATOMS\n" + counted +
                             "\nITEM: BOX BOUNDS pp pp pp\n0 1" + number + "\n0 20\n0 20\nITEM: ATOMS id type ";
    dump += (frame == 0 ? "ITEM: UNITS\nreal\nITEM: TIME\n" : "ITEM: TIME\n") + number + "\n" + head + "x y z\n";
    scaled += head + "xs ys zs element\n";
    for (int i = 0; i < count; ++i) {
      const std::string id = std::to_string(i + 1), element = elements[i % 4];
      char atom[100];
      std::snprintf(atom, sizeof atom, "ATOM  %5d  %s%s ALA A%4d    ", i + 1, element.c_str(), i % 5 == 0 ? "A " : "  ",
                    i / 3);
      const std::string line = atom + place("%8.3f%8.3f%8.3f") + "  1.00 10.00           " + element + "\n";
      pdb += line;
      pdb_of_one_cell += line;
      pqr +=
          "ATOM " + id + " " + element + "A ALA A " + std::to_string(i / 3) + place(" %.3f %.3f %.3f") + " 0.1 1.5\n";
      xyz += element + place(" %.4f %.4f %.4f") + "\n";
      labels += "bead" + id + place(" %.4f %.4f %.4f") + "\n";
      extended += element + place(" %.4f %.4f %.4f") + " 0.5 " + id + "\n";
      std::snprintf(atom, sizeof atom, "%5d%-5s%5s%5d", i / 3, "SOL", i % 3 == 0 ? "OW" : "HW1", i + 1);
      gro += atom + place("%8.3f%8.3f%8.3f") + "\n";
      dump += id + " " + std::to_string(i % 3 + 1) + place(" %.5f %.5f %.5f") + "\n";
      scaled += id + " 1" + formatted(" %.5f %.5f %.5f", rng.next_double(), rng.next_double(), rng.next_double()) +
                " " + element + "\n";
      cif += "ATOM " + element + place(" %.3f %.3f %.3f") + " A " + number + "\n";
    }
    pdb += "ENDMDL\n";
    pdb_of_one_cell += frame % 2 == 0 ? "TER\nENDMDL\n" : "END\n";
    pqr += "END\n";
    gro += "   2.0   2.0   2.0\n";
  }
  const auto with_crlf = [](const std::string& text) {
    std::string made;
    for (const char c : text) made += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return made;
  };
  return {{"a.pdb", pdb},
          {"one_cell.pdb", pdb_of_one_cell},
          {"cell_behind.pdb", pdb_of_one_cell.substr(pdb_of_one_cell.find('\n') + 1) +
                                  pdb_of_one_cell.substr(0, pdb_of_one_cell.find('\n') + 1)},
          {"a.pqr", pqr},
          {"a.cif",
           "data_a\nloop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.Cartn_x\n"
           "_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.auth_asym_id\n"
           "_atom_site.pdbx_PDB_model_num\n" +
               cif},
          {"a.xyz", xyz},
          {"labels.xyz", labels},
          {"marked.xyz", "\xEF\xBB\xBF" + labels},
          {"text_behind.xyz", xyz + "made by a program\nthat says so\n"},
          {"crlf.xyz", with_crlf(labels)},
          {"no_end.xyz", xyz.substr(0, xyz.size() - 1)},
          {"a.extxyz", extended},
          {"a.gro", gro},
          {"crlf.gro", with_crlf(gro)},
          {"a.dump", dump},
          {"scaled.dump", scaled}};
}

}  // namespace bihive::test
