// Does the driver let a pixel's loops run for long (gl/light_slices.h)? Red: as often as they should.
#include "film"

void main() {
  int turns = 0;
  for (int i = 0; i < 100000 + int(zero_bits); ++i) turns += 1 + int(zero_bits);
  film_after = film_texel(vec4(turns == 100000 ? 1.0 : 0.0));
}
