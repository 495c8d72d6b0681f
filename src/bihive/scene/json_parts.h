// The parts that scene files and style files share: from JSON that the schema accepts to their values.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bihive/image/transfer.h"
#include "bihive/scene/material.h"
#include "bihive/scene/scene.h"

namespace bihive {

Vec3d vector_from_json(const nlohmann::json& value);
Vec3d colour_from_json(const nlohmann::json& value, Transfer transfer);

/// What the object does not say keeps the value in `material`. `transfer` is for colours that are texts.
void take_material(const nlohmann::json& value, Transfer transfer, Material& material);

/// The same for a picture; the transfer comes first, because text colours depend on it.
void take_picture(const nlohmann::json& value, PictureDefaults& picture);

}  // namespace bihive
