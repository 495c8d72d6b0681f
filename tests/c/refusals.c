/* The library for C: pictures and trees that the memory does not hold are refused before they are made. */
#define _GNU_SOURCE
#include <bihive.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int refuses(const char* what, int code) {
  if (code == 1 && strstr(bihive_error_text(), "BIHIVE_MEMORY allows") != NULL) return 1;
  fprintf(stderr, "%s: code %d, \"%s\"\n", what, code, bihive_error_text());
  return 0;
}

int main(void) {
  enum { kMany = 300000 };
  const double one_place[] = {0, 0, 0}, one_radius[] = {1};
  static uint8_t rgba[4 * 100 * 100];
  double* const xyz = calloc(3 * kMany, sizeof(double));
  double* const radii = malloc(kMany * sizeof(double));
  bihive_scene *scene = NULL, *large_scene = NULL;
  bihive_tree* tree = NULL;
  int good = xyz != NULL && radii != NULL;
  for (int i = 0; good && i < kMany; ++i) {
    xyz[3 * i] = i;
    radii[i] = 0.5;
  }
  /* The tree takes 18 MB while it is made, and 6 MB later. */
  setenv("BIHIVE_MEMORY", "10000000", 1);
  good = good && bihive_scene_new(one_place, one_radius, NULL, 1, "plain", &scene) == 0;
  good = good && bihive_render(scene, 100, 100, 1, 1, rgba) == 0;
  good = good && refuses("a picture", bihive_render(scene, 4000, 4000, 1, 1, rgba));
  good = good && refuses("a tree", bihive_tree_new(xyz, radii, kMany, 1, &tree));
  good = good && refuses("a scene", bihive_scene_new(xyz, radii, NULL, kMany, "plain", &large_scene));
  good = good && tree == NULL && large_scene == NULL;
  /* A set that does not fit even alone. */
  setenv("BIHIVE_MEMORY", "1000000", 1);
  good = good && refuses("a set", bihive_tree_new(xyz, radii, kMany, 1, &tree));
  setenv("BIHIVE_MEMORY", "100000000", 1);
  good = good && bihive_tree_new(xyz, radii, kMany, 1, &tree) == 0;
  bihive_tree_free(tree);
  bihive_scene_free(scene);
  free(radii);
  free(xyz);
  return good ? 0 : 1;
}
