// The shown frame of a trajectory, and the time of the next one: time line, play, step, speed and loop of window and
// page. Pure logic: the caller hands in the time of any steady clock, reads the frames and draws them.
#pragma once

#include <cstdint>
#include <optional>

namespace bihive {

constexpr double kSlowestPlay = 0.1, kFastestPlay = 240;  ///< frames per second

class Player {
 public:
  /// Opens another file with `frames` frames, at least 1, of which `frame` is shown. Playing stops; speed and loop
  /// stay.
  void start_anew(std::int64_t frames, std::int64_t frame = 0);

  std::int64_t frames() const { return frames_; }
  std::int64_t frame() const { return frame_; }  ///< requested by the user
  bool is_shown() const { return shown_; }       ///< that frame is shown
  bool playing() const { return playing_; }
  bool loops() const { return loops_; }
  double frames_per_second() const { return frames_per_second_; }

  /// Plays from the shown frame, or from the first one if that is the last. A single frame does not play.
  void play(double now_ms);
  void pause() { playing_ = false; }
  /// Stops, and moves by this number of frames, backwards below 0. It stops at either end, or with a loop continues at
  /// the other end.
  void step(std::int64_t by);
  /// Goes to the nearest existing frame, and continues to play from there if it plays.
  void go_to(std::int64_t frame);
  /// Sets the nearest allowed speed; a number that is not finite changes nothing.
  void set_frames_per_second(double speed);
  void set_loops(bool loops) { loops_ = loops; }

  /// Reports that the requested frame is shown. While it plays, its time begins.
  void shown(double now_ms);
  /// Call it often: advances to the next frame once the shown one has had its time. True if it did. A late frame delays
  /// the following ones: none is skipped.
  bool advance(double now_ms);
  /// Milliseconds until advance() has something to do; unset: until something else happens.
  std::optional<double> wait_ms(double now_ms) const;
  /// The expected next frame, so that it can be read early; unset: none.
  std::optional<std::int64_t> next() const;

 private:
  double period_ms() const { return 1000 / frames_per_second_; }
  void want(std::int64_t frame);

  std::int64_t frames_ = 1, frame_ = 0;
  bool shown_ = true, playing_ = false, loops_ = true;
  double frames_per_second_ = 10;
  double due_ms_ = 0;  // when the next frame is due while playing and shown; else this frame
};

}  // namespace bihive
