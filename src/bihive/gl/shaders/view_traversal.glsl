// View::traversal. Twin of traversal_colour() in render/views.h. Needs TREE and COUNTING.
#include "film"
#include "tracer"

void main() {
  closest_hit(sample_ray());
  add_to_film(vec4(0.0, min(1.0, 0.2 * float(empty_gaps)), min(1.0, 0.2 * float(node_visits)), 0.0));
}
