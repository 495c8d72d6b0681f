/* The library for C from several threads that share a tree and a scene: each answer is that of one thread. */
#include <bihive.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kThreads = 4, kRounds = 30, kSpheres = 300, kRays = 500, kPoints = 50, kMost = 3, kSides = 2, kPixels = 24 };

static const char* const kSideNames[kSides] = {"front", "iso"};

typedef struct answers {
  double t[kRays];
  int64_t spheres[kRays];
  uint8_t hidden[kRays];
  double distances[kPoints * kMost];
  int64_t near[kPoints * kMost];
  int64_t hits, within;
} answers;

static bihive_tree* tree;
static bihive_scene* scene;
static float origins[3 * kRays], directions[3 * kRays];
static double points[3 * kPoints];
static answers expected;
static uint8_t pictures[kSides][kPixels * kPixels * 4];

static int ask_tree(answers* found) {
  bihive_rays rays = {kRays, origins, directions, NULL, NULL, NULL, NULL, NULL};
  bihive_lists* lists = NULL;
  memset(found, 0, sizeof *found);
  if (bihive_tree_size(tree) != kSpheres) return 1;
  if (bihive_closest(tree, &rays, 1, found->t, found->spheres) != 0) return 1;
  if (bihive_occluded(tree, &rays, 2, found->hidden) != 0) return 1;
  if (bihive_nearest(tree, points, kPoints, kMost, INFINITY, BIHIVE_SURFACE, NULL, 1, found->distances, found->near) !=
      0)
    return 1;
  if (bihive_all_hits(tree, &rays, 1, &lists) != 0) return 1;
  found->hits = bihive_lists_begin(lists)[kRays];
  bihive_lists_free(lists);
  if (bihive_within(tree, points, kPoints, NULL, BIHIVE_CENTRE, NULL, 1, &lists) != 0) return 1;
  found->within = bihive_lists_begin(lists)[kPoints];
  bihive_lists_free(lists);
  return 0;
}

/* Another thread may turn the scene before it is drawn: the picture is that of one of the sides. */
static int draw(const char* side) {
  static const int kWhole = kPixels * kPixels * 4;
  uint8_t rgba[kPixels * kPixels * 4];
  int i;
  if (bihive_scene_view_from(scene, side) != 0 || bihive_render(scene, kPixels, kPixels, 1, 1, rgba) != 0) return 1;
  for (i = 0; i < kSides; ++i)
    if (memcmp(rgba, pictures[i], (size_t)kWhole) == 0) return 0;
  return 1;
}

static void* work(void* number) {
  const int thread = *(const int*)number;
  answers* found = malloc(sizeof *found);
  static int wrong[kThreads];
  int i;
  for (i = 0; i < kRounds && found != NULL; ++i) {
    wrong[thread] += ask_tree(found) != 0 || memcmp(found, &expected, sizeof expected) != 0;
    wrong[thread] += draw(kSideNames[(thread + i) % kSides]);
    /* Each thread has its own last error. */
    wrong[thread] +=
        bihive_scene_view_from(scene, "nowhere") != 1 || strstr(bihive_error_text(), "expected one of front") == NULL;
    if (thread % 2 == 0) wrong[thread] += bihive_closest(NULL, NULL, 1, NULL, NULL) != 1;
    if (thread % 2 == 0) wrong[thread] += strstr(bihive_error_text(), "NULL") == NULL;
  }
  free(found);
  return &wrong[thread];
}

static double at_random(unsigned* state) {
  *state = *state * 1664525u + 1013904223u;
  return (double)(*state >> 8) / (1 << 24);
}

int main(void) {
  static double xyz[3 * kSpheres], radii[kSpheres];
  static int numbers[kThreads];
  pthread_t threads[kThreads];
  unsigned state = 7;
  int i, wrong = 0;
  for (i = 0; i < 3 * kSpheres; ++i) xyz[i] = 10 * at_random(&state);
  for (i = 0; i < kSpheres; ++i) radii[i] = 0.3;
  for (i = 0; i < 3 * kRays; ++i) origins[i] = 5;
  for (i = 0; i < 3 * kRays; ++i) directions[i] = (float)(at_random(&state) - 0.5);
  for (i = 0; i < 3 * kPoints; ++i) points[i] = 10 * at_random(&state);
  if (bihive_tree_new(xyz, radii, kSpheres, 1, &tree) != 0) wrong += 1;
  if (bihive_scene_new(xyz, radii, NULL, kSpheres, "plain", &scene) != 0) wrong += 1;
  if (wrong == 0) wrong += ask_tree(&expected);
  for (i = 0; i < kSides && wrong == 0; ++i) {
    wrong += bihive_scene_view_from(scene, kSideNames[i]);
    wrong += bihive_render(scene, kPixels, kPixels, 1, 1, pictures[i]);
  }
  if (wrong != 0) {
    fprintf(stderr, "%s\n", bihive_error_text());
    return 1;
  }
  for (i = 0; i < kThreads; ++i) {
    numbers[i] = i;
    if (pthread_create(&threads[i], NULL, work, &numbers[i]) != 0) return 3;
  }
  for (i = 0; i < kThreads; ++i) {
    void* of_thread = NULL;
    if (pthread_join(threads[i], &of_thread) != 0) return 3;
    wrong += *(const int*)of_thread;
  }
  bihive_scene_free(scene);
  bihive_tree_free(tree);
  printf("%d threads, %d wrong answers, %d hits\n", kThreads, wrong, (int)expected.hits);
  return wrong == 0 && expected.hits > 0 ? 0 : 1;
}
