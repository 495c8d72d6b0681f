// The settings of a request as a list, to be kept in a file and taken again with changes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bihive/job/picture_request.h"

namespace bihive {

/// All options of a request: those of its files by their paths, maps of colours from files as colours. Actions on
/// spheres come last, in their order; the others are in the order of the table, the same in every front end.
std::vector<GivenSetting> ordered_settings(const PictureRequest& request);

/// Takes `kept` and `changes` into a request that has no settings. A change replaces a kept setting of the same kind,
/// and one that contradicts it; changes before a `select` apply to all spheres, and come before the kept selections.
/// `value_of`: the value of a kept setting that stays; default: as it is. Fails as take_setting().
void merge_settings(PictureRequest& request, const std::vector<GivenSetting>& kept,
                    const std::vector<GivenSetting>& changes,
                    const std::function<std::string(const GivenSetting&)>& value_of = {});

}  // namespace bihive
