#pragma once
// What a frame shows of a ray-space node: its object, or while that is being read, a placeholder, or one fading into
// the other.

#include "compositor/viewer/residency/placed_object.hpp"
#include "engine/driver/data_module.hpp"
#include "rayspace/base/result.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

// A soft upright shape of about the object's size.
struct Placeholder {
    Similarity world_from_object;
    double bottom = -1;  // object radii
    double top = 1;
    float opacity = 1;   // 0 .. 1
    float progress = 0;  // of reading, 0 .. 1: how far the shape is filled
};

struct ShownNode {
    std::optional<PlacedObject> object;
    engine::ObjectHandle handle;  // of the object, in the frame's data module
    float opacity = 1;            // of the object, 0 .. 1
    std::optional<Placeholder> placeholder;
};
using ShownNodes = std::vector<ShownNode>;

// For DataModule::load(): without a copy, and alive for as long as anybody uses it.
engine::PreparedObject prepared(const std::shared_ptr<const ViewableObject>& object);

// All at once, every object loaded into `engine`.
Result<std::shared_ptr<const ShownNodes>> show_all(const std::vector<PlacedObject>& objects,
                                                   engine::DataModule& engine);

// As many objects as a scene may have; a frame's views go in cycles of the board's size.
engine::DataModuleLimits limits_of_viewer();

}  // namespace rs::compositor
