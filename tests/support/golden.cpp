#include "support/golden.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "bihive/image/image_diff.h"
#include "bihive/image/png.h"

namespace bihive::testing {

void expect_golden(const std::string& name, const Image& image) {
  const std::string kept = std::string(BIHIVE_SOURCE_DIR) + "/tests/golden/pictures/" + name + ".png";
  if (std::getenv("BIHIVE_UPDATE_GOLDEN") != nullptr) {
    const Status written = write_png(kept, image, {});
    ADD_FAILURE() << (written ? "updated " + kept : written.error().to_string());
    return;
  }

  // If the pictures differ, leave all three behind.
  const Result<PngFile> reference = read_png(kept);
  const std::string left = "golden_failures/" + name;
  std::filesystem::create_directories(std::filesystem::path(left).parent_path());
  if (!reference) {
    const Status written = write_png(left + ".output.png", image, {});
    ADD_FAILURE() << reference.error().to_string() << (written ? "; the output is " + left + ".output.png" : "");
    return;
  }
  const ImageDifference difference = difference_of(image, reference->image);
  if (difference.same_size && difference.pixels == 0) return;
  bool kept_all = bool(write_png(left + ".output.png", image, {})) &&
                  bool(write_png(left + ".reference.png", reference->image, {}));
  if (difference.same_size) kept_all = kept_all && bool(write_png(left + ".difference.png", difference.picture, {}));
  ADD_FAILURE() << name << ": " << difference.pixels << " pixels differ, by at most " << difference.largest
                << (kept_all ? "; see " + left + ".{output,reference,difference}.png" : "");
}

}  // namespace bihive::testing
