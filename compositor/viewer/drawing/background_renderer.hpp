#pragma once
// Background renderer: sky and ground gradients and a cube of images (background_shaders.hpp).

#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/surroundings.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <array>
#include <optional>

namespace rs::compositor {

enum class BackgroundArea {
    kWholeFrame,
    kBehindGeometry,  // pixels without geometry only; indoors these are few
};

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class BackgroundRenderer {
public:
    static Result<BackgroundRenderer> create(const Background& background);

    /// True if the background has one colour; clearing the frame draws it.
    [[nodiscard]] bool plain() const { return plain_; }
    [[nodiscard]] const glm::vec3& zenith() const { return zenith_; }

    /// Neither tests nor writes depth.
    void draw(const Camera& camera, BackgroundArea area) const;

private:
    explicit BackgroundRenderer(gl::Program program) : program_(std::move(program)), rectangle_(4) {}

    gl::Program program_;
    gl::VertexArray rectangle_;
    std::optional<gl::Buffer> stops_;
    std::array<std::optional<gl::Texture>, 6> images_;
    glm::dmat3 background_from_world_{1.0};
    glm::vec3 zenith_{0};
    bool plain_ = true;
};

}  // namespace rs::compositor
