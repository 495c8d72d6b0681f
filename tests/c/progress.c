/* The library for C: progress functions are called as bihive.h promises, and what they cancel leaves nothing half made.
 */
#include <bihive.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "promises.h"

enum { kSpheres = 3000000, kAtoms = 600000, kSide = 700 };

/* Its address is another one on each thread. */
static _Thread_local int of_this_thread;

struct Heard {
  const int* thread;
  double last, cancel_at; /* a share from which on it cancels */
  int calls, falls, on_other_threads;
};

static int hear(double done, void* context) {
  struct Heard* const heard = context;
  ++heard->calls;
  heard->falls += done < heard->last || done > 1;
  heard->on_other_threads += heard->thread != &of_this_thread;
  heard->last = done;
  return done >= heard->cancel_at;
}

static struct Heard listen(double cancel_at) {
  struct Heard heard = {NULL, 0, 0, 0, 0, 0};
  heard.thread = &of_this_thread;
  heard.cancel_at = cancel_at;
  return heard;
}

static double random_number(void) {
  static uint32_t state = 1;
  state = state * 1664525u + 1013904223u;
  return state / 4294967296.0;
}

static double *xyz, *radii, *moved;

static void test_trees(void) {
  const double point[] = {0.25, 0.5, 0.75};
  double before, after;
  int64_t id_before = -1, id_after = -1;
  bihive_tree* tree = NULL;
  struct Heard heard = listen(2);
  bihive_set_progress(hear, &heard);
  EXPECT(bihive_tree_new(xyz, radii, kSpheres, 1, &tree) == 0);
  EXPECT(heard.calls > 0 && heard.falls == 0 && heard.on_other_threads == 0 && heard.last > 0);
  EXPECT(bihive_nearest(tree, point, 1, 1, INFINITY, BIHIVE_CENTRE, NULL, 1, &before, &id_before) == 0);

  /* A cancelled update leaves the tree as it was; the next one succeeds. */
  heard = listen(0);
  EXPECT(bihive_tree_update(tree, moved, NULL, kSpheres, NULL, 1) == BIHIVE_CANCELLED);
  EXPECT(strcmp(bihive_error_text(), "cancelled") == 0);
  EXPECT(heard.calls == 1 && heard.on_other_threads == 0);
  EXPECT(bihive_nearest(tree, point, 1, 1, INFINITY, BIHIVE_CENTRE, NULL, 1, &after, &id_after) == 0);
  EXPECT(before == after && id_before == id_after);
  heard = listen(0.3);
  EXPECT(bihive_tree_update(tree, moved, NULL, kSpheres, NULL, 2) == BIHIVE_CANCELLED);
  EXPECT(heard.falls == 0);
  heard = listen(2);
  EXPECT(bihive_tree_update(tree, moved, NULL, kSpheres, NULL, 1) == 0);
  EXPECT(bihive_nearest(tree, point, 1, 1, INFINITY, BIHIVE_CENTRE, NULL, 1, &after, &id_after) == 0);
  EXPECT(id_after != id_before || after != before);
  bihive_tree_free(tree);

  /* A cancelled tree is none. Errors are those of this thread. */
  heard = listen(0);
  EXPECT(bihive_tree_new(xyz, radii, kSpheres, 1, &tree) == BIHIVE_CANCELLED && tree == NULL);
  EXPECT(bihive_tree_new(xyz, radii, -1, 1, &tree) == 1);
  EXPECT(strstr(bihive_error_text(), "negative") != NULL);

  /* Nobody is asked any more. */
  heard = listen(0);
  bihive_set_progress(NULL, NULL);
  EXPECT(bihive_tree_new(xyz, radii, kSpheres, 1, &tree) == 0 && heard.calls == 0);
  bihive_tree_free(tree);
}

enum { kFew = 300000, kRays = 600000 };

/* Queries ask the progress function on the thread that made them, and end when it says so. */
static void test_queries(void) {
  float *const origins = malloc(3 * sizeof(float) * kRays), *const directions = malloc(3 * sizeof(float) * kRays);
  double *const t = malloc(8 * sizeof(double) * kRays), *const limits = malloc(sizeof(double) * kRays);
  int64_t *const ids = malloc(8 * sizeof(int64_t) * kRays), *const counts = malloc(sizeof(int64_t) * kRays);
  uint8_t* const hidden = malloc(kRays);
  bihive_lists* lists = NULL;
  bihive_tree* tree = NULL;
  bihive_rays rays = {kRays, origins, directions, NULL, NULL, NULL, NULL, NULL};
  EXPECT(origins != NULL && directions != NULL && t != NULL && limits != NULL && ids != NULL && counts != NULL &&
         hidden != NULL);
  if (failures > 0) return;
  for (int i = 0; i < 3 * kRays; ++i) {
    origins[i] = (float)xyz[i];
    directions[i] = (float)(moved[i + 3] - 0.5);
  }
  for (int i = 0; i < kRays; ++i) limits[i] = 0.02;
  EXPECT(bihive_tree_new(xyz, radii, kFew, 1, &tree) == 0);

  for (int cancel = 1; cancel >= 0; --cancel) {
    for (int query = 0; query < 7; ++query) {
      struct Heard heard = listen(cancel ? 0 : 2);
      int state = -1;
      bihive_set_progress(hear, &heard);
      switch (query) {
        case 0:
          state = bihive_closest(tree, &rays, 1, t, ids);
          break;
        case 1:
          state = bihive_occluded(tree, &rays, 1, hidden);
          break;
        case 2:
          state = bihive_all_hits(tree, &rays, 1, &lists);
          break;
        case 3:
          state = bihive_nearest(tree, xyz, kRays, 8, INFINITY, BIHIVE_CENTRE, NULL, 1, t, ids);
          break;
        case 4:
          state = bihive_within(tree, xyz, kRays, limits, BIHIVE_CENTRE, NULL, 1, &lists);
          break;
        case 5:
          state = bihive_count_within(tree, xyz, kRays, limits, BIHIVE_CENTRE, NULL, 1, counts);
          break;
        default:
          state = bihive_pairs(tree, 0.02, BIHIVE_CENTRE, NULL, 1, &lists);
          break;
      }
      bihive_set_progress(NULL, NULL);
      EXPECT(heard.falls == 0 && heard.on_other_threads == 0);
      /* On a fast machine a query ends before it is asked. */
      EXPECT(state == (cancel && heard.calls > 0 ? BIHIVE_CANCELLED : 0));
      if (cancel) EXPECT(heard.calls <= 1);
      EXPECT(state == 0 || lists == NULL);
      bihive_lists_free(lists);
      lists = NULL;
    }
  }
  EXPECT(strcmp(bihive_error_text(), "cancelled") == 0);
  bihive_tree_free(tree);
  free(origins), free(directions), free(t), free(limits), free(ids), free(counts), free(hidden);
}

static void test_scenes(void) {
  static uint8_t one[4 * kSide * kSide], other[4 * kSide * kSide];
  char* const text = malloc(40 * (size_t)kAtoms + 100);
  size_t size = 0;
  bihive_scene* scene = NULL;
  struct Heard heard = listen(0.1);
  EXPECT(text != NULL);
  if (text == NULL) return;
  size += (size_t)sprintf(text, "%d\n\n", (int)kAtoms);
  for (int i = 0; i < kAtoms; ++i)
    size +=
        (size_t)sprintf(text + size, "C %.3f %.3f %.3f\n", 90 * xyz[3 * i], 90 * xyz[3 * i + 1], 90 * xyz[3 * i + 2]);

  bihive_set_progress(hear, &heard);
  EXPECT(bihive_scene_from_bytes(text, size, "a.xyz", "plain", &scene) == BIHIVE_CANCELLED);
  EXPECT(scene == NULL && heard.falls == 0 && heard.on_other_threads == 0);
  heard = listen(2);
  EXPECT(bihive_scene_from_bytes(text, size, "a.xyz", "plain", &scene) == 0);
  EXPECT(heard.calls > 1 && heard.falls == 0);
  free(text);

  heard = listen(0);
  EXPECT(bihive_render(scene, kSide, kSide, 64, 1, one) == BIHIVE_CANCELLED);
  EXPECT(bihive_scene_methods(scene) == NULL);
  heard = listen(2);
  EXPECT(bihive_render(scene, kSide, kSide, 4, 1, one) == 0);
  EXPECT(heard.falls == 0 && heard.on_other_threads == 0);
  bihive_set_progress(NULL, NULL);
  EXPECT(bihive_render(scene, kSide, kSide, 4, 2, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) == 0);
  bihive_scene_free(scene);
}

int main(void) {
  xyz = malloc(3 * sizeof(double) * kSpheres);
  moved = malloc(3 * sizeof(double) * kSpheres);
  radii = malloc(sizeof(double) * kSpheres);
  if (xyz == NULL || moved == NULL || radii == NULL) return 1;
  for (int i = 0; i < 3 * kSpheres; ++i) {
    xyz[i] = random_number();
    moved[i] = xyz[i] + 0.01 * random_number();
  }
  for (int i = 0; i < kSpheres; ++i) radii[i] = 0.002;
  test_trees();
  test_queries();
  test_scenes();
  printf("progress from C: %d broken promises\n", failures);
  return failures == 0 ? 0 : 1;
}
