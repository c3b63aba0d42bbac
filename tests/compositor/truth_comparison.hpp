#pragma once
// Error of composited frames against traced references: colours on objects and elsewhere, and the positions of edges
// where geometry occludes objects.

#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "tests/compositor/truth_image.hpp"

#include <vector>

namespace rs::test {

// Distances from edge positions in either image to the nearest edge of the other, up to 8 px.
struct EdgeDistances {
    int places = 0;
    double mean_px = 0;
    double within_px = 0;  // 99th percentile
    double largest_px = 0;
};

struct TruthDifference {
    // PSNR over R, G, B of sRGB codes, in dB.
    double objects_db = 99;    // pixels in which the reference or the frame shows an object
    double elsewhere_db = 99;  // all others
    double alone_db = 99;      // objects without geometry: upper bound given by the engine's images
    double object_share = 0;   // fraction of the pixels
    EdgeDistances cuts;
    Image<Rgba8> frame;
    TruthImage truth;
};

// Requires a current gl::Context that outlives it.
class TruthComparison {
public:
    static Result<TruthComparison> create(const compositor::Scene& scene,
                                          const std::vector<compositor::PlacedObject>& objects,
                                          const std::vector<TracedNode>& traced,
                                          const compositor::FrameOptions& options);
    Result<TruthDifference> compare(const Camera& camera, const TruthOptions& options);

private:
    // The scene with everything but the objects in white and in black: their difference gives the objects' coverage.
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
    TruthScene objects_alone_;  // on black
};

}  // namespace rs::test
