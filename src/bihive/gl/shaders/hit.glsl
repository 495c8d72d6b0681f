// Twin of geometry/hit.h. `sphere` is a position in leaf order.
#include "ray"
#include "textures"
#include "transparency"

struct Hit {
  float t;
  int sphere;
};

#ifdef LAYERS
// Is the hit of sphere i at t before the ray's current next one? Of equal t an opaque sphere comes first, then the
// smaller id.
bool is_nearer(Ray ray, float t, int i, Hit hit) {
  if (t > hit.t || t < ray.t_passed) return false;
  if (t == ray.t_passed && int(sphere_id(i)) <= ray.id_passed) return false;
  if (ray.classes_passed != 0u && (ray.classes_passed & class_bit(i)) != 0u) return false;
  if (t < hit.t) return true;
  if (hit.sphere == kNothing) return false;
  bool layer = is_layer(i);
  return layer == is_layer(hit.sphere) ? sphere_id(i) < sphere_id(hit.sphere) : !layer;
}
#else
// Within a leaf, and without a tree, positions have the order of ids: the first of equal hits wins.
bool is_nearer(Ray ray, float t, int i, Hit hit) {
  return t < hit.t;
}
#endif

// Takes the candidate, the best of another leaf, if it is nearer; of equal t the smaller id wins.
void keep_nearer(Ray ray, inout Hit hit, Hit candidate) {
  if (candidate.sphere == kNothing) return;
#ifdef LAYERS
  if (is_nearer(ray, candidate.t, candidate.sphere, hit)) hit = candidate;
#else
  bool nearer = candidate.t < hit.t;
  if (candidate.t == hit.t) nearer = sphere_id(candidate.sphere) < sphere_id(hit.sphere);
  if (nearer) hit = candidate;
#endif
}
