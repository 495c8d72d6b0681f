/* bihive for C, and for languages that call C: Fortran, Julia, Rust. Rays and points against spheres, and pictures.
 *
 * The answers have the same bits as those of the C++ library, for any number of threads (docs/precision.md).
 *
 * Contract of every function:
 * - Arrays belong to the caller, who sees to their lengths; nothing refers to them after the return. `xyz` means x, y,
 * z of one point after the other. Ids count from 0; -1 is none.
 * - `threads`: how many threads a call may use, the caller's among them. 0: all that the machine has, where they pay:
 *   a query runs on the caller's thread with fewer than 8,192 rays or with 1,024 points or fewer, and each thread gets
 *   at least 4,096 rays. A number above 0 is what rays are shared among, 64 or more for each; points go to threads
 *   1,024 at a time.
 * - A function that returns int returns 0, 1 after a failure, or 2 (BIHIVE_CANCELLED) if its progress function
 * cancelled it; bihive_error_text() then says what was wrong, where, and what to do. Its outputs are then undefined,
 * but a handle to be made is NULL. Nothing throws, prints or ends the process.
 * - A handle is freed by its own *_free, which takes NULL too, when no thread uses it any more. Until then any number
 * of threads may use one handle at the same time: queries of a tree run beside each other, and pictures of a scene are
 * drawn one after the other.
 */
#ifndef BIHIVE_H
#define BIHIVE_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define BIHIVE_API __attribute__((visibility("default")))
#else
#define BIHIVE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* "major.minor.patch". */
BIHIVE_API const char* bihive_version(void);

/* One line about the last failure on this thread; "" before the first. Valid until the next failure on this thread. */
BIHIVE_API const char* bihive_error_text(void);

/* ---- Progress, and the end of long work ---- */

enum { BIHIVE_CANCELLED = 2 };

/* Gets the finished share, 0 to 1, an estimate that never falls within a call. Returns 0 to go on, another number to
 * cancel. */
typedef int (*bihive_progress)(double done, void* context);

/* From now on the calls of this thread to bihive_tree_new*, bihive_tree_update, bihive_scene_new*,
 * bihive_scene_from_bytes, bihive_render and all queries of rays and points call `progress`, with `context`, some
 * twenty times per second. NULL: none again; each thread has its own.
 * - It is called on the thread that made the call, and never after the return. The first call comes after 50 ms, so
 *   short work calls it never; there is no last one with 1. That thread waits while another one works, but queries
 *   work on it, and call it between two pieces of their work.
 * - It must return, so it must not throw or longjmp, and it must not use the handle that is being made, changed or
 *   drawn.
 * - A cancelled call soon returns BIHIVE_CANCELLED, a query within some 50 ms of work on each thread. A handle to be
 * made is NULL, a tree to be updated is as before, a scene can be drawn again, and the pixels of `rgba` and the answers
 * of a query are undefined or as before. If the work ends first, the call returns 0. */
BIHIVE_API void bihive_set_progress(bihive_progress progress, void* context);

/* ---- Spheres and their tree ---- */

typedef struct bihive_tree bihive_tree;

/* Copies `count` spheres, and builds their tree. Centres and radii are rounded once, to single precision of the set's
 * extent, wherever it is: far from 0 they count from an origin near its middle (docs/precision.md). Failures: a number
 * that is not finite or beyond 3.4e38, a negative radius, not enough memory. */
BIHIVE_API int bihive_tree_new(const double* xyz, const double* radii, int64_t count, int threads, bihive_tree** tree);
/* The same for spheres that repeat along the vectors of a periodic cell: three times x, y, z; a vector of 0, 0, 0: not
 * along it. All queries then see every image of a sphere, at any distance: under the sphere's id, which may occur
 * several times, with the distance to the image. A ray exits the image of `leaves` whose surface is nearest to the
 * ray's origin. Vectors that lie in a plane or on a line, or are all 0, give no images. Failures: also a vector that is
 * not finite, and later a limit that reaches more than a million images, or a ray that passes more than 16384 cells
 * without an end: give it a t_max. */
BIHIVE_API int bihive_tree_new_in_cell(const double* xyz, const double* radii, int64_t count, const double* vectors,
                                       int threads, bihive_tree** tree);
/* Moves all spheres of a tree, and builds it anew. From the first update on the tree keeps working memory for the next.
 * `count` is bihive_tree_size(), and ids stay. `radii` NULL: as before. `vectors` NULL: the cell stays, if there is
 * one; else the new vectors of a tree that was made in a cell. No other thread may use the tree meanwhile. After a
 * failure the tree is as before. */
BIHIVE_API int bihive_tree_update(bihive_tree* tree, const double* xyz, const double* radii, int64_t count,
                                  const double* vectors, int threads);
BIHIVE_API void bihive_tree_free(bihive_tree* tree);
/* "", or a sentence: how many centres the rounding moved by more than 1 % of their radius, because the radii are too
 * small for the extent. Valid as long as the tree. */
BIHIVE_API const char* bihive_tree_warning(const bihive_tree* tree);
BIHIVE_API int64_t bihive_tree_size(const bihive_tree* tree);

/* ---- Rays ---- */

/* The points origin + t direction with t_min <= t <= t_max; t counts in lengths of the direction. A ray that is not
 * valid (a number that is not finite, a direction of length 0, t_min > t_max) hits nothing. */
typedef struct bihive_rays {
  int64_t count;
  const float* origins;    /* xyz; unused if origins64 is there */
  const float* directions; /* xyz */
  const double* t_min;     /* NULL: 0 */
  const double* t_max;     /* NULL: infinity */
  const int64_t* leaves;   /* id of the sphere on whose surface the ray starts, or -1; NULL: none */
  const uint8_t* inside;   /* 1: it goes into that sphere; NULL: 0 */
  const double* origins64; /* xyz in double precision, for spheres far from 0; NULL: origins */
} bihive_rays;

/* The nearest hit: t (infinity: none) and the sphere. Of equal t the smaller id counts. */
BIHIVE_API int bihive_closest(const bihive_tree* tree, const bihive_rays* rays, int threads, double* t,
                              int64_t* spheres);

/* hidden[i] is 1 if ray i hits anything, else 0. */
BIHIVE_API int bihive_occluded(const bihive_tree* tree, const bihive_rays* rays, int threads, uint8_t* hidden);

/* ---- Rays on spheres and sticks ---- */

/* A stick is all balls between two ends, whose centres and radii change evenly from one to the other: a capsule, or a
 * cone with round ends (docs/precision.md). */
typedef struct bihive_bodies bihive_bodies;

enum { BIHIVE_NOTHING = 0, BIHIVE_SPHERE = 1, BIHIVE_STICK = 2 };

/* Copies at least one sphere and `sticks` sticks, and builds their trees. ends: of each stick x, y, z of the first end,
 * then of the second; end_radii: two for each, one of which may be 0. Numbers are rounded as those of
 * bihive_tree_new(). Failures: as there, for sticks too; a stick whose radii are both 0. */
BIHIVE_API int bihive_bodies_new(const double* xyz, const double* radii, int64_t spheres, const double* ends,
                                 const double* end_radii, int64_t sticks, int threads, bihive_bodies** bodies);
BIHIVE_API void bihive_bodies_free(bihive_bodies* bodies);

/* The nearest hit: t (infinity: none), its kind, the number of the sphere or of the stick (-1: none), and along: on a
 * stick the position along its axis, 0 at the first end and 1 at the second, else 0. Of equal t a sphere counts before
 * a stick, then the smaller number. `leaves` of the rays are spheres. */
BIHIVE_API int bihive_bodies_closest(const bihive_bodies* bodies, const bihive_rays* rays, int threads, double* t,
                                     uint8_t* kinds, int64_t* ids, double* along);
/* hidden[i] is 1 if ray i hits anything, else 0. */
BIHIVE_API int bihive_bodies_occluded(const bihive_bodies* bodies, const bihive_rays* rays, int threads,
                                      uint8_t* hidden);

/* Every sphere and stick that ray i hits, by t, then as bihive_bodies_closest() orders equal ones; t is where the ray
 * enters it (where it exits, if it starts inside). bihive_lists_spheres has the numbers of spheres and sticks,
 * bihive_lists_kinds and bihive_lists_along what bihive_bodies_closest() says of each hit. */
typedef struct bihive_lists bihive_lists;
BIHIVE_API int bihive_bodies_all_hits(const bihive_bodies* bodies, const bihive_rays* rays, int threads,
                                      bihive_lists** lists);
BIHIVE_API const uint8_t* bihive_lists_kinds(const bihive_lists* lists); /* NULL: lists of spheres */
BIHIVE_API const double* bihive_lists_along(const bihive_lists* lists);  /* NULL: lists of spheres */

/* ---- Points ---- */

/* The end point of a distance: a sphere's surface (negative inside), or its centre. */
enum { BIHIVE_SURFACE = 0, BIHIVE_CENTRE = 1 };

/* The `most` nearest spheres of each point, none farther than `within` (INFINITY: any), by distance, then id: entries
 * i * most to i * most + most - 1 belong to point i. Missing ones: infinity and -1. `mask` has a byte for each sphere:
 * 0 passes over it; NULL: all. */
BIHIVE_API int bihive_nearest(const bihive_tree* tree, const double* xyz, int64_t count, int64_t most, double within,
                              int distance_to, const uint8_t* mask, int threads, double* distances, int64_t* spheres);

/* The same of the other spheres: `exclude` has for each point one that does not count, such as the point's own, or -1;
 * of its images the nearest. NULL: none. */
BIHIVE_API int bihive_nearest_others(const bihive_tree* tree, const double* xyz, int64_t count, int64_t most,
                                     double within, int distance_to, const uint8_t* mask, const int64_t* exclude,
                                     int threads, double* distances, int64_t* spheres);

/* A list of spheres for each ray or point: those of number i are entries begin[i] to before begin[i + 1]. */
BIHIVE_API const int64_t* bihive_lists_begin(const bihive_lists* lists);
BIHIVE_API const int64_t* bihive_lists_spheres(const bihive_lists* lists);
BIHIVE_API const double* bihive_lists_distances(const bihive_lists* lists); /* of rays: t; of contacts: areas */
BIHIVE_API void bihive_lists_free(bihive_lists* lists);

/* Every sphere at a distance of at most limits[i] from point i, by id. To the surface, a limit of 0 gives the spheres
 * that contain the point (limits NULL: 0 for all), a radius those that overlap the ball around it; to the centre, a
 * radius gives the centres in the ball. */
BIHIVE_API int bihive_within(const bihive_tree* tree, const double* xyz, int64_t count, const double* limits,
                             int distance_to, const uint8_t* mask, int threads, bihive_lists** lists);
/* `exclude`: as of bihive_nearest_others(). */
BIHIVE_API int bihive_within_others(const bihive_tree* tree, const double* xyz, int64_t count, const double* limits,
                                    int distance_to, const uint8_t* mask, const int64_t* exclude, int threads,
                                    bihive_lists** lists);

/* The lengths of these lists alone: counts[i] spheres are that near point i. */
BIHIVE_API int bihive_count_within(const bihive_tree* tree, const double* xyz, int64_t count, const double* limits,
                                   int distance_to, const uint8_t* mask, int threads, int64_t* counts);
BIHIVE_API int bihive_count_others_within(const bihive_tree* tree, const double* xyz, int64_t count,
                                          const double* limits, int distance_to, const uint8_t* mask,
                                          const int64_t* exclude, int threads, int64_t* counts);

/* Every pair of spheres at a distance of at most `reach`, once: the list of sphere i has its partners with larger ids.
 * Between centres, or with BIHIVE_SURFACE between surfaces (0: those that touch or overlap). In a periodic cell a
 * sphere and the images of others are pairs too, and so are a sphere and its own images. */
BIHIVE_API int bihive_pairs(const bihive_tree* tree, double reach, int distance_to, const uint8_t* mask, int threads,
                            bihive_lists** lists);

/* Area and volume of the union of the tree's spheres, each radius grown by `probe`, at least 0 (docs/measures.md):
 * exact decisions, and the same bits for any number of threads. areas[i] is the part of sphere i in the union's
 * boundary, 0 if `mask` leaves it out; they sum to *area. Any of the three may be NULL. Of a tree in a periodic cell,
 * they are those of one cell, in this function and the next ones. */
BIHIVE_API int bihive_measure(const bihive_tree* tree, double probe, const uint8_t* mask, int threads, double* area,
                              double* volume, double* areas);

/* The share of the tree's periodic cell that no sphere fills, and a bound of its rounding error, which may be NULL. It
 * is an error if the tree is in no cell, or in one that repeats along fewer than three vectors. */
BIHIVE_API int bihive_porosity(const bihive_tree* tree, double probe, const uint8_t* mask, int threads,
                               double* porosity, double* error);

/* For each sphere, the volume of its part of the union: all points whose power distance to it is the least. They sum to
 * the volume of bihive_measure. */
BIHIVE_API int bihive_sphere_volumes(const bihive_tree* tree, double probe, const uint8_t* mask, int threads,
                                     double* volumes);

/* How area and volume of the union grow with each sphere's centre (xyz) and radius. Any of the four may be NULL. */
BIHIVE_API int bihive_measure_derivatives(const bihive_tree* tree, double probe, const uint8_t* mask, int threads,
                                          double* area_by_centre, double* area_by_radius, double* volume_by_centre,
                                          double* volume_by_radius);

/* Where two spheres divide the union between them: the list of sphere i has its partners with larger ids, or with its
 * own id where it meets an image of itself, and bihive_lists_distances the areas of their contacts. In a periodic cell
 * a partner occurs once for each of its images. */
BIHIVE_API int bihive_contacts(const bihive_tree* tree, double probe, const uint8_t* mask, int threads,
                               bihive_lists** lists);

/* The areas that groups of spheres bury where they meet. groups[i] is the group of sphere i, from 0 to count - 1, or
 * -1. buried[g * count + h] is the area of group g alone, plus that of h alone, less that of both; on the diagonal
 * stands the area of each group alone. */
BIHIVE_API int bihive_buried_areas(const bihive_tree* tree, double probe, const int32_t* groups, int64_t count,
                                   int threads, double* buried);

/* Of the hits that bihive_closest gave for these rays: positions (xyz) on the spheres, outward normals (xyz) of length
 * 1, and the t where each ray leaves the sphere that it hit; NaN for none. Any of the three may be NULL. It is an error
 * if a hit is not that of its ray. */
BIHIVE_API int bihive_surfaces(const bihive_tree* tree, const bihive_rays* rays, const double* t,
                               const int64_t* spheres, int threads, double* positions, double* normals, double* exits);

/* Every sphere that ray i hits, by t, then id; t is where the ray enters it (where it exits, if it starts inside). */
BIHIVE_API int bihive_all_hits(const bihive_tree* tree, const bihive_rays* rays, int threads, bihive_lists** lists);

/* ---- Structures compared ---- */

/* Builds several structures on the tree's spheres, gives each the same queries, and counts, times and compares their
 * answers (docs/comparison.md). structures, rays: names, separated by commas; NULL: all. count: primary and random
 * rays, and points. threads: of all queries. *json gets the text that `bihive compare --json` prints, to be freed by
 * bihive_text_free(). It calls the progress function, but may take seconds to end after a cancellation. Failures: an
 * unknown name, no sphere, a tree in a cell. */
BIHIVE_API int bihive_compare(const bihive_tree* tree, const char* structures, const char* rays, int64_t count,
                              int threads, char** json);
/* Searches the parameters of one structure (NULL: the wide tree) that answer such queries quickest on this machine, in
 * about ten seconds; *json as `bihive tune --json` prints it. */
BIHIVE_API int bihive_tune(const bihive_tree* tree, const char* structure, const char* rays, int64_t count, int threads,
                           char** json);
BIHIVE_API void bihive_text_free(char* text);

/* ---- Pictures ---- */

typedef struct bihive_scene bihive_scene;

/* A scene of arrays. `rgb`: three bytes per sphere, as on the screen (sRGB); NULL: the style's colour. `style`: one of
 * those that `bihive styles` lists; NULL: "default". At least one sphere. */
BIHIVE_API int bihive_scene_new(const double* xyz, const double* radii, const uint8_t* rgb, int64_t count,
                                const char* style, bihive_scene** scene);

/* A scene of the bytes of a file: a scene file (JSON), or spheres of any format that bihive reads. `name` is the
 * file's, for messages, and determines the format if the bytes do not. `style` as above; a scene file keeps its own
 * appearance.
 */
BIHIVE_API int bihive_scene_from_bytes(const char* bytes, size_t size, const char* name, const char* style,
                                       bihive_scene** scene);
BIHIVE_API void bihive_scene_free(bihive_scene* scene);

/* Puts a camera that shows everything on a side: "front", "back", "left", "right", "top", "bottom" or "iso". Without
 * this call it is the scene file's own, or "front". */
BIHIVE_API int bihive_scene_view_from(bihive_scene* scene, const char* side);

/* Sets any option of `bihive render` by the name that Python gives it, to a value as text: "ao_distance" to "2.5",
 * "shadows" to "false", "eye" to "0,0,50", "turn" to "30,20", "light" to "studio". `value` NULL: the scene's own again.
 * - Options of spheres count in their order, as on the command line: "select" to "chain A", then "colour" to "red", or
 *   "hide" to "true". NULL for one of them takes back all. With any of them each picture copies the scene.
 * - A few are arguments of other functions or have no meaning here: size, threads, style, crop, bits, and those of
 * reading. Failures: an unknown name, a value out of range; the message says what was expected. What contradicts each
 * other, or the spheres, fails in bihive_render(). */
BIHIVE_API int bihive_scene_set(bihive_scene* scene, const char* name, const char* value);

/* Draws the picture of `bihive render`: width * height * 4 bytes to `rgba`, row by row from the top; red, green and
 * blue are not multiplied by the opacity, which is 255 unless the scene has a transparent background. Width and height:
 * 1 to 65535. `samples` per pixel: 1 to 4096, 0: the scene's. */
BIHIVE_API int bihive_render(bihive_scene* scene, int width, int height, int samples, int threads, uint8_t* rgba);

/* A sentence for a methods section about the scene's last picture, and an entry for BibTeX, as `bihive render
 * --methods` prints them: with the SHA-256 of the bytes that the scene was made from. NULL before the first picture. It
 * belongs to the scene, until its next picture or bihive_scene_free(). */
BIHIVE_API const char* bihive_scene_methods(const bihive_scene* scene);

#ifdef __cplusplus
}
#endif

#endif
