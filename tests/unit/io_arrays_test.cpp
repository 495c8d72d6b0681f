// HDF5, H5MD and NetCDF: files that h5py and netCDF4 wrote (tests/data/io/make_arrays.py), and damaged ones.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/io/data_path.h"
#include "bihive/io/frames.h"
#include "bihive/io/read_spheres.h"
#include "bihive/io/trajectory.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::number_names;
using test::numbers_of;
using testing::HasSubstr;

std::string in_data(const std::string& name) {
  return std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/" + name;
}

Result<SphereFile> read_at(const std::string& path, std::int64_t frame = 0, const ColumnChoice& columns = {}) {
  ReadOptions options;
  options.frame = frame;
  options.columns = columns;
  return read_spheres(path, options);
}

SphereFile file_at(const std::string& path, std::int64_t frame = 0, const ColumnChoice& columns = {}) {
  Result<SphereFile> file = read_at(path, frame, columns);
  EXPECT_TRUE(file.ok()) << file.error().to_string();
  return file ? std::move(*file) : SphereFile{};
}

std::string fault_at(const std::string& path, std::int64_t frame = 0, const ColumnChoice& columns = {}) {
  const Result<SphereFile> file = read_at(path, frame, columns);
  return file ? "no error" : file.error().to_string();
}

bool has_hdf5() {
  return fault_at(in_data("sets.h5") + ":/run/xyz").find("has no libhdf5") == std::string::npos;
}

TEST(Arrays, PathsWithinFiles) {
  const std::string file = in_data("sets.h5");
  EXPECT_EQ(data_path(file).file, file);
  EXPECT_EQ(data_path(file).inside, "");
  EXPECT_EQ(data_path(file + ":/run/xyz").file, file);
  EXPECT_EQ(data_path(file + ":/run/xyz").inside, "/run/xyz");
  EXPECT_EQ(data_path("/no/such.h5:/x").file, "/no/such.h5:/x");
  EXPECT_THAT(fault_at(in_data("columns.npz") + ":/x"), HasSubstr("names of data sets are for HDF5 files"));
  EXPECT_THAT(fault_at(in_data("lammps.nc") + ":/x"), HasSubstr("names of data sets are for HDF5 files"));
}

TEST(Hdf5, DataSetsByName) {
  if (!has_hdf5()) GTEST_SKIP();
  const std::string path = in_data("sets.h5");
  const SphereFile places = file_at(path + ":/run/xyz");
  EXPECT_EQ(places.format, "HDF5");
  ASSERT_EQ(places.spheres.size(), 3);
  EXPECT_EQ(places.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(file_at(path + ":/run/film").frames, 2);
  EXPECT_EQ(file_at(path + ":/run/film", 1).spheres.centre(0), (Vec3d{1.5, 2, 3}));
  // Packed bytes and bytes in memory have no name to open.
  Result<std::string> bytes = read_file(path);
  ASSERT_TRUE(bytes.ok());
  EXPECT_THAT(read_spheres_from_memory(*bytes, "a.h5", {}).error().to_string(), HasSubstr("/run/xyz (3 x 3)"));

  const ColumnChoice columns{{"x", "px"}, {"y", "py"}, {"z", "pz"}, {"diameter", "size"}};
  const SphereFile table = file_at(path + ":/table", 0, columns);
  EXPECT_EQ(table.spheres.centre(2), (Vec3d{7, 8, 9}));
  EXPECT_EQ(table.spheres.radius(2), 1.5);
  EXPECT_EQ(file_at(path + ":/table/", 0, columns).spheres.size(), 3);
}

TEST(Hdf5, SaysWhatIsWrong) {
  if (!has_hdf5()) GTEST_SKIP();
  const std::string path = in_data("sets.h5");
  EXPECT_THAT(fault_at(path),
              HasSubstr("no data sets in its first group; name one: FILE:/GROUP/NAME; it has /run/film (2 x 3 x 3)"));
  EXPECT_THAT(fault_at(path + ":/none"), HasSubstr("there is no data set and no group of data sets '/none'"));
  EXPECT_THAT(fault_at(path + ":/run/flat"), HasSubstr("has no rows of places"));
  EXPECT_THAT(fault_at(path + ":/table"),
              HasSubstr("no array of the HDF5 file holds the places: it has px py pz size"));
  EXPECT_THAT(fault_at(path + ":/run/film", 2), HasSubstr("there is no frame 2: the file has 2"));
  EXPECT_THAT(fault_at(path + ":/run/xyz", 0, {{"r", "q"}}), HasSubstr("there is no column 'q'"));
  // Files that are cut. The end of a whole one may be of no use to it.
  const std::string whole = *read_file(path);
  for (const std::size_t length : {8UL, 100UL, 1000UL, whole.size() / 2})
    EXPECT_THAT(read_spheres_from_memory(whole.substr(0, length), "a.h5", {}).error().to_string(),
                HasSubstr("a.h5: the HDF5 file is damaged"))
        << length;
}

TEST(H5md, TakesAll) {
  if (!has_hdf5()) GTEST_SKIP();
  const std::string path = in_data("water.h5md") + ":/particles/water";
  const SphereFile file = file_at(path, 1);
  EXPECT_EQ(file.format, "H5MD");
  EXPECT_EQ(file.frames, 2);
  ASSERT_EQ(file.spheres.size(), 3);
  // Nanometres in binary32 become Angstrom.
  EXPECT_NEAR(file.spheres.centre(0).x, 1.5, 1e-6);
  EXPECT_NEAR(file.spheres.centre(0).z, 3, 1e-6);
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{8, 1, 1}));
  EXPECT_EQ(file.step, 10);
  EXPECT_EQ(file.time_ps, 2.5);
  ASSERT_TRUE(file.spheres.cell().has_value());
  EXPECT_EQ(file.spheres.cell()->vectors[2], (Vec3d{0, 0, 50}));
  EXPECT_EQ(file.spheres.cell()->periodic, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(numbers_of(file, "mass"), (std::vector<double>{16, 1, 1}));
  EXPECT_EQ(numbers_of(file, "vy"), (std::vector<double>{1, 2.75, 4}));
  // The first group in the order of names.
  EXPECT_EQ(file_at(in_data("water.h5md")).step, 100);
  EXPECT_EQ(file_at(in_data("water.h5md")).spheres.cell()->periodic, (std::array<bool, 3>{false, true, true}));
  EXPECT_EQ(file_at(in_data("water.h5md") + ":/particles/steps", 1).step, 105);
  EXPECT_THAT(fault_at(path, 2), HasSubstr("there is no frame 2"));
}

TEST(H5md, MovesOtherAtoms) {
  if (!has_hdf5()) GTEST_SKIP();
  const Result<std::shared_ptr<const Trajectory>> trajectory =
      open_trajectory(in_data("water.h5md") + ":/particles/water");
  ASSERT_TRUE(trajectory.ok()) << trajectory.error().to_string();
  EXPECT_EQ((*trajectory)->format(), "H5MD");
  EXPECT_EQ((*trajectory)->frame_count(), 2);
  EXPECT_EQ((*trajectory)->sphere_count(), 3);
  EXPECT_NEAR((*trajectory)->read(1)->y[1], 5.5, 1e-6);
  EXPECT_FALSE((*trajectory)->read(2).ok());
}

TEST(Netcdf, LammpsHasAtoms) {
  const SphereFile file = file_at(in_data("lammps.nc"), 1);
  EXPECT_EQ(file.format, "AMBER NetCDF");
  EXPECT_EQ(file.frames, 2);
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{7, 8, 9.5}));
  EXPECT_EQ(file.spheres.attributes().type, (std::vector<std::int32_t>{1, 2, 2}));
  EXPECT_EQ(number_names(file), (std::vector<std::string>{"c_stress_1", "c_stress_2", "c_stress_3"}));
  EXPECT_EQ(numbers_of(file, "c_stress_2"), (std::vector<double>{20, 55, 80}));
  EXPECT_EQ(file.time_ps, 1.0);  // 500 steps of 2 fs
  EXPECT_EQ(file.spheres.cell()->vectors[2].z, 13);
  EXPECT_EQ(file.spheres.cell()->origin, (Vec3d{-1, 0, 1}));
  EXPECT_EQ(file_at(in_data("lammps.nc"), 0, {{"r", "c_stress_1"}}).spheres.radius(1), 40);
  EXPECT_THAT(fault_at(in_data("lammps.nc"), 2), HasSubstr("there is no frame 2: the file has 2"));
}

TEST(Netcdf, AmberMovesOtherAtoms) {
  EXPECT_THAT(fault_at(in_data("amber.nc")), HasSubstr("read only together with a file of its atoms"));
  const Result<std::shared_ptr<const Trajectory>> opened = open_trajectory(in_data("amber.nc"));
  ASSERT_TRUE(opened.ok()) << opened.error().to_string();
  const Trajectory& trajectory = **opened;
  EXPECT_EQ(trajectory.frame_count(), 2);
  EXPECT_EQ(trajectory.sphere_count(), 3);
  const Result<TrajectoryFrame> frame = trajectory.read(1);
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame->x, (std::vector<double>{1.5, 4, 7}));
  EXPECT_EQ(frame->time_ps, 1.5);
  EXPECT_EQ(frame->cell->vectors[2].z, 13);
  EXPECT_FALSE(trajectory.read(2).ok());
  EXPECT_FALSE(trajectory.read(-1).ok());
}

TEST(Netcdf, ACutTrajectoryHasTheFramesBefore) {
  const std::string path = testing::TempDir() + "bihive_arrays_test_cut.nc";
  const std::string whole = *read_file(in_data("amber.nc"));
  ASSERT_TRUE(write_file(path, whole.substr(0, whole.size() - 8)));
  const Result<std::shared_ptr<const Trajectory>> opened = open_trajectory(path);
  ASSERT_TRUE(opened.ok()) << opened.error().to_string();
  EXPECT_EQ((*opened)->frame_count(), 1);
  EXPECT_EQ((*opened)->warnings(),
            std::vector<std::string>{"the file ends inside frame 1, which is left out: it may be cut"});
  std::remove(path.c_str());
}

TEST(Netcdf, SurvivesDamage) {
  const std::string whole = *read_file(in_data("lammps.nc"));
  ASSERT_TRUE(read_spheres_from_memory(whole, "a.nc", {}).ok());
  const std::string no_convention = [&] {
    std::string text = whole;
    text.replace(text.find("AMBER"), 5, "OTHER");
    return text;
  }();
  EXPECT_THAT(read_spheres_from_memory(no_convention, "a.nc", {}).error().to_string(),
              HasSubstr("no atoms after the convention of AMBER"));
  // A number that is none.
  std::string nan = whole;
  const std::size_t first = nan.find(std::string("\x3f\x80\x00\x00\x40\x00\x00\x00\x40\x40", 10));
  ASSERT_NE(first, std::string::npos);
  nan.replace(first, 4, 4, '\x7f');
  nan[first + 1] = '\xff';
  EXPECT_THAT(read_spheres_from_memory(nan, "a.nc", {}).error().to_string(), HasSubstr("x is "));
  const std::string cut = "the file ends inside frame 1, which is left out: it may be cut";
  // One that was never written has the library's number.
  std::string unwritten = whole;
  unwritten.replace(first, 4, "\x7c\xf0\x00\x00", 4);
  EXPECT_THAT(read_spheres_from_memory(unwritten, "a.nc", {}).error().to_string(),
              HasSubstr("x is not finite: nan; numbers that were never written are none"));
  // A file that is cut within its head is damaged; one that is cut within a frame has the frames before.
  EXPECT_THAT(read_spheres_from_memory(whole.substr(0, 300), "a.nc", {}).error().to_string(),
              HasSubstr("it ends in its head"));
  const Result<SphereFile> shorter = read_spheres_from_memory(whole.substr(0, whole.size() - 8), "a.nc", {});
  ASSERT_TRUE(shorter.ok()) << shorter.error().to_string();
  EXPECT_EQ(shorter->frames, 1);
  EXPECT_THAT(shorter->warnings, testing::Contains(cut));
  // So has one whose writer did not come to state the number of frames.
  std::string unstated = whole;
  for (std::size_t i = 4; i < 8; ++i) unstated[i] = '\xff';
  EXPECT_EQ(read_spheres_from_memory(unstated, "a.nc", {})->frames, 2);
  EXPECT_THAT(read_spheres_from_memory(unstated, "a.nc", {})->warnings, testing::Not(testing::Contains(cut)));
  unstated.resize(unstated.size() - 8);
  EXPECT_THAT(read_spheres_from_memory(unstated, "a.nc", {})->warnings, testing::Contains(cut));
  // Any changed byte gives an answer or an error.
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const char change : {'\xff', '\x01', '\x80'}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ change);
      (void)read_spheres_from_memory(damaged, "a.nc", {});
    }
    (void)read_spheres_from_memory(std::string_view(whole).substr(0, i), "a.nc", {});
  }
}

}  // namespace
}  // namespace bihive
