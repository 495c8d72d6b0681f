// Stereo pictures: the views of both eyes, and how they are joined.
#include "bihive/render/stereo.h"

#include <gtest/gtest.h>

#include "bihive/scene/load_scene.h"

namespace bihive {
namespace {

struct StereoPicture {
  LoadedScene loaded = *load_scene("x,y,z,r\n0,0,0,1\n0,2,4,1\n", "a.csv");
  RenderSettings settings;
  std::optional<Tracer> tracer;

  StereoPicture(StereoForm form, int width_px) {
    settings.width_px = width_px;
    settings.height_px = 40;
    settings.stereo.form = form;
    loaded.scene.camera = {{0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 30};
    tracer.emplace(*Tracer::build(loaded.scene, Engine::wide, {}, 1));
  }
  Film film() const { return render(loaded.scene, *tracer, settings)->film; }
};

TEST(Stereo, a_view_has_half_the_width_where_both_lie_next_to_each_other) {
  const RenderSettings side = one_view(StereoPicture(StereoForm::side, 80).settings);
  EXPECT_EQ(side.width_px, 40);
  EXPECT_EQ(side.stereo.form, StereoForm::none);
  EXPECT_EQ(one_view(StereoPicture(StereoForm::anaglyph, 80).settings).width_px, 80);
}

TEST(Stereo, one_band_holds_the_whole_picture) {
  const StereoPicture picture(StereoForm::side, 80);
  const Film whole = picture.film();
  EXPECT_EQ(whole.width, 80);
  int bands = 0;
  const auto rendered = render_in_bands(picture.loaded.scene, *picture.tracer, picture.settings, 7,
                                        [&](const Film& film, const Tile& pixels) -> Status {
                                          ++bands;
                                          EXPECT_EQ(pixels.height(), 40);
                                          EXPECT_EQ(film.radiance, whole.radiance);
                                          return Done{};
                                        });
  EXPECT_TRUE(rendered.ok());
  EXPECT_EQ(bands, 1);
}

TEST(Stereo, crossed_eyes_and_glasses_see_the_same_views) {
  const Film side = StereoPicture(StereoForm::side, 80).film();
  const Film cross = StereoPicture(StereoForm::cross, 80).film();
  const Film glasses = StereoPicture(StereoForm::anaglyph, 40).film();
  const auto grey = [](Vec3f light) { return 0.2126F * light.x + 0.7152F * light.y + 0.0722F * light.z; };
  int different = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      EXPECT_EQ(side.at(x, y), cross.at(x + 40, y));
      EXPECT_EQ(side.at(x + 40, y), cross.at(x, y));
      EXPECT_EQ(glasses.at(x, y).x, grey(side.at(x, y)));
      EXPECT_EQ(glasses.at(x, y).z, grey(side.at(x + 40, y)));
      different += side.at(x, y) == side.at(x + 40, y) ? 0 : 1;
    }
  EXPECT_GT(different, 20);
}

}  // namespace
}  // namespace bihive
