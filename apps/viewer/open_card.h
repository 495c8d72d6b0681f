// The card "Open": the path of a file as it is typed, the files that it may mean, and the built-in scenes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/viewer/file_names.h"
#include "bihive/viewer/viewer.h"
#include "widgets.h"

namespace bihive::window {

/// What the user has chosen.
struct OpenRequests {
  std::optional<std::string> file, built_in;
  std::optional<std::int64_t> count;  ///< of a scenario, which is shown already
  bool forget = false;                ///< the files that were opened before
};

class OpenCard {
 public:
  /// It opens: with the folder of the file that is shown.
  void begin(const std::string& shown);

  // What is typed, event by event, not frame by frame, so that no letter is lost while a picture is drawn.
  void type(const std::string& text);
  void erase();
  void complete();
  void move(int by);  ///< to another line of the list
  /// The file that is meant; nothing: a folder, which is listed now, or no text.
  std::optional<std::string> take();

  OpenRequests draw(const Viewer& viewer, Fields& fields);

  std::vector<std::string> recent;  ///< paths, the newest first

 private:
  void list();
  std::optional<std::string> take(const FileName& name);

  std::string typed_;
  std::vector<FileName> names_;
  int chosen_ = -1;  // in the list; below 0: what is typed
  bool scroll_ = false;
};

}  // namespace bihive::window
