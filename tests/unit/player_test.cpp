// Play, step, speed and loop of a trajectory, with a clock of the test's own.
#include "bihive/viewer/player.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace bihive {
namespace {

// Every frame comes `delay_ms` after it is wanted. Returns when each one came, until it stands still or the time is
// over.
struct Shown {
  double at_ms;
  std::int64_t frame;
};
std::vector<Shown> played(Player& player, double delay_ms, double until_ms) {
  std::vector<Shown> all;
  double comes_ms = -1;
  for (double now = 0; now <= until_ms && (player.playing() || !player.is_shown()); now += 1) {
    if (!player.is_shown() && comes_ms < 0) comes_ms = now + delay_ms;
    if (comes_ms >= 0 && now >= comes_ms) {
      player.shown(now);
      comes_ms = -1;
      all.push_back({now, player.frame()});
    }
    if (player.advance(now)) comes_ms = now + delay_ms;
  }
  return all;
}

TEST(Player, plays_each_frame_at_its_time_and_stops_at_the_end) {
  Player player;
  player.start_anew(4);
  player.set_loops(false);
  player.set_frames_per_second(10);
  EXPECT_FALSE(player.playing());
  EXPECT_FALSE(player.next().has_value());
  EXPECT_FALSE(player.wait_ms(0).has_value());
  player.play(0);
  EXPECT_EQ(player.next(), 1);
  EXPECT_EQ(player.wait_ms(30), 70);
  const std::vector<Shown> all = played(player, 20, 10000);
  ASSERT_EQ(all.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(all[i].frame, static_cast<std::int64_t>(i) + 1);
    EXPECT_NEAR(all[i].at_ms, 100 * (double(i) + 1) + 20, 2) << "the delay of reading does not add up";
  }
  EXPECT_FALSE(player.playing());
  EXPECT_EQ(player.frame(), 3);

  // Again from the start.
  player.play(0);
  EXPECT_TRUE(player.playing());
  EXPECT_EQ(player.frame(), 0);
  EXPECT_FALSE(player.is_shown());
}

TEST(Player, leaves_no_frame_out_where_frames_come_late) {
  Player player;
  player.start_anew(5);
  player.set_loops(false);
  player.set_frames_per_second(100);
  player.play(0);
  const std::vector<Shown> all = played(player, 50, 10000);
  ASSERT_EQ(all.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(all[i].frame, static_cast<std::int64_t>(i) + 1);
  EXPECT_NEAR(all[3].at_ms - all[2].at_ms, 50, 2);
  EXPECT_FALSE(player.playing());
}

TEST(Player, loops) {
  Player player;
  player.start_anew(3, 2);
  player.set_frames_per_second(10);
  player.play(0);
  EXPECT_EQ(player.next(), 0);
  const std::vector<Shown> all = played(player, 0, 700);
  ASSERT_GE(all.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(all[i].frame, static_cast<std::int64_t>(i % 3));
  EXPECT_TRUE(player.playing());
  player.pause();
  EXPECT_FALSE(player.advance(1e6));
}

TEST(Player, steps_stand_still_and_end_at_the_ends) {
  Player player;
  player.start_anew(3);
  player.play(0);
  player.step(1);
  EXPECT_FALSE(player.playing());
  EXPECT_EQ(player.frame(), 1);
  EXPECT_FALSE(player.is_shown());
  player.shown(5);
  player.step(-2);
  EXPECT_EQ(player.frame(), 2) << "with a loop it goes on at the other end";
  player.step(4);
  EXPECT_EQ(player.frame(), 2) << "at most once around";
  player.set_loops(false);
  player.step(1);
  EXPECT_EQ(player.frame(), 2);
  player.step(INT64_MIN);
  EXPECT_EQ(player.frame(), 0);
  player.step(INT64_MAX);
  EXPECT_EQ(player.frame(), 2);
}

TEST(Player, a_jump_goes_on_playing) {
  Player player;
  player.start_anew(100);
  player.set_frames_per_second(10);
  player.play(0);
  player.go_to(50);
  EXPECT_TRUE(player.playing());
  player.shown(30);
  EXPECT_FALSE(player.advance(31));
  EXPECT_TRUE(player.advance(250));
  EXPECT_EQ(player.frame(), 51);
  player.go_to(-7);
  EXPECT_EQ(player.frame(), 0);
  player.go_to(1000);
  EXPECT_EQ(player.frame(), 99);
}

TEST(Player, another_speed_counts_at_once) {
  Player player;
  player.start_anew(10);
  player.set_frames_per_second(1);
  player.play(0);
  EXPECT_FALSE(player.advance(100));
  player.set_frames_per_second(10);
  EXPECT_TRUE(player.advance(101));
  player.set_frames_per_second(0);
  EXPECT_EQ(player.frames_per_second(), kSlowestPlay);
  player.set_frames_per_second(1e9);
  EXPECT_EQ(player.frames_per_second(), kFastestPlay);
  player.set_frames_per_second(std::nan(""));
  EXPECT_EQ(player.frames_per_second(), kFastestPlay);
}

TEST(Player, a_single_frame_does_not_play) {
  Player player;
  player.start_anew(1);
  player.play(0);
  EXPECT_FALSE(player.playing());
  player.step(1);
  EXPECT_EQ(player.frame(), 0);
  EXPECT_TRUE(player.is_shown());
}

TEST(Player, another_file_stands_still_with_the_speed_of_the_one_before) {
  Player player;
  player.start_anew(3);
  player.set_frames_per_second(25);
  player.set_loops(false);
  player.play(0);
  player.go_to(2);
  player.start_anew(7, 4);
  EXPECT_EQ(player.frames(), 7);
  EXPECT_EQ(player.frame(), 4);
  EXPECT_TRUE(player.is_shown());
  EXPECT_FALSE(player.playing());
  EXPECT_EQ(player.frames_per_second(), 25);
  EXPECT_FALSE(player.loops());
}

}  // namespace
}  // namespace bihive
