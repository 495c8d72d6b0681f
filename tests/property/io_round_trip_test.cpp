// Random spheres, written in each text format with 17 digits, come back bit for bit; random numbers parse as strtod
// does.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/npy.h"
#include "bihive/math/rng.h"

namespace bihive {
namespace {

constexpr std::uint64_t kSeed = 20140501;

Result<RawSpheres> read_as(const char* format, const std::string& bytes) {
  return read_bytes(format_named(format), bytes, "t", 0);
}

std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// Any finite magnitude of single precision, of either sign.
double random_coordinate(SplitMix64& rng) {
  const double magnitude = std::ldexp(1 + rng.next_double(), static_cast<int>(rng.next_below(240)) - 120);
  return rng.next() & 1 ? magnitude : -magnitude;
}

RawSpheres random_spheres(SplitMix64& rng, std::size_t count) {
  RawSpheres spheres;
  for (std::size_t i = 0; i < count; ++i) {
    spheres.x.push_back(random_coordinate(rng));
    spheres.y.push_back(random_coordinate(rng));
    spheres.z.push_back(random_coordinate(rng));
    spheres.r.push_back(std::abs(random_coordinate(rng)));
  }
  return spheres;
}

void expect_same(const RawSpheres& wanted, const Result<RawSpheres>& got, const std::string& what) {
  ASSERT_TRUE(got.ok()) << what << ": " << got.error().to_string();
  EXPECT_EQ(got->x, wanted.x) << what;
  EXPECT_EQ(got->y, wanted.y) << what;
  EXPECT_EQ(got->z, wanted.z) << what;
  EXPECT_EQ(got->r, wanted.r) << what;
}

TEST(RoundTrip, EveryFormatGivesBackTheSameBits) {
  SplitMix64 rng(kSeed);
  for (int round = 0; round < 50; ++round) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", round " + std::to_string(round));
    const std::size_t count = 1 + rng.next_below(40);
    const RawSpheres spheres = random_spheres(rng, count);
    std::string rows, csv = "r,x,y,z\n",
                      cif = "data_T\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n";
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string x = digits(spheres.x[i]), y = digits(spheres.y[i]), z = digits(spheres.z[i]),
                        r = digits(spheres.r[i]);
      rows += x + " " + y + "\t" + z + "  " + r + "\n";
      csv += r + "," + x + ", " + y + ",\"" + z + "\"\n";
      cif += x + " " + y + "\n" + z + "\n";
      numbers.insert(numbers.end(), {spheres.x[i], spheres.y[i], spheres.z[i], spheres.r[i]});
    }
    const std::string n = std::to_string(count);
    expect_same(spheres, read_as("CSV", rows), "plain text");
    expect_same(spheres, read_as("CSV", csv), "CSV");
    expect_same(spheres, read_as("XYZ", n + "\nProperties=pos:R:3:radius:R:1\n" + rows), "XYZ");
    expect_same(spheres,
                read_as("LAMMPS dump",
                        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + n + "\nITEM: ATOMS x y z radius\n" + rows),
                "LAMMPS dump");
    expect_same(spheres, read_as("NPY", npy_bytes(numbers, {static_cast<std::int64_t>(count), 4})), "NPY");
    RawSpheres without_radii = spheres;
    without_radii.r.clear();
    expect_same(without_radii, read_as("mmCIF", cif), "mmCIF");
  }
}

TEST(RoundTrip, NumbersParseAsTheCLibraryDoes) {
  SplitMix64 rng(kSeed);
  for (int i = 0; i < 200000; ++i) {
    // Random bits of a double, at random precision, in one of the usual notations.
    const std::uint64_t bits = rng.next();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    char text[512];
    const int precision = static_cast<int>(rng.next_below(25));
    const bool small = std::abs(value) < 1e30;
    std::snprintf(text, sizeof text,
                  rng.next() & 1 && small ? "%.*f"
                  : rng.next() & 1        ? "%.*e"
                                          : "%+.*g",
                  precision, value);
    const auto parsed = parse_double(text);
    ASSERT_TRUE(parsed.has_value()) << text;
    ASSERT_EQ(*parsed, std::strtod(text, nullptr)) << text << ", seed " << kSeed << ", number " << i;
  }
}

TEST(RoundTrip, ATextCutAnywhereIsReadOrRefusedButNeverWorse) {
  const std::string dump =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0.5\n0 1 0\n0 1 0\n"
      "ITEM: ATOMS id xs ys zs radius\n1 0 0 0 1\n2 0.5 0.5 0.5 1\n";
  const std::string xyz = "2\nProperties=species:S:1:pos:R:3\nC 1 2 3\nbead 4 5 6\n";
  for (std::size_t size = 0; size <= dump.size(); ++size) {
    const Result<RawSpheres> got = read_as("LAMMPS dump", dump.substr(0, size));
    EXPECT_EQ(got.ok(), size + 1 >= dump.size()) << "cut at " << size;
  }
  for (std::size_t size = 0; size <= xyz.size(); ++size) {
    const Result<RawSpheres> got = read_as("XYZ", xyz.substr(0, size));
    EXPECT_EQ(got.ok(), size + 1 >= xyz.size()) << "cut at " << size;
  }
}

}  // namespace
}  // namespace bihive
