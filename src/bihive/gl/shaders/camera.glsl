// Twin of scene/camera.h's PixelRays.
#include "ray"

uniform vec3 eye;
uniform vec3 forward;
uniform vec3 right;
uniform vec3 down;
uniform vec2 half_size;

// The ray through a picture position in pixels from the top left corner.
Ray camera_ray(vec2 position) {
  vec2 steps = position - half_size;
  return make_ray(eye, normalized(forward + steps.x * right + steps.y * down));
}
