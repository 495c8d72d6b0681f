#include "film/film_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/fixed_json.h"
#include "bihive/job/report_text.h"
#include "bihive/scene/names.h"
#include "commands/names.h"
#include "film/content_hash.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

constexpr int kFormat = 1;

// The limits of the command line's options.
constexpr std::int64_t kLargestSide = 65535;
constexpr double kMostTurntableDeg = 1e6;
constexpr std::int64_t kLastFrame = std::numeric_limits<std::int64_t>::max();

// Fractions and numbers that are too large are refused.
std::int64_t whole_of(const ordered_json& value, std::int64_t least, std::int64_t most) {
  const bool fits = value.is_number_integer() &&
                    (!value.is_number_unsigned() || value.get<std::uint64_t>() <= static_cast<std::uint64_t>(most));
  if (!fits || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
    throw std::out_of_range("whole number");
  return value.get<std::int64_t>();
}

ordered_json asked_json(const FilmPlan::Asked& asked) {
  ordered_json object = ordered_json::object();
  object["program"] = asked.program;
  object["input"] = asked.input;
  object["frames"] = {{"first", asked.frames.first}, {"step", asked.frames.step}, {"count", asked.frames.count}};
  object["pictures"] = asked.pictures;
  object["order"] = {{"hold_first", asked.order.hold_first},
                     {"hold_last", asked.order.hold_last},
                     {"reverse", asked.order.reverse},
                     {"ping_pong", asked.order.ping_pong}};
  object["fps"] = fmt::format("{}/{}", asked.rate.pictures, asked.rate.seconds);
  object["options"] = asked.options;
  object["turntable_deg"] = asked.path.turntable_deg;
  object["camera"] =
      asked.path.keys.empty() ? ordered_json() : *json_from_text<ordered_json>(camera_keys_to_json(asked.path.keys));
  object["turn_axis"] = asked.turn_axis;
  object["follow"] = asked.follow;
  object["align"] = asked.align;
  object["fit_frames"] = asked.fit_frames;
  object["colour_range"] = asked.range_of_colours;
  object["codec"] = asked.codec;
  object["metadata"] = asked.metadata;
  return object;
}

PictureOrder order_of(const ordered_json& value) {
  PictureOrder order;
  order.hold_first = whole_of(value.at("hold_first"), 0, kMostPictures);
  order.hold_last = whole_of(value.at("hold_last"), 0, kMostPictures);
  order.reverse = value.at("reverse").get<bool>();
  order.ping_pong = value.at("ping_pong").get<bool>();
  return order;
}

FilmPlan::Asked asked_of(const ordered_json& value, const std::string& path) {
  FilmPlan::Asked asked;
  asked.program = value.at("program").get<std::string>();
  asked.input = value.at("input");
  const ordered_json& frames = value.at("frames");
  asked.frames = {whole_of(frames.at("first"), 0, kLastFrame), whole_of(frames.at("step"), 1, kLastFrame),
                  whole_of(frames.at("count"), 1, kMostPictures)};
  asked.pictures = whole_of(value.at("pictures"), 1, kMostPictures);
  if (value.contains("order")) asked.order = order_of(value.at("order"));
  if (asked.order.positions(asked.pictures) > kMostPictures) throw std::out_of_range("order");
  const Result<FrameRate> rate = frame_rate_from(value.at("fps").get<std::string>());
  if (!rate) throw std::out_of_range("fps");
  asked.rate = *rate;
  asked.options = value.at("options").get<std::vector<std::string>>();
  asked.path.turntable_deg = value.at("turntable_deg").get<double>();
  if (!value.at("camera").is_null())
    asked.path.keys = value_or_fail(parse_camera_keys(value.at("camera").dump(), path));
  asked.turn_axis = value.value("turn_axis", "");
  asked.follow = value.value("follow", "");
  asked.align = value.value("align", "");
  asked.fit_frames = value.value("fit_frames", asked.fit_frames);
  if (!value_named(kFittedFrames, asked.fit_frames)) throw std::out_of_range("fit_frames");
  asked.range_of_colours = value.at("colour_range").get<std::string>();
  asked.codec = value.at("codec").get<std::string>();
  asked.metadata = value.value("metadata", true);
  if (asked.frames.count > 1 && asked.frames.count != asked.pictures) throw std::out_of_range("pictures");
  if (asked.frames.count - 1 > (kLastFrame - asked.frames.first) / asked.frames.step) throw std::out_of_range("frames");
  if (!(std::abs(asked.path.turntable_deg) <= kMostTurntableDeg)) throw std::out_of_range("turntable_deg");
  if (!value_named(kRangesOfColours, asked.range_of_colours)) throw std::out_of_range("colour_range");
  return asked;
}

FilmPlan::Fixed fixed_of(const ordered_json& value) {
  FilmPlan::Fixed fixed;
  fixed.width_px = static_cast<int>(whole_of(value.at("size_px").at(0), 1, kLargestSide));
  fixed.height_px = static_cast<int>(whole_of(value.at("size_px").at(1), 1, kLargestSide));
  fixed.camera = camera_of(value.at("camera"));
  fixed.range_of_style = range_of(value.at("range_of_style"));
  fixed.ranges_of_looks.reserve(value.at("ranges_of_looks").size());
  for (const ordered_json& range : value.at("ranges_of_looks")) fixed.ranges_of_looks.push_back(range_of(range));
  return fixed;
}

// One for each frame of the film, or none.
void check_count(std::size_t count, const FilmPlan::Asked& asked) {
  if (count != 0 && count != static_cast<std::size_t>(asked.frames.count)) throw std::out_of_range("frames");
}

// Values of films that move: absent in descriptions of others.
void add_moves(const ordered_json& value, const FilmPlan::Asked& asked, FilmPlan::Fixed& fixed) {
  if (value.contains("turn_axis")) {
    fixed.turn_axis = vector_of(value.at("turn_axis"));
    if (!(std::abs(length(*fixed.turn_axis) - 1) < 1e-6)) throw std::out_of_range("turn_axis");
  }
  if (value.contains("shifts"))
    for (const ordered_json& one : value.at("shifts")) fixed.shifts.push_back(point_of(one));
  if (value.contains("motions"))
    for (const ordered_json& one : value.at("motions")) fixed.motions.push_back(motion_of(one));
  if (value.contains("floor")) fixed.floor = plane_of(value.at("floor"));
  if (value.contains("density")) fixed.density = density_from(value.at("density"));
  check_count(fixed.shifts.size(), asked);
  check_count(fixed.motions.size(), asked);
}

FilmPlan::Made made_of(const ordered_json& value) {
  const std::optional<std::uint64_t> hash = hash_from_text(value.at("hash").get<std::string>());
  if (!hash) throw std::out_of_range("hash");
  return {whole_of(value.at("bytes"), 0, std::numeric_limits<std::int64_t>::max()), *hash};
}

ordered_json plan_json(const FilmPlan& plan) {
  ordered_json fixed = ordered_json::object();
  fixed["size_px"] = {plan.fixed.width_px, plan.fixed.height_px};
  fixed["camera"] = camera_json(plan.fixed.camera);
  fixed["range_of_style"] = range_json(plan.fixed.range_of_style);
  fixed["ranges_of_looks"] = ordered_json::array();
  for (const ColourRange& range : plan.fixed.ranges_of_looks) fixed["ranges_of_looks"].push_back(range_json(range));
  if (plan.fixed.turn_axis) fixed["turn_axis"] = vector_json(*plan.fixed.turn_axis);
  for (const Vec3d shift : plan.fixed.shifts) fixed["shifts"].push_back(vector_json(shift));
  for (const RigidMotion& motion : plan.fixed.motions) fixed["motions"].push_back(motion_json(motion));
  if (plan.fixed.floor) fixed["floor"] = plane_json(*plan.fixed.floor);
  if (plan.fixed.density) fixed["density"] = density_json(*plan.fixed.density);
  return {{"bihive_film", kFormat}, {"asked", asked_json(plan.asked)}, {"fixed", fixed}};
}

}  // namespace

std::string film_of_record(const FilmPlan& plan) {
  ordered_json document = plan_json(plan);
  for (const char* const elsewhere : {"program", "input", "options", "metadata"}) document["asked"].erase(elsewhere);
  return as_text(document, -1);
}

FilmPlan plan_of_record(const PictureRecord& record, const std::string& path) {
  const Result<ordered_json> parsed = json_from_text<ordered_json>(record.film, path);
  ordered_json document = parsed ? *parsed : ordered_json::object();
  if (!document.is_object() || !document["asked"].is_object())
    fail({"its record of how it was drawn is damaged", path, 0, 0, ""});
  document["asked"].update({{"program", record.version}, {"input", nullptr}, {"options", ordered_json::array()}});
  return parse_film_plan(as_text(document, -1), path, "its record of how it was drawn is damaged");
}

std::string film_plan_to_json(const FilmPlan& plan) {
  ordered_json document = plan_json(plan);
  if (plan.record) document["record"] = *json_from_text<ordered_json>(to_text(*plan.record));
  if (plan.made) document["made"] = {{"bytes", plan.made->bytes}, {"hash", hash_text(plan.made->hash)}};
  return as_text(document, 2) + "\n";
}

FilmPlan read_film_plan(const std::string& path) {
  return parse_film_plan(value_or_fail(read_file(path)), path);
}

FilmPlan parse_film_plan(const std::string& text, const std::string& path, const std::string& hint) {
  try {
    const Result<ordered_json> parsed = json_from_text<ordered_json>(text, path);
    const ordered_json document = parsed ? *parsed : ordered_json();
    if (document.at("bihive_film") == kFormat) {
      FilmPlan plan;
      plan.asked = asked_of(document.at("asked"), path);
      plan.fixed = fixed_of(document.at("fixed"));
      add_moves(document.at("fixed"), plan.asked, plan.fixed);
      if (document.contains("record"))
        plan.record = value_or_fail(picture_record_from(as_text(document.at("record"), -1)));
      if (document.contains("made")) plan.made = made_of(document.at("made"));
      return plan;
    }
  } catch (const ordered_json::exception&) {
    // Any other file.
  } catch (const std::out_of_range&) {
    // A number out of range for films.
  }
  fail({"is no description of a film", path, 0, 0,
        hint.empty() ? "bihive film writes one beside the film, with the ending .json" : hint});
}

std::string difference(const FilmPlan::Asked& kept, const FilmPlan::Asked& asked) {
  const ordered_json old = asked_json(kept), now = asked_json(asked);
  for (const auto& [word, value] : now.items())
    if (old.at(word) != value) {
      const bool are_many = word.back() == 's' && word != "fps";
      return fmt::format("its {} {} {}, and {} {} now", word, are_many ? "were" : "was", as_text(old.at(word), -1),
                         are_many ? "are" : "is", as_text(value, -1));
    }
  return "";
}

}  // namespace bihive::cli
