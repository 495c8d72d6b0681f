// Twin of geometry/hit.h. `sphere` is a position in leaf order.
#include "ray"
#include "textures"

struct Hit {
  float t;
  int sphere;
};

// Takes the candidate if it is nearer; of equal t the smaller id wins. Within a leaf positions have the order of ids,
// so the first of equal ones has won already; here the best of different leaves are compared.
void keep_nearer(inout Hit hit, Hit candidate) {
  bool nearer = candidate.t < hit.t;
  if (candidate.t == hit.t && candidate.sphere != kNothing) nearer = sphere_id(candidate.sphere) < sphere_id(hit.sphere);
  if (nearer) hit = candidate;
}
