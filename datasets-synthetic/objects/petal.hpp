#pragma once
// Petals and leaves: thin curved sheets.

#include "capture/tracer/scene/scene.hpp"
#include "datasets-synthetic/shapes/frame.hpp"

namespace rs::synthetic {

struct PetalShape {
    float length = 1.0F;
    float width = 0.4F;        // at its widest
    float base_width = 0.2F;   // at the base, as a share of `width`, 0..1
    float widest_at = 0.6F;    // share of the length, 0.1..0.9
    float pointedness = 0.0F;  // 0: round tip, 1: pointed
    float curl_rad = 0.5F;     // rotation of the tip towards the back (-Z) relative to the base
    float cup = 0.1F;          // the edges rise towards +Z by this share of the half-width
    float ripple = 0.0F;       // amplitude of the waves along the edges, share of the half-width
    float ripple_waves = 3.0F;
    float ripple_phase_rad = 0.0F;
    int columns = 8;
    int rows = 12;
};

// The sheet starts at the frame's origin, grows along its +Y and faces its +Z. Texture u runs across, v from base to
// tip.
void append_petal(capture::Mesh& mesh, const Frame& base, const PetalShape& shape);

// Frame on the centre line at share `t` of the length, in the coordinates of `base`'s parent.
Frame petal_frame(const Frame& base, const PetalShape& shape, float t);

}  // namespace rs::synthetic
