#pragma once
// Reference selection: the nearest eligible images of a ring on either side of an image.

#include "rayspace/object/ray_space_object.hpp"

#include <algorithm>
#include <cstdint>

namespace rs::encode {

/// Calls use(view, reach_px) for the nearest view before position n of the ring, then for the nearest after it, among
/// the positions p for which may_serve(p) is true (at least one). Calls it once if both are the same view. `reach_px`:
/// the largest horizontal displacement of surfaces between the two images of `width` pixels, within 8 .. most_reach_px.
template <class MayServe, class Use>
void for_ring_references(const Ring& ring, int n, int width, int most_reach_px, const MayServe& may_serve,
                         const Use& use) {
    const int count = static_cast<int>(ring.views.size());
    int first = -1;
    for (const int direction : {-1, 1}) {
        int steps = 1;
        int other = (n + direction + count) % count;
        while (!may_serve(other)) {
            other = (other + direction + count) % count;
            ++steps;
        }
        if (other == first) continue;
        first = other;
        const double angle = 6.2832 * steps / count;
        use(ring.views[static_cast<std::size_t>(other)],
            std::clamp(static_cast<int>(0.35 * angle * width) + 6, 8, most_reach_px));
    }
}

}  // namespace rs::encode
