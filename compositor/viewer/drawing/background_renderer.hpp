#pragma once
// Background renderer: sky and ground gradients and a cube of images, or a visible environment
// (background_shaders.hpp).

#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/surroundings.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <array>
#include <memory>
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

    /// Shows the environment instead of the background if it is `seen`. Uploads the map only if it is another one.
    /// \param environment scaled by the exposure.
    Status set_environment(const std::optional<EnvironmentLight>& environment);

    /// True if the background has one colour; clearing the frame draws it.
    [[nodiscard]] bool plain() const { return plain_ && !environment_; }
    [[nodiscard]] const glm::vec3& zenith() const { return zenith_; }

    /// Neither tests nor writes depth.
    void draw(const Camera& camera, BackgroundArea area) const;

private:
    explicit BackgroundRenderer(gl::Program program) : program_(std::move(program)), rectangle_(4) {}

    struct Environment {
        gl::Program program;
        gl::Texture map;
        std::shared_ptr<const Image<RgbaF>> pixels;  // of the map
        float scale = 1;
        float turn_rad = 0;
    };

    gl::Program program_;
    std::optional<Environment> environment_;
    gl::VertexArray rectangle_;
    std::optional<gl::Buffer> stops_;
    std::array<std::optional<gl::Texture>, 6> images_;
    glm::dmat3 background_from_world_{1.0};
    glm::vec3 zenith_{0};
    bool plain_ = true;
};

}  // namespace rs::compositor
