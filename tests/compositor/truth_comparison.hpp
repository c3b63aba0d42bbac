#pragma once
// How far composited frames are from the truth: colours where objects are seen and elsewhere, and the edges at which
// geometry cuts objects.

#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "tests/compositor/truth_image.hpp"

#include <vector>

namespace rs::test {

// Of places at which one of two images has such an edge; each looks for the nearest edge of the other, up to 8 px.
struct EdgeDistances {
    int places = 0;
    double mean_px = 0;
    double within_px = 0;  // 99 of 100 places
    double largest_px = 0;
};

struct TruthDifference {
    // dB with peak 255 over R, G, B of sRGB codes.
    double objects_db = 99;    // pixels in which the truth or the frame shows something of an object
    double elsewhere_db = 99;  // all others
    double alone_db = 99;      // objects without any geometry: what the engine's images can reach
    double object_share = 0;   // of the pixels
    EdgeDistances cuts;
    Image<Rgba8> frame;
    TruthImage truth;
};

// Needs a gl::Context that is current, and outlives it.
class TruthComparison {
public:
    static Result<TruthComparison> create(const compositor::Scene& scene,
                                          const std::vector<compositor::PlacedObject>& objects,
                                          const std::vector<TracedNode>& traced,
                                          const compositor::FrameOptions& options);
    Result<TruthDifference> compare(const Camera& camera, const TruthOptions& options);

private:
    // The same scene with everything but objects in white and in black: their difference tells how much of a pixel
    // objects cover.
    struct Backdrops {
        compositor::FrameCompositor white;
        compositor::FrameCompositor black;
        [[nodiscard]] Result<Image<float>> covered(const Camera& camera);
    };
    TruthComparison(compositor::FrameCompositor frames, Backdrops with_geometry, Backdrops without, TruthScene truth,
                    TruthScene objects_alone)
        : frames_(std::move(frames)),
          with_geometry_(std::move(with_geometry)),
          without_(std::move(without)),
          truth_(std::move(truth)),
          objects_alone_(std::move(objects_alone)) {}

    compositor::FrameCompositor frames_;
    Backdrops with_geometry_;
    Backdrops without_;
    TruthScene truth_;
    TruthScene objects_alone_;  // before black
};

}  // namespace rs::test
