#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "bihive/io/elements.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/npy.h"
#include "bihive/io/read_spheres.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::error_of;
using test::read_text;

std::string_view name_of(const Format* format) {
  return format == nullptr ? "none" : format->name;
}

TEST(Detect, GoesByContentFirst) {
  const std::pair<const char*, const char*> cases[] = {
      {"\n  \nITEM: TIMESTEP\n0\n", "LAMMPS dump"},
      {"HEADER    X\n", "PDB"},
      {"ATOM      1  N   ALA A   1      11.104   6.134  -6.504\n", "PDB"},
      {"HETATM99999  N   ALA A   1      11.104   6.134  -6.504\n", "PDB"},
      {"CRYST1    1.000\n", "PDB"},
      {"data_1ABC\n", "mmCIF"},
      {"# comment\n\nDATA_x\n", "mmCIF"},
      {"12\ncomment\n", "XYZ"},
      {"100000000000\n", "XYZ"},
      {"3\n3 atoms\nO 0 0 0\n", "XYZ"},
      {"1 2 3\n", "CSV"},
      {"# comment\n1,2,3,4\n", "CSV"},
      {"\xEF\xBB\xBFid;X;Y;Z\n", "CSV"},
      {"\"x\",\"y\",\"z\"\n", "CSV"},
      {"x\ty\tz\tcolumn 4\n", "CSV"},
      {"\x93NUMPY", "NPY"},
      {"ply\nformat ascii 1.0\n", "PLY"},
      {"# .PCD v0.7\nVERSION 0.7\n", "PCD"},
      {"VERSION 0.7\nFIELDS x y z\n", "PCD"},
      {"# vtk DataFile Version 3.0\npoints\nASCII\n", "VTK"},
      {"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n", "VTK XML"},
      {"data_x\n_cell_length_a 1\n_atom_site_fract_x 0\n", "CIF of crystals"},
      {"SITE\n\n4 atoms\n1 atom types\n", "LAMMPS data"},
      {"diamond\n3.7\n0.5 0.5 0.0\n0.0 0.5 0.5\n0.5 0.0 0.5\nC\n2\nDirect\n0 0 0\n", "POSCAR"},
      {"12\n3.7\n0.5 0.5 0.0\n0.0 0.5 0.5\n0.5 0.0 0.5\n2\nselective\nDirect\n0 0 0\n", "POSCAR"},
      {"run\n1\n5 0 0\n0 5 0\n0 0 5\nC\n2\nDirect configuration=     1\n0 0 0\n", "XDATCAR"},
      {"\n  program\n\n  6  6  0  0  0  0  0  0  0  0999 V2000\n", "SDF"},
      {"# name\n\n@<TRIPOS>MOLECULE\nbenzene\n", "MOL2"},
  };
  for (const auto& [text, format] : cases)
    for (const char* name : {"a", "a.pdb", "a.npy", "a.xyz.gz"})
      EXPECT_EQ(name_of(format_by_content(text, name)), format) << text << " as " << name;
}

TEST(Detect, TheEndingDecidesWhereFirstLinesFitTwoFormats) {
  // The name of a record, which is also that of a column.
  const char* const table = "SITE   x y z\n1 0 0 0\n";
  EXPECT_EQ(name_of(format_by_content(table, "a")), "PDB");
  EXPECT_EQ(name_of(format_by_content(table, "a.txt")), "CSV");
  EXPECT_EQ(name_of(format_by_content("data_x\n_cell_length_a 1\n_atom_site_fract_x 0\n", "a.cif")), "CIF of crystals");
}

TEST(Detect, GoesByNameWhereContentSaysNothing) {
  const std::pair<const char*, const char*> cases[] = {
      {"a.pdb", "PDB"},       {"a.ENT", "PDB"},     {"b/a.cif.gz", "mmCIF"},   {"a.mmcif", "mmCIF"},
      {"a.xyz", "XYZ"},       {"a.extxyz", "XYZ"},  {"a.dump", "LAMMPS dump"}, {"a.lammpstrj", "LAMMPS dump"},
      {"a.csv", "CSV"},       {"a.tsv", "CSV"},     {"a.txt.GZ", "CSV"},       {"a.dat", "CSV"},
      {"a.npy", "NPY"},       {"a.pqr", "PQR"},     {"a.lmp", "LAMMPS data"},  {"a.sdf", "SDF"},
      {"a.MOL.gz", "SDF"},    {"a.mol2", "MOL2"},   {"a.ply", "PLY"},          {"a.pcd", "PCD"},
      {"a.vtk.gz", "VTK"},    {"a.vtp", "VTK XML"}, {"a.vasp", "POSCAR"},      {"b/CONTCAR.gz", "POSCAR"},
      {"XDATCAR", "XDATCAR"},
  };
  for (const auto& [name, format] : cases) EXPECT_EQ(name_of(format_by_name(name)), format) << name;
  for (const char* name : {"a", "pdb", "a.", "a.zip", "a.pdb.zip", ".gz"})
    EXPECT_EQ(format_by_name(name), nullptr) << name;
  EXPECT_EQ(format_by_content("what is this?", "a.pdb"), nullptr);
}

TEST(Elements, KnowTheirSymbolsAndRadii) {
  EXPECT_EQ(atomic_number("H"), 1);
  EXPECT_EQ(atomic_number("D"), 1);
  EXPECT_EQ(atomic_number("cl"), 17);
  EXPECT_EQ(atomic_number("FE"), 26);
  EXPECT_EQ(atomic_number("Og"), 118);
  for (const char* symbol : {"", "X", "Xx", "C1", "Carbon", " C", "C ", "1", "*"})
    EXPECT_EQ(atomic_number(symbol), 0) << symbol;
  EXPECT_FLOAT_EQ(static_cast<float>(van_der_waals_radius(6)), 1.7f);
  EXPECT_EQ(van_der_waals_radius(0), 0.0);
  EXPECT_EQ(van_der_waals_radius(119), 0.0);
  for (int number = 1; number <= 118; ++number) {
    EXPECT_GE(van_der_waals_radius(number), 1.0) << number;
    EXPECT_LE(van_der_waals_radius(number), 3.5) << number;
  }
}

TEST(ReadSpheres, AppliesRadiusThenScale) {
  ReadOptions options;
  options.radius = 2;
  EXPECT_EQ(read_text("1 2 3 0.5\n", "a", options).spheres.radius(0), 2);
  options.radius_scale = 0.25;
  EXPECT_EQ(read_text("1 2 3 0.5\n", "a", options).spheres.radius(0), 0.5);
  EXPECT_EQ(read_text("1\n\nC 1 2 3\n", "a", options).spheres.radius(0), 0.5);
  options.radius.reset();
  EXPECT_EQ(read_text("1 2 3 0.5\n", "a", options).spheres.radius(0), 0.125);
  options.radius = 0;
  EXPECT_EQ(read_text("1 2 3\n", "a", options).spheres.radius(0), 0);
}

TEST(ReadSpheres, SaysWhatItAssumedUnlessToldOtherwise) {
  EXPECT_EQ(read_text("1 2 3\n", "a").warnings,
            (std::vector<std::string>{
                "no radii; each sphere gets radius 0.5, as all centres are at one place; radius sets another"}));
  ReadOptions options;
  options.radius = 0.5;
  EXPECT_TRUE(read_text("1 2 3\n", "a", options).warnings.empty());
  EXPECT_EQ(read_text("1 2 3\n", "a", options).rules.back(), "radii: all 0.5, as asked for");
}

TEST(ReadSpheres, RefusesRadiiThatAreNone) {
  ReadOptions options;
  options.radius = -1;
  EXPECT_EQ(error_of("1 2 3\n", "a", options),
            "a: the radius that replaces all others is negative: -1; give radius a number from 0");
  options.radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of("1 2 3\n", "a", options),
            "a: the radius that replaces all others is not finite: nan; give radius a number from 0");
  options.radius.reset();
  options.radius_scale = -2;
  EXPECT_EQ(error_of("1 2 3\n", "a", options),
            "a: the factor for radii is negative: -2; give radius_scale a number from 0");
  options.radius_scale = 1e30;
  EXPECT_EQ(error_of("1 2 3 1e30\n", "a", options).substr(0, 3), "a: ");
}

TEST(ReadSpheres, RecentersInDouble) {
  // Spheres of radius 0.01 around 1e6: single precision about 0 moves them by up to 0.03.
  const std::string text = "1000000.01 0 0 0.01\n1000000.02 0 0 0.01\n1000000.03 0 0 0.01\n1 0 0 1000\n";
  const std::string far = text.substr(0, text.rfind("1 0 0"));
  const SphereFile as_is = read_text(far, "a");
  EXPECT_TRUE(as_is.warnings.empty());
  EXPECT_EQ(as_is.spheres.origin(), (Vec3d{1000000.015625, 0, 0}));
  EXPECT_EQ(as_is.rules.back(),
            "coordinates: rounded relative to (1000000.015625, 0, 0), where single precision is finer");
  EXPECT_NEAR(as_is.spheres.centre(2).x, 1000000.03, 1e-9);
  EXPECT_EQ(as_is.recentred_by, (Vec3d{}));

  ReadOptions options;
  options.recenter = true;
  const SphereFile recentred = read_text(far, "a", options);
  EXPECT_TRUE(recentred.warnings.empty());
  EXPECT_NEAR(recentred.recentred_by.x, 1000000.02, 1e-9);
  EXPECT_NEAR(recentred.spheres.centre(0).x, -0.01, 1e-9);
  EXPECT_NEAR(recentred.spheres.centre(2).x, 0.01, 1e-9);

  // If the extent itself is too large, nothing helps.
  const SphereFile wide = read_text("-1000000.01 0 0 1e-3\n1000000.02 0 0 1e-3\n5 0 0 1e-3\n", "a", options);
  ASSERT_EQ(wide.warnings.size(), 1u);
  EXPECT_NE(wide.warnings[0].find("moves 2 of 3 centres by more than 1 % of the radius"), std::string::npos);
  EXPECT_NE(wide.warnings[0].find("the radii are too small for the extent"), std::string::npos);
}

TEST(ReadSpheres, KeepsQuietWhereRoundingDoesNoHarm) {
  EXPECT_TRUE(read_text("0.1 0.2 0.3 1\n100.1 0 0 1\n", "a").warnings.empty());
  EXPECT_TRUE(read_text("1000000.01 0 0 0\n0 0 0 1\n", "a").warnings.empty()) << "a point is never hit";
}

TEST(ReadSpheres, WarnsOfVanishingRadii) {
  const SphereFile file = read_text("0 0 0 1e-25\n1 0 0 1\n", "a");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "1 sphere has a radius below 2^-60 of the whole extent and cannot be told from a point");
}

TEST(ReadSpheres, NamesWhatItCannotRead) {
  const std::string known = "; known are " + known_formats();
  EXPECT_EQ(known.find("; known are CIF of crystals, CSV (.csv .tsv .txt .dat), GRO (.gro), GSD (.gsd), HDF5 (.h5 "),
            0u)
      << known;
  EXPECT_NE(known.find(", each also as .gz, .zst, .xz or .bz2"), std::string::npos) << known;
  EXPECT_EQ(error_of("", "a.pdb"), "a.pdb: the file is empty");
  EXPECT_EQ(error_of("what is this?\n", "a"), "a: this is no file of spheres in a known format" + known);
  std::string junk;
  for (int i = 0; i < 5000; ++i) junk += static_cast<char>((i * i * 31 + i * 7) >> 3);
  EXPECT_EQ(error_of(junk, "a"), "a: this is no file of spheres in a known format" + known);
  for (const char* name : {"a.pdb", "a.cif", "a.xyz", "a.dump", "a.csv", "a.npy"})
    EXPECT_EQ(error_of(junk, name).find(std::string(name) + ":"), 0u) << error_of(junk, name);
  EXPECT_EQ(error_of("no array", "a.npy"), "a.npy: this is no NPY file: it does not begin with \\x93NUMPY");
  EXPECT_EQ(error_of(" \n \n", "a.xyz"), "a.xyz: there is no frame 0: the file has none");
}

TEST(ReadSpheres, ReadsFilesAndNamesThoseItCannot) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "bihive_io_read_spheres";
  fs::create_directories(folder);
  const std::string good = (folder / "good.txt").string(), empty = (folder / "empty.txt").string();
  std::ofstream(good) << "1 2 3 4\n";
  std::ofstream(empty).flush();
  const Result<SphereFile> file = read_spheres(good, {});
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_EQ(file->spheres.radius(0), 4);
  EXPECT_EQ(read_spheres(empty, {}).error().to_string(), empty + ": the file is empty");
  for (const std::string& path : {(folder / "missing.pdb").string(), folder.string()}) {
    const Result<SphereFile> none = read_spheres(path, {});
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().file, path);
  }
  fs::remove_all(folder);
}

TEST(ReadSpheres, ReadsTheBundledMolecule) {
  const Result<SphereFile> file = read_spheres(std::string(BIHIVE_SOURCE_DIR) + "/data/1hpv.pdb", {});
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_EQ(file->spheres.size(), 1631);
  EXPECT_TRUE(file->warnings.empty());
}

}  // namespace
}  // namespace bihive
