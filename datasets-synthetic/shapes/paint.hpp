#pragma once
// Procedural painting of textures: brush strokes, filled polygons and per-pixel shading on a canvas that wraps around
// along x.
//
// Canvas coordinates are pixels with the origin at the *lower* left corner and y upwards, so that (x / width, y /
// height) is the texture coordinate; pixel centres at +0.5. Colours are linear light. Not thread-safe.

#include "capture/tracer/scene/scene.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rs::synthetic {

// Converts an sRGB colour 0xRRGGBB to linear light.
glm::vec3 srgb(std::uint32_t hex);

// Converts HSV, interpreted as sRGB, to linear light: hue in turns (0 red, 1/3 green, 2/3 blue), saturation and value
// 0..1.
glm::vec3 hue_colour(float hue_turns, float saturation, float value);

struct Ink {
    glm::vec3 colour{0.0F};
    float density = 1.0F;  // opacity, 0..1
    float streaks = 0.0F;  // share of the density with brush streaks, 0..1
    float pooling = 0.0F;  // increase of the density near the stroke's edge, 0..1
    std::uint32_t seed = 0;
};

class Canvas {
public:
    // `width`, `height` >= 1
    Canvas(int width_px, int height_px, glm::vec3 background);

    [[nodiscard]] float width_px() const { return static_cast<float>(pixels_.width()); }
    [[nodiscard]] float height_px() const { return static_cast<float>(pixels_.height()); }

    // A brush of changing radius drawn along `path_px` (>= 1 point; a single one is a dot); `radii_px` one per point or
    // one for all. x may leave the canvas: the stroke continues on the other side.
    void stroke(std::span<const glm::vec2> path_px, std::span<const float> radii_px, const Ink& ink);

    // Fills a simple polygon.
    void fill(std::span<const glm::vec2> polygon_px, const Ink& ink);

    // A full-width band between two heights.
    void band(float low_px, float high_px, const Ink& ink);

    // Replaces every pixel by shade(centre, colour so far) in the box [low, high); it may leave the canvas along x.
    void shade(glm::vec2 low_px, glm::vec2 high_px, const std::function<glm::vec3(glm::vec2, glm::vec3)>& shade);

    // The finished texture; colours are clamped to [0, 0.9], the reflectance of white paint.
    [[nodiscard]] capture::Texture texture(std::string name) &&;

private:
    void blend(int x, int y, float coverage, glm::vec3 colour);

    Image<RgbaF> pixels_;
};

// Capital letter of a stroke font, as pen paths (lettering.cpp).
struct Letter {
    std::vector<std::vector<glm::vec2>> strokes;  // polylines, curves finely divided; y from 0 (base line) to 1
    float width = 0.0F;                           // x from 0 to this
};

// `letter`: 'A' to 'Z'.
Letter pen_letter(char letter);

}  // namespace rs::synthetic
