// The file of `bihive render`, which grows by rows: PNG, TIFF, or OpenEXR with layers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/image/film.h"
#include "bihive/image/png_pixels.h"
#include "bihive/job/picture_request.h"
#include "bihive/render/layers.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive::cli {

struct RenderOptions;

/// Fails with kBadUsage if the output's name promises a format that is not written: .jpg, .gif, .svg.
void check_picture_name(const std::string& output);

/// Whether the output's name says so.
bool is_exr(const std::string& output);
bool is_tiff(const std::string& output);

/// The layers of an OpenEXR file; empty for PNG and TIFF. Removes from the settings what such a file does not have:
/// labels, and the exposure and curve that scene or style mean for a screen. Fails if options contradict the file's
/// kind.
std::vector<Layer> choose_layers(const RenderOptions& options, const Scene& scene, RenderSettings& settings);

/// Converts a band of the film to the pixels of a PNG, with labels. `pixels`: the band's place in the whole picture.
PngPixels png_rows(const PictureRequest& options, const Scene& scene, const RenderSettings& settings, const Film& film,
                   const Tile& pixels);

/// Data of the file besides its pixels. All members except the text must outlive the file.
struct PictureToWrite {
  const RenderOptions& options;
  const Scene& scene;
  const Tracer& tracer;
  const RenderSettings& settings;
  const std::vector<Layer>& layers;
  std::vector<std::pair<std::string, std::string>> text;  ///< UTF-8
};

class PictureFile {
 public:
  virtual ~PictureFile() = default;
  /// The next rows: as BandCallback (render/renderer.h). An OpenEXR file without radiance ignores the film.
  virtual Status add(const Film& film, const Tile& pixels) = 0;
  /// The file gets its path.
  virtual Status finish() = 0;
  /// For pictures on screens alone.
  virtual std::optional<std::uint64_t> hash() const { return std::nullopt; }
  /// Memory for one pixel of a band, without the film.
  virtual double bytes_of_pixel() const = 0;
};

/// A PNG may go to the standard output. The file begins with its first rows. Until it is finished or destroyed, a
/// signal that ends the program removes it.
std::unique_ptr<PictureFile> open_picture(PictureToWrite picture);

}  // namespace bihive::cli
