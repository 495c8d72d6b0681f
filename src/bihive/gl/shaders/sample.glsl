// The ray of a pixel's sample. Twin of scene/lens_pattern.h's samples: one pass draws the same sample of all pixels.
#include "camera"

uniform vec2 film_corner;  // the first pixel of the film, in the whole picture
uniform vec2 sample_place;

Ray sample_ray() {
  return camera_ray(floor(gl_FragCoord.xy) + film_corner + sample_place);
}
