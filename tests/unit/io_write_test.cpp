#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/io/npy.h"
#include "bihive/io/write_spheres.h"
#include "bihive/math/rng.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::numbers_of;
using test::read_text;
using testing::HasSubstr;

const char* const kPdbText =
    "ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00 20.25           N  \n"
    "ATOM      2  CA  ALA A   1      12.1     6.2    -6.5    0.50 21.25           C  \n"
    "HETATM    3 ZN    ZN B   2      10.125   0.000   3.000  0.50 15.00          ZN  \n";

bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

// Everything that is a number, and the texts.
void expect_the_same(const SphereSet& a, const SphereSet& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::int64_t id = 0; id < a.size(); ++id) {
    const Vec3d p = a.centre(id), q = b.centre(id);
    ASSERT_TRUE(same_bits(p.x, q.x) && same_bits(p.y, q.y) && same_bits(p.z, q.z)) << what << " " << id;
    ASSERT_TRUE(same_bits(a.radius(id), b.radius(id))) << what << " " << id;
  }
  const SphereAttributes &c = a.attributes(), &d = b.attributes();
  EXPECT_EQ(c.element, d.element) << what;
  EXPECT_EQ(c.type, d.type) << what;
  EXPECT_EQ(c.opacity, d.opacity) << what;
  ASSERT_EQ(c.colour.size(), d.colour.size()) << what;
  for (std::size_t i = 0; i < c.colour.size(); ++i) ASSERT_EQ(c.colour[i], d.colour[i]) << what;
  for (const NamedNumbers& numbers : c.numbers) {
    const NamedNumbers* const other = d.find_numbers(numbers.name);
    ASSERT_NE(other, nullptr) << what << " " << numbers.name;
    for (std::size_t i = 0; i < numbers.values.size(); ++i)
      ASSERT_TRUE(same_bits(numbers.values[i], other->values[i])) << what << " " << numbers.name << " " << i;
  }
  for (const NamedTexts& texts : c.texts) {
    const NamedTexts* const other = d.find_texts(texts.name);
    ASSERT_NE(other, nullptr) << what << " " << texts.name;
    for (std::size_t i = 0; i < texts.text_of_sphere.size(); ++i) ASSERT_EQ(texts.of(i), other->of(i)) << what;
  }
}

void expect_comes_back(const SphereSet& spheres, const std::string& what) {
  for (const auto& [format, name] :
       {std::pair{SphereFileFormat::csv, "a.csv"}, std::pair{SphereFileFormat::extended_xyz, "a.extxyz"}}) {
    const WrittenSpheres written = write_spheres(spheres, format);
    expect_the_same(spheres, read_text(written.bytes, name).spheres, what + " " + name);
  }
}

TEST(WriteSpheres, AMoleculeComesBack) {
  expect_comes_back(read_text(kPdbText, "a.pdb").spheres, "pdb");
}

// Far from 0 a reader counts from an origin, and a decimal that merely rounds to the same binary32 is another place.
TEST(WriteSpheres, EveryDigitOfFarPlacesIsKept) {
  const std::vector<double> x{77777776, 77777780.25}, y{14548, 14549}, z{-43439352, -43439351}, r{1.5, 0.25};
  const std::vector<float> xf{77777776, 77777784}, yf{14548, 14549}, zf{-43439352, -43439348}, rf{1.5F, 0.25F};
  const SphereSet sets[] = {SphereSet::from_world(NumbersView::of(x), NumbersView::of(y), NumbersView::of(z),
                                                  NumbersView::of(r), SphereSet::Origin::fitting)
                                .value(),
                            SphereSet::from_world(xf, yf, zf, rf).value()};
  EXPECT_TRUE(sets[0].has_origin());
  EXPECT_FALSE(sets[1].has_origin());
  for (const SphereSet& spheres : sets)
    for (const auto& [format, name] : {std::pair{SphereFileFormat::csv, "a.csv"},
                                       {SphereFileFormat::extended_xyz, "a.xyz"},
                                       {SphereFileFormat::ply, "a.ply"}}) {
      const SphereFile again = read_text(write_spheres(spheres, format).bytes, name);
      for (std::int64_t id = 0; id < 2; ++id) EXPECT_EQ(again.spheres.centre(id), spheres.centre(id)) << name;
    }
}

TEST(WriteSpheres, DecimalsAreShort) {
  EXPECT_EQ(write_spheres(read_text(kPdbText, "a.pdb").spheres, SphereFileFormat::csv).bytes,
            "element,x,y,z,radius,occupancy,b_factor,resid,serial,record,chain,resname,name\n"
            "N,11.104,6.134,-6.504,1.55,1,20.25,1,1,ATOM,A,ALA,N\n"
            "C,12.1,6.2,-6.5,1.7,0.5,21.25,1,2,ATOM,A,ALA,CA\n"
            "Zn,10.125,0,3,1.39,0.5,15,2,3,HETATM,B,ZN,ZN\n");
}

TEST(WriteSpheres, EachFormatHasItsLayout) {
  const SphereSet spheres = read_text(kPdbText, "a.pdb").spheres;
  EXPECT_EQ(write_spheres(spheres, SphereFileFormat::xyz).bytes,
            "3\n\nN 11.104 6.134 -6.504\nC 12.1 6.2 -6.5\nZn 10.125 0 3\n");
  EXPECT_THAT(write_spheres(spheres, SphereFileFormat::extended_xyz).bytes,
              HasSubstr("3\nProperties=species:S:1:pos:R:3:radius:R:1:occupancy:R:1:b_factor:R:1:resid:R:1:serial:R:1:"
                        "record:S:1:chain:S:"
                        "1:resname:S:1:name:S:1\nN 11.104 6.134 -6.504 1.55 1 20.25 1 1 ATOM A ALA N\n"));
  EXPECT_THAT(
      write_spheres(spheres, SphereFileFormat::ply).bytes,
      HasSubstr("element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float radius\n"
                "property uchar atomic_number\nproperty double occupancy\nproperty double b_factor\nproperty double "
                "resid\nproperty double serial\nend_header\n11.104 6.134 -6.504 1.55 7 1 20.25 1 1\n"));
  const Result<NpyArray> array = parse_npy(write_spheres(spheres, SphereFileFormat::npy).bytes, "a.npy");
  ASSERT_TRUE(array.ok());
  EXPECT_EQ(array->dtype, "<f4");
  EXPECT_EQ(array->shape, (std::vector<std::int64_t>{3, 4}));
  EXPECT_EQ(array->values[4], double(12.1F));
}

TEST(WriteSpheres, SaysWhatAFormatCannotHold) {
  const SphereSet spheres = read_text(kPdbText, "a.pdb").spheres;
  EXPECT_THAT(write_spheres(spheres, SphereFileFormat::xyz).left_out[0], HasSubstr("radius, occupancy"));
  EXPECT_THAT(write_spheres(spheres, SphereFileFormat::npy).left_out[0], HasSubstr("one array"));
  EXPECT_EQ(write_spheres(spheres, SphereFileFormat::ply).left_out.size(), 4u) << "four texts";
  EXPECT_TRUE(write_spheres(spheres, SphereFileFormat::csv).left_out.empty());
}

TEST(WriteSpheres, ColoursOpacitiesTypesAndGapsComeBack) {
  expect_comes_back(
      read_text(
          "x,y,z,r,type,red,green,blue,opacity,q,t\n1,2,3,0.1,7,0.1,0.2,0.3,0.4,,a\n4,5,6,0.2,-7,1,0,0.5,1,nan,b\n"
          "1,1,1,0,7,0,0,0,0,1e-300,\"a,\"\"b\"\"\"\n",
          "a.csv")
          .spheres,
      "csv");
}

TEST(WriteSpheres, LabelsOfTypesComeBack) {
  expect_comes_back(read_text("x,y,z,r,type\n1,2,3,1,sand\n4,5,6,1,clay\n7,8,9,1,sand\n", "a.csv").spheres, "labels");
}

TEST(WriteSpheres, UnknownElementsMakeNoTypes) {
  const SphereSet spheres = read_text("x,y,z,r,atomic_number\n1,2,3,1,6\n4,5,6,1,0\n", "a.csv").spheres;
  expect_comes_back(spheres, "unknown");
}

TEST(WriteSpheres, HardNamesAndTextsBreakNoFile) {
  SphereSet spheres = read_text("1 2 3 1\n4 5 6 1\n7 8 9 2\n", "a").spheres;
  SphereAttributes& attributes = spheres.attributes();
  for (const char* name : {"x", "r", "inf", "", "a b", "Q", "q", "a\"b", "a,b", "pos", "species", "1;5"})
    attributes.numbers.push_back({name, {1.5, std::numeric_limits<double>::infinity(), -0.0}});
  const auto add = [&](const char* name, const char* one, const char* two, const char* three) {
    TextCollector texts;
    for (const char* text : {one, two, three}) texts.add(text);
    attributes.texts.push_back(texts.take(name));
  };
  add("mixed", "1", "A", "");
  add("numbers", "", "1", "2");
  add("hard", "a b", "", "c\"d,e");
  add("empty", "", "", "");
  for (const auto& [format, name] :
       {std::pair{SphereFileFormat::csv, "a.csv"}, std::pair{SphereFileFormat::extended_xyz, "a.extxyz"}}) {
    const WrittenSpheres written = write_spheres(spheres, format);
    const SphereFile file = read_text(written.bytes, name);
    ASSERT_EQ(file.spheres.size(), 3) << written.bytes;
    EXPECT_EQ(file.spheres.attributes().numbers.size(), 12u + (format == SphereFileFormat::csv ? 1 : 0))
        << written.bytes;
    for (std::size_t i = 0; i < 12; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_TRUE(same_bits(file.spheres.attributes().numbers[i].values[k], attributes.numbers[i].values[k])) << i;
  }
  EXPECT_THAT(write_spheres(spheres, SphereFileFormat::csv).left_out,
              testing::ElementsAre("the texts 'mixed': the first one looks like a number",
                                   "the texts 'numbers' are numbers to who reads the file"));
}

TEST(WriteSpheres, NumbersOfAnySizeComeBack) {
  for (const double unit : {1e-40, 1e-20, 1.0, 1e20, 1e36}) {
    SplitMix64 rng(7);
    std::vector<double> x, y, z, r;
    for (int i = 0; i < 500; ++i) {
      for (auto* axis : {&x, &y, &z}) axis->push_back(unit * (2 * rng.next_double() - 1));
      r.push_back(unit * rng.next_double() * 1e-3);
    }
    x[0] = -0.0;
    const Result<SphereSet> set = SphereSet::from_world(x, y, z, r);
    ASSERT_TRUE(set.ok());
    expect_comes_back(*set, std::to_string(unit));
    const std::string npy = write_spheres(*set, SphereFileFormat::npy).bytes;
    expect_the_same(*set, read_text(npy, "a.npy").spheres, "npy");
  }
}

// ---- Molecules ----

SphereSet molecule(const std::vector<Vec3d>& places, const std::vector<std::uint8_t>& element) {
  std::vector<double> x, y, z;
  for (const Vec3d& at : places) {
    x.push_back(at.x);
    y.push_back(at.y);
    z.push_back(at.z);
  }
  SphereSet spheres = SphereSet::from_world(x, y, z, std::vector<double>(x.size(), 1.5)).value();
  spheres.attributes().element = element;
  return spheres;
}

TEST(WriteMolecules, BondsOrdersAndPlacesComeBack) {
  SphereSet spheres = molecule({{0.1, -1.25, 3}, {1.4321, 0, 1e-7}, {-99.9999, 5, 6}, {1, 2, 3}}, {6, 8, 7, 0});
  StatedBonds& bonds = spheres.attributes().bonds;
  bonds.list = {{0, 1, BondOrder::double_bond},
                {0, 2, BondOrder::aromatic},
                {1, 3, BondOrder::triple},
                {2, 3, BondOrder::single}};
  bonds.are_all = true;
  spheres.attributes().numbers.push_back({"charge", {-1, 0, 2, 0}});
  for (const bool in_columns : {false, true}) {
    if (in_columns) {
      SphereSet even = molecule({{0.1, -1.25, 3}, {1.4321, 0, 0}, {-99.9999, 5, 6}, {1, 2, 3}}, {6, 8, 7, 0});
      even.attributes() = spheres.attributes();
      spheres = even;
    }
    for (const auto& [format, name] : {std::pair{SphereFileFormat::sdf, "a.sdf"}, {SphereFileFormat::mol2, "a.mol2"}}) {
      const WrittenSpheres written = write_spheres(spheres, format, "a title");
      if (format == SphereFileFormat::sdf) {
        EXPECT_THAT(written.bytes, HasSubstr(in_columns ? "V2000" : "V3000"));
      }
      const SphereFile again = read_text(written.bytes, name);
      EXPECT_EQ(again.title, "a title");
      EXPECT_EQ(again.spheres.attributes().bonds.list, bonds.list) << name;
      EXPECT_TRUE(again.spheres.attributes().bonds.are_all);
      EXPECT_EQ(again.spheres.attributes().element, spheres.attributes().element) << name;
      ASSERT_NE(again.spheres.attributes().find_numbers("charge"), nullptr);
      EXPECT_EQ(again.spheres.attributes().find_numbers("charge")->values, (std::vector<double>{-1, 0, 2, 0}));
      for (std::int64_t id = 0; id < spheres.size(); ++id)
        EXPECT_TRUE(same_bits(again.spheres.centre(id).x, spheres.centre(id).x) &&
                    same_bits(again.spheres.centre(id).y, spheres.centre(id).y) &&
                    same_bits(again.spheres.centre(id).z, spheres.centre(id).z))
            << name << " " << id;
    }
  }
  bonds.list[3].order = BondOrder::unknown;
  EXPECT_THAT(write_spheres(spheres, SphereFileFormat::sdf).left_out.back(), HasSubstr("became single"));
  EXPECT_THAT(write_spheres(spheres, SphereFileFormat::mol2).bytes, HasSubstr("4 3 4 un"));
}

TEST(WriteMolecules, ManyAtomsAndHostileTexts) {
  std::vector<Vec3d> places;
  for (int i = 0; i < 1000; ++i) places.push_back({double(i), 0, 0});
  const SphereSet many = molecule(places, std::vector<std::uint8_t>(1000, 18));
  const std::string sdf = write_spheres(many, SphereFileFormat::sdf, "$$$$").bytes;
  EXPECT_THAT(sdf, HasSubstr("M  V30 COUNTS 1000 0"));
  EXPECT_EQ(read_text(sdf, "a.sdf").spheres.size(), 1000);
  SphereSet named = molecule({{0, 0, 0}, {1, 0, 0}}, {6, 6});
  TextCollector names;
  names.add("a b\n@<TRIPOS>BOND");
  names.add("");
  named.attributes().texts.push_back(names.take("name"));
  const SphereFile again = read_text(write_spheres(named, SphereFileFormat::mol2, "@<TRIPOS>ATOM").bytes, "a.mol2");
  EXPECT_EQ(again.spheres.size(), 2);
  EXPECT_EQ(again.spheres.attributes().find_texts("name")->of(0), "a_b_@<TRIPOS>BOND");
  EXPECT_EQ(again.spheres.attributes().find_texts("name")->of(1), "C");
}

}  // namespace
}  // namespace bihive
