#include "bihive/render/memory.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bihive/base/memory.h"
#include "bihive/base/parallel.h"
#include "bihive/base/readable.h"

namespace bihive {

double predict_film_bytes(const RenderSettings& settings, double pixels) {
  const double film = sizeof(Vec3f) + (settings.transparent ? sizeof(float) : 0);
  return pixels * (settings.adaptive_samples ? 2 * film + 1 : film);
}

// Measured with 1 to 8 threads and the built-in styles (`bihive render demo --size 640x480 --threads N`).
double predict_thread_bytes(const RenderSettings& settings) {
  constexpr double kThread = 2e6, kRay = 600, kMostRays = 20000, kPixelsOfTile = 64 * 64;
  const double samples = settings.adaptive_samples ? kMostRays : settings.samples_per_pixel;
  const Tile drawn = drawn_pixels(settings);
  const double pixels = static_cast<double>(drawn.width()) * drawn.height();
  const double rays = std::min(kMostRays, std::min(kPixelsOfTile, pixels) * samples);
  const double tiles = std::ceil(pixels / kPixelsOfTile);
  const int threads = settings.threads > 0 ? settings.threads : hardware_threads();
  return std::min<double>(threads, tiles) * (kThread + kRay * rays);
}

Status check_film_memory(const RenderSettings& settings, double held_bytes) {
  const Tile drawn = drawn_pixels(settings);
  const double pixels = settings.view == View::distance ? static_cast<double>(settings.width_px) * settings.height_px
                                                        : static_cast<double>(drawn.width()) * drawn.height();
  const double film = predict_film_bytes(settings, pixels);
  return check_memory(std::max(0.0, film - held_bytes), "so large a picture", std::min(film, held_bytes));
}

Status check_render_memory(const SphereSet& spheres, Engine engine, const TreeParameters& parameters,
                           const RenderSettings& settings, double band_bytes) {
  if (Status status = check_tree_memory(spheres, engine, parameters); !status) return status;
  return check_memory(predict_tree_bytes(spheres.size(), engine, parameters).built + band_bytes,
                      "the tree of " + grouped(spheres.size()) + " spheres and its picture",
                      static_cast<double>(spheres.allocated_bytes()), predict_thread_bytes(settings));
}

Status check_picture_memory(int width_px, int height_px) {
  const double pixels = static_cast<double>(width_px) * height_px;
  return check_memory(pixels * (sizeof(Vec3f) + 2 * 3), "so large a picture");
}

int rows_of_band(int rows, double bytes_of_row) {
  constexpr int kRowsOfTiles = 64;
  const double fitting = std::min(kBandBytes, memory_bytes() / 4) / bytes_of_row;
  if (fitting >= rows) return rows;
  const int band = std::max(static_cast<int>(fitting), 1);
  return band < kRowsOfTiles ? band : band / kRowsOfTiles * kRowsOfTiles;
}

}  // namespace bihive
