#include "capture/tracer/scene/texture_lookup.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

namespace {

// Fraction of `coordinate` in [0, 1); 0 for NaN and for values too large to have a fraction.
float repeat(float coordinate) {
    const float fraction = coordinate - std::floor(coordinate);
    return fraction >= 0.0F && fraction < 1.0F ? fraction : 0.0F;
}

// Repeats a coordinate, or clamps it to the centres of the border pixels.
float wrap_coordinate(float coordinate, bool repeats, int size) {
    if (repeats) return repeat(coordinate);
    const float half_px = 0.5F / static_cast<float>(size);
    return coordinate > half_px ? std::min(coordinate, 1.0F - half_px) : half_px;
}

}  // namespace

RgbaF sample_texture(const Texture& texture, const glm::vec2& uv) {
    const Image<RgbaF>& pixels = texture.pixels;
    const float x = wrap_coordinate(uv.x, texture.repeat_u, pixels.width()) * static_cast<float>(pixels.width()) - 0.5F;
    const float y =
        (1.0F - wrap_coordinate(uv.y, texture.repeat_v, pixels.height())) * static_cast<float>(pixels.height()) - 0.5F;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const float fx = x - left;
    const float fy = y - top;
    const int x0 = left < 0.0F ? pixels.width() - 1 : static_cast<int>(left);
    const int y0 = top < 0.0F ? pixels.height() - 1 : static_cast<int>(top);
    const int x1 = x0 + 1 == pixels.width() ? 0 : x0 + 1;
    const int y1 = y0 + 1 == pixels.height() ? 0 : y0 + 1;
    const auto vec = [&](int px, int py) {
        const RgbaF& p = pixels(px, py);
        return glm::vec4(p.r, p.g, p.b, p.a);
    };
    const glm::vec4 value =
        glm::mix(glm::mix(vec(x0, y0), vec(x1, y0), fx), glm::mix(vec(x0, y1), vec(x1, y1), fx), fy);
    return {value.r, value.g, value.b, value.a};
}

float sample_texture_alpha(const Texture& texture, const glm::vec2& uv) {
    const Image<RgbaF>& pixels = texture.pixels;
    const int x =
        static_cast<int>(wrap_coordinate(uv.x, texture.repeat_u, pixels.width()) * static_cast<float>(pixels.width()));
    const int y = static_cast<int>((1.0F - wrap_coordinate(uv.y, texture.repeat_v, pixels.height())) *
                                   static_cast<float>(pixels.height()));
    return pixels(std::min(x, pixels.width() - 1), std::min(y, pixels.height() - 1)).a;
}

glm::vec3 mean_colour(const Texture& texture) {
    glm::dvec3 sum(0.0);
    for (const RgbaF& p : texture.pixels.pixels()) sum += glm::dvec3(p.r, p.g, p.b);
    return glm::vec3(sum / static_cast<double>(texture.pixels.pixels().size()));
}

glm::vec2 interpolate_uv(const Mesh& mesh, std::size_t triangle, float u, float v) {
    if (mesh.uvs.empty()) return glm::vec2(0.0F);
    const glm::uvec3& t = mesh.triangles[triangle];
    return mesh.uvs[t.x] * (1.0F - u - v) + mesh.uvs[t.y] * u + mesh.uvs[t.z] * v;
}

glm::vec3 interpolate_colour(const Mesh& mesh, std::size_t triangle, float u, float v) {
    if (mesh.colours.empty()) return glm::vec3(1.0F);
    const glm::uvec3& t = mesh.triangles[triangle];
    return mesh.colours[t.x] * (1.0F - u - v) + mesh.colours[t.y] * u + mesh.colours[t.z] * v;
}

bool has_holes(const Texture& texture) {
    return std::ranges::any_of(texture.pixels.pixels(), [](const RgbaF& p) { return p.a < kHoleAlpha; });
}

}  // namespace rs::capture
