// Values that scene files and style files share, from JSON that the schema accepts.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bihive/image/transfer.h"
#include "bihive/scene/material.h"
#include "bihive/settings/parameter_json.h"

namespace bihive {

Vec3d vector_from_json(const nlohmann::json& value);

/// Missing keys keep the value in `material`. `transfer` is for colours that are texts.
void take_material(const nlohmann::json& value, Transfer transfer, Material& material);

}  // namespace bihive
