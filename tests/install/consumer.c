/* The smallest C program with the library: the sphere that is nearest to a point. */
#include <bihive.h>
#include <math.h>
#include <stdio.h>

int main(void) {
  const double spheres[] = {0, 0, 0, 5, 0, 0}, radii[] = {1, 2}, point[] = {3, 0, 0};
  double distance;
  int64_t nearest;
  bihive_tree* tree;
  if (bihive_tree_new(spheres, radii, 2, 0, &tree) != 0 ||
      bihive_nearest(tree, point, 1, 1, INFINITY, BIHIVE_SURFACE, NULL, 0, &distance, &nearest) != 0) {
    fprintf(stderr, "%s\n", bihive_error_text());
    return 1;
  }
  printf("bihive %s: sphere %d is nearest\n", bihive_version(), (int)nearest);
  bihive_tree_free(tree);
  return 0;
}
