// The frame of a trajectory that is on show, and the time of the next one: time line, play, step, speed and loop of
// window and page. Pure logic: the caller hands in the time of any steady clock, reads the frames and draws them.
#pragma once

#include <cstdint>
#include <optional>

namespace bihive {

constexpr double kSlowestPlay = 0.1, kFastestPlay = 240;  ///< frames a second

class Player {
 public:
  /// Another file with so many frames, at least 1, of which this one is on show. It stands still; speed and loop stay.
  void start_anew(std::int64_t frames, std::int64_t frame = 0);

  std::int64_t frames() const { return frames_; }
  std::int64_t frame() const { return frame_; }  ///< that the user wants to see
  bool is_shown() const { return shown_; }       ///< that frame has come
  bool playing() const { return playing_; }
  bool loops() const { return loops_; }
  double frames_per_second() const { return frames_per_second_; }

  /// Plays from the frame on show, or from the first one if that is the last. A single frame does not play.
  void play(double now_ms);
  void pause() { playing_ = false; }
  /// Stands still at the frame so many further on, backwards below 0. At either end it stops, or with a loop goes on at
  /// the other end.
  void step(std::int64_t by);
  /// The nearest frame that there is. It goes on playing from there if it plays.
  void go_to(std::int64_t frame);
  /// The nearest speed that there is; a number that is not finite changes nothing.
  void set_frames_per_second(double speed);
  void set_loops(bool loops) { loops_ = loops; }

  /// The frame that is wanted has come. While it plays, its time begins.
  void shown(double now_ms);
  /// Call it often: moves on to the next frame once the one on show has been there for its time. True if it did. A
  /// frame that comes late delays the ones behind it: none is left out.
  bool advance(double now_ms);
  /// Until advance() has something to do, in milliseconds; unset: until something else happens.
  std::optional<double> wait_ms(double now_ms) const;
  /// The frame that will be wanted next if nobody interferes, so that it can be read early; unset: none.
  std::optional<std::int64_t> next() const;

 private:
  double period_ms() const { return 1000 / frames_per_second_; }
  void want(std::int64_t frame);

  std::int64_t frames_ = 1, frame_ = 0;
  bool shown_ = true, playing_ = false, loops_ = true;
  double frames_per_second_ = 10;
  double due_ms_ = 0;  // of the next frame, while it plays and the frame is shown; else of this frame
};

}  // namespace bihive
