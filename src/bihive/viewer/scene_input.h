// An input as read, from which the scene is rebuilt for every look of the user.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/load_scene.h"
#include "bihive/settings/overrides.h"
#include "bihive/viewer/shown_scene.h"
#include "bihive/viewer/viewer_look.h"

namespace bihive {

/// State carried over from another frame of a trajectory, so that colours and floor do not jump.
struct KeptOfFrame {
  const std::vector<ColourBy>* ranges = nullptr;  ///< as Scene::coloured_by
  std::optional<Plane> floor{};                   ///< of the look
};

class SceneInput {
 public:
  using Copies = std::optional<std::array<std::int32_t, 3>>;

  // Errors as those of built_in_scene() and load_scene().
  static Result<SceneInput> built_in(const std::string& name, const ScenarioParameters& parameters,
                                     const ReadOptions& options);
  static Result<SceneInput> file(std::string_view bytes, const std::string& name, const ReadOptions& options);
  /// Spheres already read.
  static SceneInput spheres(SphereFile file, const std::string& name);
  /// A scene made by the caller: it has its own appearance and takes no style.
  static SceneInput made(Scene scene, SceneFacts facts, bool has_camera, bool has_lights);

  const SceneFacts& facts() const { return facts_; }
  void add_warning(std::string warning) { facts_.warnings.push_back(std::move(warning)); }
  /// As read: those that a look hides too.
  const SphereSet& spheres() const { return loaded_.scene.spheres; }

  /// A scene, and the number of spheres that each row of the look selects.
  struct Looked {
    LoadedScene loaded;
    std::vector<std::int64_t> counts;
  };
  /// As `bihive render` with these options makes it. Errors: no such style, colour or action, a style for a scene that
  /// takes none, a selection's (column as in select_spheres()), or that every sphere is hidden. `failed_row` (if given)
  /// is then the faulty row; look.rows.size() if none is. `copies`: along the vectors of the cell; unset: those of the
  /// input. `user`: parameters of the picture, of which those of sticks count. Error too if there is no cell, if the
  /// scene has a plane beside which the look wants a floor, or if the spheres have not what sticks need.
  Result<Looked> looked_at(const ViewerLook& look, const Copies& copies, const Overrides& user,
                           std::size_t* failed_row = nullptr, const KeptOfFrame& kept = {}) const;

 private:
  // spheres: a style determines the appearance. document: a scene file, read again for each style. own: takes no style.
  enum class Kind { spheres, document, own };

  SceneInput(Kind kind, LoadedScene loaded);
  Result<LoadedScene> in_style(const std::string& style, const Copies& copies,
                               const std::vector<ColourBy>* ranges) const;
  static Status replicate(Scene& scene, const Copies& copies);
  Result<std::vector<std::int64_t>> do_looks(LoadedScene& loaded, const ViewerLook& look, std::size_t* failed_row,
                                             const std::vector<ColourBy>* ranges) const;

  Kind kind_;
  LoadedScene loaded_;  // its own looks are not applied yet
  SceneFacts facts_;
  std::string bytes_, name_;  // of a document
  ReadOptions options_;
};

}  // namespace bihive
