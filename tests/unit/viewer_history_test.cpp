// Undo and redo of what a window shows.
#include <gtest/gtest.h>

#include "bihive/viewer/history.h"

namespace bihive {
namespace {

class HistoryOfAScene : public testing::Test {
 protected:
  HistoryOfAScene() { history.begin(state); }

  void change(double now_ms, bool by_user = true) { history.note(state, by_user, now_ms); }

  History history;
  ShownState state;
};

TEST_F(HistoryOfAScene, goes_back_and_on) {
  EXPECT_EQ(history.next(-1), "");
  EXPECT_EQ(history.go(-1), nullptr);
  state.settings.view = View::normal;
  change(0);
  state.look.colour_by = "b_factor";
  state.settings.camera.fov_deg = 50;
  change(10);
  EXPECT_EQ(history.next(-1), "colours");
  EXPECT_EQ(history.next(1), "");

  const ShownState* before = history.go(-1);
  ASSERT_NE(before, nullptr);
  EXPECT_EQ(before->settings.view, View::normal);
  EXPECT_EQ(before->look.colour_by, "");
  EXPECT_EQ(history.next(-1), "view");
  EXPECT_EQ(history.next(1), "colours");
  ASSERT_NE(history.go(-1), nullptr);
  EXPECT_EQ(history.go(-1), nullptr);
  ASSERT_NE(history.go(1), nullptr);
  const ShownState* after = history.go(1);
  ASSERT_NE(after, nullptr);
  EXPECT_EQ(after->look.colour_by, "b_factor");
  EXPECT_EQ(after->settings.camera.fov_deg, 50);
}

TEST_F(HistoryOfAScene, forgets_what_was_undone_when_something_else_changes) {
  state.look.style = "flat";
  change(0);
  state = *history.go(-1);
  state.look.style = "glossy";
  change(1);
  EXPECT_EQ(history.next(1), "");
  EXPECT_EQ(history.go(-1)->look.style, "");
  EXPECT_EQ(history.go(1)->look.style, "glossy");
}

TEST_F(HistoryOfAScene, a_drag_is_one_change) {
  for (int i = 1; i <= 40; ++i) {
    state.settings.camera.eye.x = i;
    change(100 * i);
  }
  EXPECT_EQ(history.next(-1), "camera");
  state.settings.camera.eye.x = 50;
  change(6000);
  EXPECT_EQ(history.go(-1)->settings.camera.eye.x, 40);
  EXPECT_EQ(history.go(-1)->settings.camera.eye.x, ShownState().settings.camera.eye.x);
}

TEST_F(HistoryOfAScene, what_the_user_has_not_changed_is_not_undone) {
  state.settings.camera.eye.x = 5;
  change(0, /*by_user=*/false);
  EXPECT_EQ(history.next(-1), "");
  state.width_px = 100;
  change(1);
  EXPECT_EQ(history.next(-1), "");
  state.settings.picture = ShownState().settings.picture;
  ASSERT_TRUE(state.reading.take("radius_scale", "2"));
  state.look.background = "black";
  change(2);
  EXPECT_EQ(history.next(-1), "how the file is read");
  EXPECT_EQ(history.go(-1)->settings.camera.eye.x, 5);
}

TEST_F(HistoryOfAScene, says_which_rows_of_the_look_have_changed) {
  state.look.rows = {{"water", "hide", ""}};
  change(0);
  EXPECT_EQ(history.next(-1), "what is hidden");
  state.look.rows.push_back({"", "clip", "plane:0,0,1,5"});
  change(10);
  EXPECT_EQ(history.next(-1), "cut");
  state.look.rows = {};
  change(20);
  EXPECT_EQ(history.next(-1), "looks of selections");
}

TEST_F(HistoryOfAScene, keeps_the_last_two_hundred_states) {
  for (int i = 1; i <= 300; ++i) {
    state.settings.max_prims = i;
    change(2000.0 * i);
  }
  int steps = 0;
  const ShownState* first = nullptr;
  while (const ShownState* before = history.go(-1)) {
    first = before;
    ++steps;
  }
  EXPECT_EQ(steps, 199);
  EXPECT_EQ(first->settings.max_prims, 101);
}

}  // namespace
}  // namespace bihive
