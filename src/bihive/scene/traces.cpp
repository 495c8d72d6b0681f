#include "bihive/scene/traces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/select/number_term.h"
#include "bihive/select/residues.h"
#include "bihive/select/selection.h"

namespace bihive {
namespace {

constexpr const char* kUsualBeads = "(protein and name CA) or (nucleic and name P)";
constexpr int kMostChords = 64;  // from a bead to the next

struct Bead {
  std::int32_t sphere;
  Vec3d centre;
  double radius;
};

Error error_of(const char* setting, const Error& error) {
  const std::string place = error.column > 0 ? "column " + std::to_string(error.column) + ": " : "";
  return {setting_name(setting) + ": " + place + error.message, "", 0, 0, error.hint};
}

Result<std::vector<std::uint8_t>> beads_of(const SphereSet& spheres, const std::string& select) {
  if (!select.empty()) {
    Result<std::vector<std::uint8_t>> selected = select_spheres(spheres, select);
    if (!selected) return error_of("trace_select", selected.error());
    return selected;
  }
  // Without the names that it asks for, every sphere is a bead.
  Result<std::vector<std::uint8_t>> usual = select_spheres(spheres, kUsualBeads);
  const auto is_any = [](std::uint8_t one) { return one != 0; };
  if (usual && std::any_of(usual->begin(), usual->end(), is_any)) return usual;
  return std::vector<std::uint8_t>(static_cast<std::size_t>(spheres.size()), 1);
}

// The radius of tubes at each bead.
class TubeRadii {
 public:
  static Result<TubeRadii> from_text(const SphereSet& spheres, const std::string& text) {
    TubeRadii made(spheres);
    if (text.empty()) return made;
    made.number_ = parse_double(text);
    if (made.number_) return made;
    Result<FoundAttribute> found = find_numbers(spheres, text);
    if (!found)
      return error_of("trace_radius", {"no number, and " + found.error().message, "", 0, 0, found.error().hint});
    if (!found->has_numbers())
      return Error{setting_name("trace_radius") + ": \"" + text + "\" holds texts, and a radius is a number", "", 0, 0,
                   ""};
    made.attribute_ = std::move(*found);
    return made;
  }

  double at(std::int64_t id) const {
    if (number_) return *number_;
    return attribute_.found() ? attribute_.number_of(*spheres_, id) : 0.25 * spheres_->radius(id);
  }

 private:
  explicit TubeRadii(const SphereSet& spheres) : spheres_(&spheres) {}

  const SphereSet* spheres_;
  std::optional<double> number_;
  FoundAttribute attribute_;
};

// The beads of each chain, in their order. A residue has one bead in a row.
Result<std::vector<std::vector<Bead>>> chains_of(const Scene& scene, const Traces& traces,
                                                 const std::vector<std::uint8_t>& mask,
                                                 const std::vector<std::int32_t>& residues) {
  const SphereSet& spheres = scene.spheres;
  const std::string name = traces.by == TraceBy::chain ? "chain" : "mol";
  const FoundAttribute chain = find_attribute(spheres, name);
  if (!chain.found())
    return Error{setting_name("trace") + ": there is no attribute \"" + name + "\"", "", 0, 0,
                 suggestion(name, attribute_names(spheres))};
  const Result<TubeRadii> radii = TubeRadii::from_text(spheres, traces.radius);
  if (!radii) return radii.error();

  std::vector<std::vector<Bead>> chains;
  std::map<double, std::size_t> position_of_chain;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const auto i = static_cast<std::size_t>(id);
    if (mask[i] == 0) continue;
    const double key = chain.texts != nullptr ? double(chain.texts->text_of_sphere[i]) : chain.number_of(spheres, id);
    if (std::isnan(key)) continue;
    const auto [at, is_new] = position_of_chain.try_emplace(key, chains.size());
    if (is_new) chains.emplace_back();
    std::vector<Bead>& beads = chains[at->second];
    const bool in_last_residue =
        !residues.empty() && !beads.empty() && residues[static_cast<std::size_t>(beads.back().sphere)] == residues[i];
    if (in_last_residue && traces.select.empty()) continue;
    const double radius = radii->at(id);
    if (!(radius > 0 && std::isfinite(radius)))
      return Error{setting_name("trace_radius") + ": the radius of a tube must be above 0, and is " +
                       (std::isnan(radius)   ? "unknown"
                        : std::isinf(radius) ? "infinite"
                                             : "not") +
                       " at sphere " + std::to_string(input_id(scene, id)),
                   "", 0, 0, traces.radius.empty() ? "state it: " + setting_name("trace_radius") + " R" : ""};
    beads.push_back({static_cast<std::int32_t>(id), spheres.local_centre(id), radius});
  }
  return chains;
}

// The median distance of neighbours, NaN: there are none.
double median_distance(const std::vector<std::vector<Bead>>& chains) {
  std::vector<double> distances;
  for (const std::vector<Bead>& beads : chains)
    for (std::size_t k = 1; k < beads.size(); ++k) distances.push_back(length(beads[k].centre - beads[k - 1].centre));
  if (distances.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

// A centripetal Catmull-Rom curve between the second and the third of four points [Catmull-Rom by Barry and Goldman].
class Curve {
 public:
  explicit Curve(const std::array<Vec3d, 4>& points) : points_(points) {
    for (std::size_t k = 1; k < 4; ++k) knots_[k] = knots_[k - 1] + std::sqrt(length(points[k] - points[k - 1]));
  }

  // `share`: 0 at the second point, 1 at the third.
  Vec3d at(double share) const {
    const double t = knots_[1] + share * (knots_[2] - knots_[1]);
    const auto between = [&](Vec3d a, Vec3d b, std::size_t from, std::size_t to) {
      const double along = (t - knots_[from]) / (knots_[to] - knots_[from]);
      return a + along * (b - a);
    };
    const Vec3d a = between(points_[0], points_[1], 0, 1), b = between(points_[1], points_[2], 1, 2),
                c = between(points_[2], points_[3], 2, 3);
    return between(between(a, b, 0, 2), between(b, c, 1, 3), 1, 2);
  }

 private:
  std::array<Vec3d, 4> points_;
  std::array<double, 4> knots_{};
};

// The largest distance of the curve from its chords, between each pair in the middle.
double chord_error(const Curve& curve, int chords) {
  double largest = 0;
  Vec3d from = curve.at(0);
  for (int k = 1; k <= chords; ++k) {
    const Vec3d to = curve.at(double(k) / chords), middle = curve.at((k - 0.5) / chords);
    const Vec3d axis = to - from;
    const double along = std::clamp(dot(middle - from, axis) / dot(axis, axis), 0.0, 1.0);
    largest = std::max(largest, length(middle - from - along * axis));
    from = to;
  }
  return largest;
}

// The sticks of a run of at least two beads.
void add_tube(const std::vector<Bead>& beads, std::vector<OwnStick>& sticks) {
  const auto bead = [&](std::size_t k) { return beads[k].centre; };
  for (std::size_t k = 0; k + 1 < beads.size(); ++k) {
    // Beyond its ends the run goes on as it came.
    const Vec3d before = k > 0 ? bead(k - 1) : 2.0 * bead(k) - bead(k + 1);
    const Vec3d after = k + 2 < beads.size() ? bead(k + 2) : 2.0 * bead(k + 1) - bead(k);
    const Curve curve({before, bead(k), bead(k + 1), after});
    const double tolerance = kTraceChordShare * std::min(beads[k].radius, beads[k + 1].radius);
    int chords = 2;
    while (chords < kMostChords && chord_error(curve, chords) > tolerance) chords *= 2;
    Vec3d from = bead(k);
    for (int chord = 1; chord <= chords; ++chord) {
      const double begin = double(chord - 1) / chords, end = double(chord) / chords;
      const Vec3d to = chord == chords ? bead(k + 1) : curve.at(end);
      const auto radius = [&](double share) {
        return beads[k].radius + share * (beads[k + 1].radius - beads[k].radius);
      };
      OwnStick stick{from, to, radius(begin), radius(end), beads[2 * chord <= chords ? k : k + 1].sphere};
      if (chord == chords) stick.radius_b = beads[k + 1].radius;
      sticks.push_back(stick);
      from = to;
    }
  }
}

// Gives the spheres whose mask is not 0 the radius 0, in the same stored units, which sticks share.
Status clear_radii(SphereSet& spheres, const std::vector<std::uint8_t>& mask) {
  StoredSpheres stored{spheres.x(), spheres.y(), spheres.z(), spheres.r()};
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i] != 0) stored.r[i] = 0;
  SphereSet made = SphereSet::from_stored(std::move(stored), spheres.scale_exponent(), spheres.origin());
  if (Status status = made.keep_cell_of(spheres); !status) return status;
  made.make_room(0.75 * spheres.inverse_scale());
  made.attributes() = std::move(spheres.attributes());
  spheres = std::move(made);
  return Done{};
}

}  // namespace

Result<AddedTraces> add_traces(Scene& scene, const Traces& traces) {
  const Result<std::vector<std::uint8_t>> mask = beads_of(scene.spheres, traces.select);
  if (!mask) return mask.error();
  const Result<std::vector<std::int32_t>> known = residue_of_spheres(scene.spheres);
  const std::vector<std::int32_t> residues = known ? *known : std::vector<std::int32_t>();
  const Result<std::vector<std::vector<Bead>>> chains = chains_of(scene, traces, *mask, residues);
  if (!chains) return chains.error();

  // Divide chains at their gaps, and draw each run of beads.
  const double farthest = kTraceGap * median_distance(*chains);
  const FoundAttribute number = residues.empty() ? FoundAttribute() : find_attribute(scene.spheres, "resid");
  const auto jumps = [&](const Bead& a, const Bead& b) {
    return number.has_numbers() &&
           std::abs(number.number_of(scene.spheres, b.sphere) - number.number_of(scene.spheres, a.sphere)) > 1;
  };
  AddedTraces added;
  std::vector<OwnStick> sticks;
  std::vector<std::uint8_t> in_tube(mask->size());
  for (const std::vector<Bead>& beads : *chains) {
    std::vector<Bead> run;
    const auto end_run = [&] {
      if (run.size() == 1) ++added.alone;
      if (run.size() > 1) {
        add_tube(run, sticks);
        ++added.tubes;
        added.beads += static_cast<std::int64_t>(run.size());
        for (const Bead& bead : run) in_tube[static_cast<std::size_t>(bead.sphere)] = 1;
      }
      run.clear();
    };
    for (const Bead& bead : beads) {
      const bool is_new = run.empty() || bead.centre != run.back().centre;
      if (!is_new) continue;
      if (!run.empty() && (length(bead.centre - run.back().centre) > farthest || jumps(run.back(), bead))) end_run();
      run.push_back(bead);
    }
    end_run();
  }
  if (Status status = scene.sticks.add(scene.spheres, sticks); !status) return error_of("trace", status.error());
  if (Status status = check_sticks(scene); !status) return status.error();
  if (traces.atoms == TraceAtoms::shown || added.tubes == 0) return added;

  // With a bead its whole residue is hidden.
  std::vector<std::uint8_t> hidden = in_tube;
  if (!residues.empty()) {
    std::vector<std::uint8_t> traced;
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      const auto residue = static_cast<std::size_t>(residues[i]);
      if (traced.size() <= residue) traced.resize(residue + 1);
      if (in_tube[i] != 0) traced[residue] = 1;
    }
    for (std::size_t i = 0; i < hidden.size(); ++i) hidden[i] = traced[static_cast<std::size_t>(residues[i])];
  }
  if (Status status = clear_radii(scene.spheres, hidden); !status) return status.error();
  return added;
}

}  // namespace bihive
