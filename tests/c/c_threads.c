/* The library for C on several threads: those that it uses itself, and those of a program that share a tree and a
 * scene. Each answer is that of one thread. */
#include <bihive.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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

static double seconds(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The thread sanitizer has a thread of its own, whose processor time would count. */
#if defined(__SANITIZE_THREAD__)
enum { kMeasuresTime = 0 };
#else
enum { kMeasuresTime = 1 };
#endif

/* Processor time of all threads except this one. */
static double of_others(void) {
  return seconds(CLOCK_PROCESS_CPUTIME_ID) - seconds(CLOCK_THREAD_CPUTIME_ID);
}

static int ask(int query, const bihive_rays* rays, int used, double* t, int64_t* spheres, uint8_t* hidden) {
  bihive_lists* lists = NULL;
  int failed;
  if (query == 0) return bihive_closest(tree, rays, used, t, spheres);
  if (query == 1) return bihive_occluded(tree, rays, used, hidden);
  failed = bihive_all_hits(tree, rays, used, &lists);
  bihive_lists_free(lists);
  return failed;
}

/* Each query uses the threads that it is given, and with 0 few rays stay on this one. */
static int uses_threads(void) {
  enum { kFew = 8191, kMany = 100000, kCalls = 20, kMostCalls = 500 };
  static const double kSome = 2e-3;
  float* const from = malloc(3 * kMany * sizeof(float));
  float* const along = malloc(3 * kMany * sizeof(float));
  double* const t = malloc(kMany * sizeof(double));
  int64_t* const spheres = malloc(kMany * sizeof(int64_t));
  uint8_t* const hidden = malloc(kMany);
  bihive_rays rays = {kFew, from, along, NULL, NULL, NULL, NULL, NULL};
  int i, query, wrong = 0;
  if (from == NULL || along == NULL || t == NULL || spheres == NULL || hidden == NULL) return 1;
  for (i = 0; i < 3 * kMany; ++i) from[i] = origins[i % (3 * kRays)];
  for (i = 0; i < 3 * kMany; ++i) along[i] = directions[i % (3 * kRays)];
  for (query = 0; query < 3; ++query) wrong += ask(query, &rays, 0, t, spheres, hidden);
  for (query = 0; query < 3; ++query) {
    const double before = of_others();
    for (i = 0; i < kCalls; ++i) wrong += ask(query, &rays, 0, t, spheres, hidden);
    if (of_others() - before > kSome) {
      fprintf(stderr, "query %d: %d rays are traced on several threads\n", query, (int)rays.count);
      ++wrong;
    }
  }
  rays.count = kMany;
  for (query = 0; query < 3; ++query) {
    const double before = of_others();
    for (i = 0; i < kMostCalls && of_others() - before < kSome; ++i) wrong += ask(query, &rays, 2, t, spheres, hidden);
    if (i == kMostCalls) {
      fprintf(stderr, "query %d: %d rays are traced on one thread of two\n", query, (int)rays.count);
      ++wrong;
    }
  }
  free(from);
  free(along);
  free(t);
  free(spheres);
  free(hidden);
  return wrong;
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
  if (wrong == 0 && kMeasuresTime) wrong += uses_threads();
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
