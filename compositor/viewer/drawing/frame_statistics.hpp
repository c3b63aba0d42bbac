#pragma once
// Counts and times of one frame.

#include <cstdint>
#include <vector>

namespace rs::compositor {

// One ray-space node in one frame.
struct NodeStatistics {
    bool in_view = false;
    int width = 0;  // of the image that the engine rendered, px
    int height = 0;
    double engine_s = 0;
    bool by_board = false;
    bool missing = false;  // a placeholder is in view
};

struct FrameStatistics {
    int nodes_rendered = 0;            // by the engine
    int nodes_by_board = 0;            // of nodes_rendered
    int nodes_not_seen = 0;            // off the screen, too small, or not loaded
    int nodes_missing = 0;             // placeholders in view
    std::int64_t pixels_rendered = 0;  // by the engine
    int geometry_in_view = 0;          // geometry nodes within the frustum
    bool has_depths = true;            // of geometry; under a traced image only if something needs them
    int shadow_maps_drawn = 0;         // because something in them has changed
    double shadows_s = 0;              // drawing of shadow maps
    double geometry_s = 0;             // background, geometry, floor
    double engine_s = 0;               // rendering of the views, in parallel with the geometry
    double engine_wait_s = 0;          // the part of engine_s that the frame waited for
    double upload_s = 0;               // of the engine's images
    double composite_s = 0;            // blending, transparent geometry, averaging of samples
    std::vector<NodeStatistics> nodes;
};

}  // namespace rs::compositor
