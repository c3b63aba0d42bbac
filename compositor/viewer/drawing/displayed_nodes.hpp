#pragma once
// Content of the ray-space nodes in one frame: an object, a placeholder while it loads, or a cross-fade of both.

#include "compositor/viewer/residency/placed_object.hpp"
#include "engine/driver/render_session.hpp"
#include "rayspace/base/result.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

/// Soft upright shape of about the object's size.
struct Placeholder {
    Similarity world_from_object;
    double bottom = -1;  // object radii
    double top = 1;
    float opacity = 1;   // 0 .. 1
    float progress = 0;  // load progress, 0 .. 1: filled part of the shape
};

struct DisplayedNode {
    std::optional<PlacedObject> object;
    engine::ObjectHandle handle;  // handle of the object in the frame's render session
    float opacity = 1;            // of the object, 0 .. 1
    std::optional<Placeholder> placeholder;
    bool hidden = false;  // not drawn in this frame
};
using DisplayedNodes = std::vector<DisplayedNode>;

/// Object for RenderSession::load(): shares ownership, copies nothing.
engine::PreparedObject prepared(const std::shared_ptr<const ViewableObject>& object);

/// Displays all objects at full opacity, loaded into `engine`.
Result<std::shared_ptr<const DisplayedNodes>> load_all_nodes(const std::vector<PlacedObject>& objects,
                                                             engine::RenderSession& engine);

/// Any number of objects; other limits are the defaults.
engine::RenderSessionLimits viewer_session_limits();

}  // namespace rs::compositor
