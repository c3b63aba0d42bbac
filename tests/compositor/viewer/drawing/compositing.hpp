#pragma once
// Frames of a small scene by FrameCompositor. Skipped without OpenGL.

#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "tests/compositor/gl_test.hpp"
#include "tests/compositor/objects.hpp"

#include <algorithm>
#include <cstdlib>

namespace rs::compositor {

inline constexpr int kFrameWidth = 120;
inline constexpr int kFrameHeight = 90;
inline constexpr Rgba8 kRed{220, 40, 40, 255};
inline constexpr Rgba8 kBlue{40, 40, 220, 255};
inline const Camera kFront = look_at_camera({0, 0, 5}, {0, 0, 0}, radians(50), kFrameWidth, kFrameHeight);

// Conversion through YUV changes colours slightly; other colours differ much more.
inline bool is_colour(Rgba8 pixel, Rgba8 colour) {
    return std::abs(pixel.r - colour.r) < 6 && std::abs(pixel.g - colour.g) < 6 && std::abs(pixel.b - colour.b) < 6;
}

inline int difference(Rgba8 a, Rgba8 b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

// Number of pixels that differ by more than `tolerance`.
inline int count_different(const Image<Rgba8>& a, const Image<Rgba8>& b, int tolerance) {
    int count = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) count += difference(a(x, y), b(x, y)) > tolerance;
    }
    return count;
}

class Compositing : public test::GlTest {
protected:
    Image<Rgba8> compose(const Scene& scene, const std::vector<PlacedObject>& objects, const Camera& camera = kFront,
                         int samples = 4) {
        Result<FrameCompositor> compositor = FrameCompositor::create(
            scene, objects, {.width = camera.width, .height = camera.height, .samples = samples});
        RS_CHECK(compositor.ok());
        Result<Image<Rgba8>> frame = compositor->compose(camera);
        RS_CHECK(frame.ok());
        statistics_ = compositor->statistics();
        return std::move(*frame);
    }

    static Rgba8 middle(const Image<Rgba8>& frame) { return frame(frame.width() / 2, frame.height() / 2); }

    FrameStatistics statistics_;
};

inline Scene with_box(const glm::dvec3& size, const glm::dvec3& centre) {
    GeometryNode box;
    box.mesh = std::make_shared<const Mesh>(box_mesh(size));
    box.material.diffuse = {0.1F, 0.6F, 0.1F};
    box.material.ambient = 1;
    box.world_from_node[3] = glm::dvec4(centre, 1);
    Scene scene;
    scene.geometry.push_back(std::move(box));
    return scene;
}

}  // namespace rs::compositor
