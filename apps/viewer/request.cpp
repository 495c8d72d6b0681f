#include "request.h"

#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/scene/names.h"

namespace bihive::window {
namespace {

using nlohmann::json;

Result<Request> take(const json& document) {
  Request request;
  if (document.contains("shown_frames")) {
    request.shown_frames = document.at("shown_frames").get<std::string>();
    request.seconds = document.value("seconds", request.seconds);
    return request;
  }
  request.input = document.at("input").get<std::string>();
  request.scenario.count = document.value("count", request.scenario.count);
  request.scenario.seed = document.value("seed", request.scenario.seed);
  const Result<GivenReading> reading = reading_from_json(document.value("reading", json::object()).dump());
  if (!reading) return reading.error();
  request.reading = *reading;
  if (const std::optional<double> radius = reading->options().radius)
    request.scenario.radius = scenario_radius(*radius);
  if (document.contains("size")) {
    request.width = document.at("size").at(0).get<int>();
    request.height = document.at("size").at(1).get<int>();
  }
  for (const auto& [name, side] : kSides)
    if (document.value("view_from", "") == name) request.side = side;
  if (document.contains("settings")) request.settings = document.at("settings").dump();
  if (document.contains("look")) request.look = document.at("look").dump();
  request.places_camera = document.contains(json::json_pointer("/settings/camera/eye"));
  request.tune = document.value("tune", false);
  request.welcomes = document.value("welcome", false);
  request.card = document.value("card", "");
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
