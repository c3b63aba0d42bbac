#include "datasets-synthetic/shapes/paint.hpp"

#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"
#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

// Whole pixels of a box, clipped to the canvas' height.
struct PixelBox {
    int x0, y0, x1, y1;  // x1, y1 excluded
};

PixelBox pixels_of(vec2 low, vec2 high, int canvas_height) {
    return {static_cast<int>(std::floor(low.x)), std::max(0, static_cast<int>(std::floor(low.y))),
            static_cast<int>(std::ceil(high.x)), std::min(canvas_height, static_cast<int>(std::ceil(high.y)))};
}

vec2 centre_of(int x, int y) {
    return {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F};
}

// Position of a pixel within a stroke.
struct BrushContact {
    float coverage = 0.0F;
    float across = 0.0F;  // -1..1 from the brush's left to its right edge
    float along_px = 0.0F;
};

BrushContact touch(vec2 p, vec2 a, vec2 b, float radius_a, float radius_b, float length_before_px) {
    const vec2 ab = b - a;
    const float length2 = glm::dot(ab, ab);
    const float t = length2 > 0.0F ? std::clamp(glm::dot(p - a, ab) / length2, 0.0F, 1.0F) : 0.0F;
    const vec2 off = p - (a + ab * t);
    const float radius = radius_a + (radius_b - radius_a) * t;
    const float distance = glm::length(off);
    const float side = ab.x * off.y - ab.y * off.x < 0.0F ? -1.0F : 1.0F;
    // A brush thinner than a pixel is painted with reduced coverage.
    const float coverage = std::clamp(radius + 0.5F - distance, 0.0F, std::min(1.0F, 2.0F * radius));
    return {coverage, side * distance / std::max(radius, 0.5F), length_before_px + t * std::sqrt(length2)};
}

float density_at(const Ink& ink, const BrushContact& contact) {
    float density = ink.density;
    if (ink.streaks > 0.0F) {
        const vec3 p{contact.across * 2.5F, contact.along_px * 0.03F, static_cast<float>(ink.seed % 997U) * 1.37F};
        density *= 1.0F - ink.streaks * std::clamp(0.5F + 0.9F * layered_noise(p, 2, ink.seed), 0.0F, 1.0F);
    }
    if (ink.pooling > 0.0F) density += ink.pooling * contact.across * contact.across * (1.0F - density);
    return std::clamp(density, 0.0F, 1.0F);
}

// Distance to the polygon's boundary, negative inside (even-odd rule).
float polygon_distance(std::span<const vec2> polygon, vec2 p) {
    float nearest2 = 1e30F;
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const vec2 a = polygon[j];
        const vec2 b = polygon[i];
        const vec2 ab = b - a;
        const float length2 = std::max(glm::dot(ab, ab), 1e-12F);
        const vec2 off = p - a - ab * std::clamp(glm::dot(p - a, ab) / length2, 0.0F, 1.0F);
        nearest2 = std::min(nearest2, glm::dot(off, off));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * ab.x) inside = !inside;
    }
    return inside ? -std::sqrt(nearest2) : std::sqrt(nearest2);
}

}  // namespace

vec3 srgb(std::uint32_t hex) {
    // Called for every pixel.
    static const std::array<float, 256> kLinear = [] {
        std::array<float, 256> linear{};
        for (std::size_t k = 0; k < linear.size(); ++k)
            linear[k] = static_cast<float>(portable::srgb_to_linear(static_cast<double>(k) / 255.0));
        return linear;
    }();
    return {kLinear[(hex >> 16U) & 255U], kLinear[(hex >> 8U) & 255U], kLinear[hex & 255U]};
}

vec3 hue_colour(float hue_turns, float saturation, float value) {
    vec3 colour;
    for (int c = 0; c < 3; ++c) {
        const float h = hue_turns + 1.0F - static_cast<float>(c) / 3.0F;
        const float distance = std::abs((h - std::floor(h + 0.5F)) * 6.0F);  // 0 at the primary, 3 opposite
        const float pure = std::clamp(2.0F - distance, 0.0F, 1.0F);
        const float v = value * (1.0F - saturation + saturation * pure);
        colour[c] = static_cast<float>(portable::srgb_to_linear(static_cast<double>(std::clamp(v, 0.0F, 1.0F))));
    }
    return colour;
}

Canvas::Canvas(int width_px, int height_px, vec3 background)
    : pixels_(width_px, height_px, RgbaF{background.x, background.y, background.z, 1.0F}) {
    RS_CHECK(width_px >= 1 && height_px >= 1);
}

void Canvas::blend(int x, int y, float coverage, vec3 colour) {
    const int width = pixels_.width();
    x %= width;
    RgbaF& pixel = pixels_(x < 0 ? x + width : x, pixels_.height() - 1 - y);
    pixel.r += (colour.x - pixel.r) * coverage;
    pixel.g += (colour.y - pixel.g) * coverage;
    pixel.b += (colour.z - pixel.b) * coverage;
}

void Canvas::stroke(std::span<const vec2> path_px, std::span<const float> radii_px, const Ink& ink) {
    RS_CHECK(!path_px.empty() && (radii_px.size() == 1 || radii_px.size() == path_px.size()));
    const auto radius = [&](std::size_t i) { return radii_px.size() == 1 ? radii_px[0] : radii_px[i]; };
    vec2 low{1e30F};
    vec2 high{-1e30F};
    for (std::size_t i = 0; i < path_px.size(); ++i) {
        low = glm::min(low, path_px[i] - (radius(i) + 1.0F));
        high = glm::max(high, path_px[i] + (radius(i) + 1.0F));
    }
    const PixelBox box = pixels_of(low, high, pixels_.height());
    if (box.y1 <= box.y0) return;
    // Collects all segments, then blends once per pixel, so that overlapping segments are not counted twice.
    Image<BrushContact> contacts(box.x1 - box.x0, box.y1 - box.y0);
    float length_px = 0.0F;
    for (std::size_t i = 0; i < path_px.size(); ++i) {
        const std::size_t next = std::min(i + 1, path_px.size() - 1);
        if (next == i && i > 0) break;
        const vec2 a = path_px[i];
        const vec2 b = path_px[next];
        const float reach = std::max(radius(i), radius(next)) + 1.0F;
        const PixelBox part = pixels_of(glm::min(a, b) - reach, glm::max(a, b) + reach, pixels_.height());
        // A segment is searched within its larger radius, which may reach beyond the box of the stroke.
        for (int y = std::max(part.y0, box.y0); y < std::min(part.y1, box.y1); ++y) {
            for (int x = std::max(part.x0, box.x0); x < std::min(part.x1, box.x1); ++x) {
                const BrushContact contact = touch(centre_of(x, y), a, b, radius(i), radius(next), length_px);
                BrushContact& best = contacts(x - box.x0, y - box.y0);
                if (contact.coverage > best.coverage) best = contact;
            }
        }
        length_px += glm::length(b - a);
    }
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const BrushContact& contact = contacts(x - box.x0, y - box.y0);
            if (contact.coverage > 0.0F) blend(x, y, contact.coverage * density_at(ink, contact), ink.colour);
        }
    }
}

void Canvas::fill(std::span<const vec2> polygon_px, const Ink& ink) {
    RS_CHECK(polygon_px.size() >= 3);
    vec2 low{1e30F};
    vec2 high{-1e30F};
    for (const vec2& p : polygon_px) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const float size_px = std::max(1.0F, 0.5F * std::min(high.x - low.x, high.y - low.y));
    const PixelBox box = pixels_of(low - 1.0F, high + 1.0F, pixels_.height());
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const vec2 p = centre_of(x, y);
            const float distance = polygon_distance(polygon_px, p);
            const float coverage = std::clamp(0.5F - distance, 0.0F, 1.0F);
            if (coverage <= 0.0F) continue;
            const float across = std::clamp(1.0F + distance / size_px, 0.0F, 1.0F);
            blend(x, y, coverage * density_at(ink, {coverage, across, p.y - low.y}), ink.colour);
        }
    }
}

void Canvas::band(float low_px, float high_px, const Ink& ink) {
    const PixelBox box = pixels_of({0.0F, low_px}, {width_px(), high_px}, pixels_.height());
    for (int y = box.y0; y < box.y1; ++y) {
        const float bottom = static_cast<float>(y);
        const float coverage = std::clamp(std::min(high_px, bottom + 1.0F) - std::max(low_px, bottom), 0.0F, 1.0F);
        for (int x = box.x0; x < box.x1; ++x) {
            // Streaks of a banding wheel, periodic around the object.
            const float turn = static_cast<float>(x) / width_px();
            const float streak =
                ink.streaks *
                std::clamp(0.5F + 0.9F * layered_noise({turn * 24.0F, bottom * 0.11F, 0.0F}, 3, ink.seed, 24), 0.0F,
                           1.0F);
            blend(x, y, coverage * ink.density * (1.0F - streak), ink.colour);
        }
    }
}

void Canvas::shade(vec2 low_px, vec2 high_px, const std::function<vec3(vec2, vec3)>& shade) {
    const PixelBox box = pixels_of(low_px, high_px, pixels_.height());
    const int width = pixels_.width();
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const int column = ((x % width) + width) % width;
            const RgbaF& pixel = pixels_(column, pixels_.height() - 1 - y);
            blend(x, y, 1.0F, shade(centre_of(x, y), {pixel.r, pixel.g, pixel.b}));
        }
    }
}

capture::Texture Canvas::texture(std::string name) && {
    constexpr float kWhitest = 0.9F;
    for (RgbaF& pixel : pixels_.pixels()) {
        pixel.r = std::clamp(pixel.r, 0.0F, kWhitest);
        pixel.g = std::clamp(pixel.g, 0.0F, kWhitest);
        pixel.b = std::clamp(pixel.b, 0.0F, kWhitest);
    }
    return {std::move(name), std::move(pixels_)};
}

}  // namespace rs::synthetic
