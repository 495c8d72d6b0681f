#include "bihive/scene/looks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/image/transfer.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/creases.h"
#include "bihive/select/selection.h"
#include "bihive/settings/picture_effects.h"

namespace bihive {
namespace {

Error look_error(const std::string& message, const std::string& hint = "") {
  return {message, "", 0, 0, hint};
}

// The spheres' appearance after the looks. Each array is empty until an action needs it.
class LookedAt {
 public:
  explicit LookedAt(const Scene& scene) : scene_(scene) {}

  // The mask of the spheres that the present actions are for.
  void select(std::vector<std::uint8_t> mask) {
    mask_ = std::move(mask);
    colours_by_attribute_ = false;
  }

  Status operator()(const SetShown& action) {
    set(shown_, std::uint8_t{1}, std::uint8_t(action.shown ? 1 : 0));
    return Done{};
  }

  Status operator()(const SetColour& action) {
    const Result<Vec3f> colour = linear_colour(action.colour, scene_.picture.transfer);
    if (!colour) return colour.error();
    take_colours();
    for (std::size_t i = 0; i < mask_.size(); ++i)
      if (mask_[i] != 0) colours_[i] = *colour;
    set_meaning(-1);
    colours_by_attribute_ = false;
    return Done{};
  }

  Status operator()(const SetColours& action) {
    if (Status status = check_count(action.colours.size(), "colours"); !status) return status;
    const bool through_curve = !action.are_light && scene_.picture.transfer == Transfer::srgb;
    take_colours();
    for (std::size_t i = 0; i < mask_.size(); ++i) {
      if (mask_[i] == 0) continue;
      Vec3d colour = action.colours[i];
      for (int channel = 0; channel < 3; ++channel) {
        if (!(colour[channel] >= 0 && colour[channel] <= 1))
          return look_error("numbers of colours lie between 0 and 1");
        if (through_curve) colour[channel] = linear_from_srgb(colour[channel]);
      }
      colours_[i] = to_float(colour);
    }
    set_meaning(-1);
    colours_by_attribute_ = false;
    return Done{};
  }

  Status operator()(const ColourBy& action) {
    take_colours();
    const Result<ColourBy> done =
        colour_by(scene_.spheres, action, mask_, scene_.picture.transfer, colours_, scene_.element_colours);
    if (!done) return done.error();
    set_meaning(static_cast<std::int32_t>(scene_.coloured_by.size() + meanings_.size()));
    meanings_.push_back(*done);
    colours_by_attribute_ = true;
    return Done{};
  }

  Status operator()(const SetOpacity& action) {
    if (!(action.opacity >= 0 && action.opacity <= 1)) return look_error("an opacity lies between 0 and 1");
    if (opacities_.empty()) opacities_ = scene_.spheres.attributes().opacity;
    set(opacities_, 1.0F, static_cast<float>(action.opacity));
    return Done{};
  }

  Status operator()(const SetOpacities& action) {
    if (Status status = check_count(action.opacities.size(), "opacities"); !status) return status;
    if (opacities_.empty()) opacities_ = scene_.spheres.attributes().opacity;
    if (opacities_.empty()) opacities_.assign(mask_.size(), 1.0F);
    for (std::size_t i = 0; i < mask_.size(); ++i) {
      if (mask_[i] == 0) continue;
      if (!(action.opacities[i] >= 0 && action.opacities[i] <= 1)) return look_error("an opacity lies between 0 and 1");
      opacities_[i] = static_cast<float>(action.opacities[i]);
    }
    return Done{};
  }

  Status operator()(const SetMaterial& action) {
    take_colours();
    if (materials_.empty()) material_of_ = scene_.material_of_sphere;
    set(material_of_, std::int32_t{0}, static_cast<std::int32_t>(scene_.materials.size() + materials_.size()));
    materials_.push_back(action.material);
    return Done{};
  }

  Status operator()(const ScaleRadius& action) {
    if (!(action.factor >= 0) || !std::isfinite(action.factor))
      return look_error("a factor for radii is finite and at least 0");
    if (factors_.empty()) factors_.assign(mask_.size(), 1.0);
    for (std::size_t i = 0; i < mask_.size(); ++i)
      if (mask_[i] != 0) factors_[i] *= action.factor;
    return Done{};
  }

  Status operator()(const SetRadii& action) {
    if (Status status = check_count(action.radii.size(), "radii"); !status) return status;
    if (factors_.empty()) factors_.assign(mask_.size(), 1.0);
    if (radii_.empty())
      for (std::int64_t id = 0; id < scene_.spheres.size(); ++id) radii_.push_back(scene_.spheres.radius(id));
    for (std::size_t i = 0; i < mask_.size(); ++i) {
      if (mask_[i] == 0) continue;
      if (!(action.radii[i] >= 0) || !std::isfinite(action.radii[i]))
        return look_error("a radius is finite and at least 0");
      radii_[i] = action.radii[i];
      factors_[i] = 1;
    }
    return Done{};
  }

  Status operator()(const SetOutline& action) {
    const double width = action.width_px;
    if (width != 0 && !(width >= 1 && width <= kWidestOutlinePx))
      return look_error("an outline is 0 (none) or 1 to 16 pixels wide");
    if (outlines_.empty()) outlines_ = scene_.spheres.attributes().outline_px;
    set(outlines_, -1.0F, static_cast<float>(width));
    return Done{};
  }

  Status operator()(const SetCrease& action) {
    const Result<std::vector<std::int32_t>> groups = crease_groups(scene_.spheres, action.attribute);
    if (!groups) return groups.error();
    if (creases_.empty()) creases_ = scene_.spheres.attributes().crease;
    creases_.resize(mask_.size(), 0);
    for (std::size_t i = 0; i < mask_.size(); ++i)
      if (mask_[i] != 0) creases_[i] = (*groups)[i];
    return Done{};
  }

  Status operator()(const SetLegendName& action) {
    if (action.name.empty()) return look_error("a name in the legend has at least one character");
    if (colours_by_attribute_) {
      meanings_.back().title = action.name;
      return Done{};
    }
    take_colours();
    if (!have_one_colour()) {
      return look_error("a name in the legend stands beside one colour, and these spheres have several",
                        "colour them first, by a colour or by an attribute");
    }
    if (legend_names_.empty()) legend_names_ = scene_.legend_names;
    set_meaning(-2 - static_cast<std::int32_t>(legend_names_.size()));
    legend_names_.push_back(action.name);
    return Done{};
  }

  Status operator()(const AddClip& action) {
    if (Status status = check_clip(action.clip); !status) return status.error();
    if (clips_.empty()) {
      clips_ = scene_.clips;
      clips_of_ = scene_.spheres.attributes().clips;
    }
    auto place = static_cast<std::size_t>(std::find(clips_.begin(), clips_.end(), action.clip) - clips_.begin());
    if (place == clips_.size()) {
      if (clips_.size() == kMostClips) return look_error("there are more than 64 different clips");
      clips_.push_back(action.clip);
    }
    clips_of_.resize(mask_.size(), 0);
    for (std::size_t i = 0; i < mask_.size(); ++i)
      if (mask_[i] != 0) clips_of_[i] |= std::uint64_t{1} << place;
    return Done{};
  }

  // Gives everything to the scene.
  Status finish(Scene& scene) {
    if (!shown_.empty() && std::count(shown_.begin(), shown_.end(), std::uint8_t{0}) == 0) shown_.clear();
    Result<SphereSet> set = SphereSet();
    const bool new_set = !shown_.empty() || !factors_.empty();
    if (new_set) {
      set = rebuilt(scene.spheres);
      if (!set) return set.error();
      if (set->empty()) return look_error("every sphere is hidden", "show some of them");
    }
    if (!shown_.empty()) keep_entries(clips_of_, shown_);
    if (all_cut_away(new_set ? *set : scene.spheres))
      return look_error("every sphere is cut away or hidden", "clip less");
    if (new_set) {
      set->attributes() = std::move(scene.spheres.attributes());
      if (!shown_.empty()) set->attributes().keep_only(shown_);
    }
    if (!materials_.empty()) {
      scene.materials.insert(scene.materials.end(), materials_.begin(), materials_.end());
      scene.material_of_sphere = std::move(material_of_);
    }
    if (!meaning_of_.empty()) {
      scene.coloured_by.insert(scene.coloured_by.end(), meanings_.begin(), meanings_.end());
      scene.coloured_by_of_sphere = std::move(meaning_of_);
    }
    if (!legend_names_.empty()) scene.legend_names = std::move(legend_names_);
    if (!shown_.empty()) {
      keep_entries(scene.material_of_sphere, shown_);
      keep_entries(scene.coloured_by_of_sphere, shown_);
      keep_entries(colours_, shown_);
      keep_entries(opacities_, shown_);
      keep_entries(outlines_, shown_);
      keep_entries(creases_, shown_);
      keep_ids(scene);
    }
    if (new_set) scene.spheres = std::move(*set);
    if (!colours_.empty()) scene.spheres.attributes().colour = std::move(colours_);
    if (!opacities_.empty()) scene.spheres.attributes().opacity = std::move(opacities_);
    if (!outlines_.empty()) scene.spheres.attributes().outline_px = std::move(outlines_);
    if (!creases_.empty()) scene.spheres.attributes().crease = std::move(creases_);
    if (!clips_.empty()) {
      scene.clips = std::move(clips_);
      scene.spheres.attributes().clips = std::move(clips_of_);
    }
    return Done{};
  }

 private:
  Status check_count(std::size_t count, const std::string& what) const {
    if (count == mask_.size()) return Done{};
    return look_error("there are " + std::to_string(count) + " " + what + " for " + std::to_string(mask_.size()) +
                      " spheres");
  }

  template <class T>
  void set(std::vector<T>& values, T before, T wanted) {
    if (values.empty()) values.assign(mask_.size(), before);
    for (std::size_t i = 0; i < mask_.size(); ++i)
      if (mask_[i] != 0) values[i] = wanted;
  }

  bool all_cut_away(const SphereSet& spheres) const {
    if (clips_.empty() || spheres.empty()) return false;
    const CutSet cuts(spheres, clips_, clips_of_);
    for (std::int64_t id = 0; id < spheres.size(); ++id)
      if (cuts.remainder(id) != Remainder::nothing) return false;
    return true;
  }

  // The meaning of the present spheres' colours: a position in the scene's list, then in meanings_.
  void set_meaning(std::int32_t meaning) {
    if (meaning_of_.empty()) meaning_of_ = scene_.coloured_by_of_sphere;
    set(meaning_of_, std::int32_t{scene_.coloured_by.empty() ? -1 : 0}, meaning);
  }

  bool have_one_colour() const {
    const Vec3f* first = nullptr;
    for (std::size_t i = 0; i < mask_.size(); ++i) {
      if (mask_[i] == 0) continue;
      if (first != nullptr && !(colours_[i] == *first)) return false;
      first = &colours_[i];
    }
    return true;
  }

  // The current colours: the spheres' own, or those of their materials.
  void take_colours() {
    if (!colours_.empty()) return;
    colours_ = scene_.spheres.attributes().colour;
    if (!colours_.empty()) return;
    for (std::int64_t id = 0; id < scene_.spheres.size(); ++id)
      colours_.push_back(to_float(material_of(scene_, id).colour));
  }

  // The shown spheres with their new radii. Local centres in binary64 hold stored ones exactly.
  Result<SphereSet> rebuilt(const SphereSet& spheres) const {
    std::vector<double> x, y, z, r;
    for (std::int64_t id = 0; id < spheres.size(); ++id) {
      const auto i = static_cast<std::size_t>(id);
      if (!shown_.empty() && shown_[i] == 0) continue;
      const Vec3d centre = spheres.local_centre(id);
      x.push_back(centre.x);
      y.push_back(centre.y);
      z.push_back(centre.z);
      r.push_back((radii_.empty() ? spheres.radius(id) : radii_[i]) * (factors_.empty() ? 1.0 : factors_[i]));
    }
    Result<SphereSet> made = SphereSet::from_local(x, y, z, r, spheres.origin());
    if (made)
      if (Status status = made->keep_cell_of(spheres); !status) return status.error();
    return made;
  }

  void keep_ids(Scene& scene) const {
    if (scene.id_in_input.empty()) scene.size_of_input = scene_.spheres.size();
    if (scene.id_in_input.empty())
      for (std::int64_t id = 0; id < scene_.spheres.size(); ++id) scene.id_in_input.push_back(id);
    keep_entries(scene.id_in_input, shown_);
  }

  const Scene& scene_;
  std::vector<std::uint8_t> mask_, shown_;
  std::vector<Vec3f> colours_;
  std::vector<float> opacities_, outlines_;
  std::vector<std::int32_t> creases_;
  std::vector<Material> materials_;  // after those of the scene
  std::vector<std::int32_t> material_of_;
  std::vector<ColourBy> meanings_;  // after those of the scene
  std::vector<std::int32_t> meaning_of_;
  std::vector<std::string> legend_names_;  // with those of the scene
  bool colours_by_attribute_ = false;      // the present look does
  std::vector<double> factors_, radii_;
  std::vector<Clip> clips_;  // with those of the scene
  std::vector<std::uint64_t> clips_of_;
};

}  // namespace

Result<std::vector<std::int64_t>> apply_looks(Scene& scene, const std::vector<Look>& looks, std::size_t* failed,
                                              std::size_t* failed_action) {
  LookedAt looked_at(scene);
  std::vector<std::int64_t> counts;
  for (const Look& look : looks) {
    if (failed != nullptr) *failed = counts.size();
    if (failed_action != nullptr) *failed_action = look.actions.size();
    Result<std::vector<std::uint8_t>> mask = select_spheres(scene.spheres, look.select);
    if (!mask) return mask.error();
    const std::int64_t count = std::count(mask->begin(), mask->end(), std::uint8_t{1});
    looked_at.select(std::move(*mask));
    // Names of colours come after the colours.
    for (const bool names : {false, true})
      for (std::size_t i = 0; i < look.actions.size(); ++i) {
        if (std::holds_alternative<SetLegendName>(look.actions[i]) != names) continue;
        const Status status = std::visit(looked_at, look.actions[i]);
        if (status) continue;
        if (failed_action != nullptr) *failed_action = i;
        return status.error();
      }
    counts.push_back(count);
  }
  if (failed != nullptr) *failed = looks.size();
  if (looks.empty()) return counts;
  if (Status status = looked_at.finish(scene); !status) return status.error();
  return counts;
}

}  // namespace bihive
