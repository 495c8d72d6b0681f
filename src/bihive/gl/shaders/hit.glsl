// Twin of geometry/hit.h. `sphere` is a position in leaf order.
#include "ray"
#include "textures"

struct Hit {
  float t;
  int sphere;
};

// Takes the candidate if it is nearer; of equal t the smaller id wins.
void keep_nearer(inout Hit hit, float candidate_t, int candidate) {
  bool nearer = candidate_t < hit.t;
  if (candidate_t == hit.t && hit.sphere != kNothing) nearer = sphere_id(candidate) < sphere_id(hit.sphere);
  if (nearer) hit = Hit(candidate_t, candidate);
}
