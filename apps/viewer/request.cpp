#include "request.h"

#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/scene/names.h"

namespace bihive::window {
namespace {

using nlohmann::json;

Request take(const json& document) {
  Request request;
  if (document.contains("shown_frames")) {
    request.shown_frames = document.at("shown_frames").get<std::string>();
    request.seconds = document.value("seconds", request.seconds);
    return request;
  }
  request.input = document.at("input").get<std::string>();
  request.scenario.count = document.value("count", request.scenario.count);
  request.scenario.seed = document.value("seed", request.scenario.seed);
  if (document.contains("radius")) {
    const double radius = document.at("radius").get<double>();
    request.scenario.radius = scenario_radius(radius);
    request.reading.radius = radius;
  }
  request.reading.radius_scale = document.value("radius_scale", request.reading.radius_scale);
  request.reading.recenter = document.value("recenter", false);
  request.reading.trajectory = document.value("trajectory", "");
  request.reading.assembly = document.value("assembly", "");
  request.reading.columns = document.value("columns", request.reading.columns);
  request.reading.replicate = document.value("replicate", request.reading.replicate);
  const auto vector = [](const json& v) {
    return Vec3d{v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
  };
  if (document.contains("cell_vectors")) {
    const json& v = document.at("cell_vectors");
    request.reading.cell_vectors = {vector(v.at(0)), vector(v.at(1)), vector(v.at(2))};
  }
  if (document.contains("cell_origin")) request.reading.cell_origin = vector(document.at("cell_origin"));
  const std::string wrapping = document.value("wrapping", "");
  if (wrapping == "wrap") request.reading.wrapping = Wrapping::wrap;
  if (wrapping == "unwrap") request.reading.wrapping = Wrapping::unwrap;
  request.reading.frame = document.value("frame", request.reading.frame);
  if (document.contains("size")) {
    request.width = document.at("size").at(0).get<int>();
    request.height = document.at("size").at(1).get<int>();
  }
  for (const auto& [name, side] : kSides)
    if (document.value("view_from", "") == name) request.side = side;
  if (document.contains("settings")) request.settings = document.at("settings").dump();
  if (document.contains("look")) request.look = document.at("look").dump();
  request.screenshot = document.value("screenshot", "");
  return request;
}

}  // namespace

Result<Request> request_from_json(std::string_view text) {
  const Result<json> document = json_from_text<json>(text);
  if (!document) return Error{"this program is started by `bihive view`: " + document.error().message, "", 0, 0, ""};
  try {
    return take(*document);
  } catch (const json::exception& error) {
    return Error{std::string("this program is started by `bihive view`: ") + error.what(), "", 0, 0, ""};
  }
}

}  // namespace bihive::window
