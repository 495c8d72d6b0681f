// Rotations about an axis, computed with square roots and products alone, so that they have the same bits on every
// platform.
#pragma once

#include <cmath>

namespace bihive {

/// The cosine and the sine of an angle.
struct Rotation {
  double cosine = 1, sine = 0;
};

/// The turn by both angles.
inline Rotation after(Rotation a, Rotation b) {
  return {a.cosine * b.cosine - a.sine * b.sine, a.cosine * b.sine + a.sine * b.cosine};
}

/// The turn by a fraction of a whole turn, 0 to below 1; its error is below 2^-32 of a turn.
inline Rotation turn_by(double fraction) {
  // Each binary digit is half the angle of the one before.
  Rotation turn;
  Rotation digit{-1, 0};  // half a turn
  for (int i = 0; i < 32 && fraction > 0; ++i) {
    fraction *= 2;
    if (fraction >= 1) {
      turn = after(turn, digit);
      fraction -= 1;
    }
    digit = {std::sqrt(0.5 * (1 + digit.cosine)), std::sqrt(0.5 * (1 - digit.cosine))};
  }
  return turn;
}

}  // namespace bihive
