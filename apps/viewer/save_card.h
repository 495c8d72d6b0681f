// The card "Save": the file and the size of a saved picture.
#pragma once

#include <string>

#include "bihive/viewer/orbit.h"
#include "bihive/viewer/viewer_look.h"

namespace bihive::window {

class SaveCard {
 public:
  std::string file_name = "bihive.png";

  /// Of a picture that has this size on the screen.
  PictureSizePx size(PictureSizePx screen) const;
  /// True: the picture is to be saved.
  bool draw(PictureSizePx screen, ViewerLook& look);

 private:
  int chosen_ = 0;                 // in the list of sizes
  PictureSizePx own_{1920, 1080};  // of "other"
};

}  // namespace bihive::window
