#pragma once
// Environment light: radiance look-up by direction, importance sampling of directions by luminance, and irradiance
// by normal.
//
// Look-ups are bilinear. The density is constant over each pixel of the map (rows weighted by their solid angle), and
// proportional to the mean luminance of the 3x3 pixels around it, so that it is positive wherever a look-up is
// positive.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/image/image.hpp"

#include <vector>

namespace rs::capture {

class EnvironmentMap {
public:
    // Pixel values must be finite and not negative.
    explicit EnvironmentMap(Environment environment);

    // See Environment.
    void set_turn(float turn_rad) { turn_rad_ = turn_rad; }
    void set_scale(float scale) { scale_ = scale; }

    // Returns true if radiance() is 0 everywhere; sample() must not be called then.
    [[nodiscard]] bool is_black() const { return row_cdf_.empty() || !(scale_ > 0.0F); }

    // Radiance arriving from unit direction `towards_sky`.
    [[nodiscard]] glm::vec3 radiance(const glm::vec3& towards_sky) const;

    // Density of sample() per steradian at a direction.
    [[nodiscard]] float pdf(const glm::vec3& towards_sky) const;

    struct Sample {
        glm::vec3 direction;
        float pdf;  // per steradian, > 0
    };
    [[nodiscard]] Sample sample(const glm::vec2& u) const;

    // Mean luminance over the sphere.
    [[nodiscard]] float mean_luminance() const { return scale_ * mean_luminance_; }

private:
    struct MapPosition {
        float x;  // px
        float y;
    };
    [[nodiscard]] MapPosition position_of(const glm::vec3& direction) const;

    Image<RgbaF> pixels_;
    float turn_rad_;
    float scale_;
    float mean_luminance_ = 0.0F;     // of the pixels
    std::vector<float> row_cdf_;      // height + 1, from 0 to 1
    std::vector<float> column_cdf_;   // height * (width + 1): row y begins at y * (width + 1)
    std::vector<float> cos_of_edge_;  // height + 1: cosine of the polar angle of the edge above row y
};

// Irradiance of an environment as a function of the surface normal: its cosine convolution on a coarse grid of normals.
class IrradianceMap {
public:
    // Uses the environment's current rotation. Takes a few milliseconds.
    explicit IrradianceMap(const EnvironmentMap& environment);

    // Irradiance for a unit normal, within 1 % of the exact integral of the environment averaged over 3 degree patches.
    // Thread-safe.
    [[nodiscard]] glm::vec3 at(const glm::vec3& normal) const;

    [[nodiscard]] bool is_black() const { return grid_.width() == 0; }

private:
    Image<RgbaF> grid_;  // empty if black
};

}  // namespace rs::capture
