#pragma once
// Draws a scene's background (background_shaders.hpp).

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
    kBehindGeometry,  // where nothing has left its depth yet: indoors that is next to nothing
};

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class BackgroundRenderer {
public:
    static Result<BackgroundRenderer> create(const Background& background);

    // One colour everywhere: clearing the frame with it is enough.
    [[nodiscard]] bool plain() const { return plain_; }
    [[nodiscard]] const glm::vec3& zenith() const { return zenith_; }

    // Leaves depth alone.
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
