#include "compositor/displays/panorama.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rs::compositor {
namespace {

constexpr double kMinLevelPart = 1e-6;  // horizontal part of a unit direction that is not vertical

// Axes of a face, in coordinates of the panorama: x right, y up, -z ahead.
struct FaceAxes {
    glm::dvec3 forward, right, up;
};
constexpr std::array<FaceAxes, kPanoramaFaces> kFaces{{{{0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
                                                       {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                                       {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
                                                       {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                                       {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                                       {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}}}};

glm::dvec3 direction_ahead(const Camera& camera) {
    const glm::dvec3 forward = camera.forward();
    glm::dvec3 ahead(forward.x, 0, forward.z);
    if (glm::length(ahead) < kMinLevelPart) {
        const glm::dvec3 up = forward.y > 0 ? -camera.up() : camera.up();
        ahead = {up.x, 0, up.z};
    }
    return glm::normalize(ahead);
}

std::size_t face_of(const glm::dvec3& d) {
    const glm::dvec3 size = glm::abs(d);
    if (size.y >= size.x && size.y >= size.z) return d.y > 0 ? 4 : 5;
    if (size.x >= size.z) return d.x > 0 ? 1 : 3;
    return d.z < 0 ? 0 : 2;
}

// Bilinear, in linear light. \param x, y position, px; pixel centres have fraction 0.5
Rgba8 sample_face(const Image<Rgba8>& face, double x, double y) {
    const double left = std::clamp(x - 0.5, 0.0, face.width() - 1.0);
    const double top = std::clamp(y - 0.5, 0.0, face.height() - 1.0);
    const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
    const int x1 = std::min(x0 + 1, face.width() - 1), y1 = std::min(y0 + 1, face.height() - 1);
    const auto fx = static_cast<float>(left - x0), fy = static_cast<float>(top - y0);
    const Rgba8 &a = face(x0, y0), &b = face(x1, y0), &c = face(x0, y1), &d = face(x1, y1);
    const auto mix = [&](std::uint8_t Rgba8::*channel) {
        const auto linear = [&](const Rgba8& pixel) { return linear_from_srgb8(pixel.*channel); };
        const float upper = linear(a) + fx * (linear(b) - linear(a));
        const float lower = linear(c) + fx * (linear(d) - linear(c));
        return srgb8_by_table(upper + fy * (lower - upper));
    };
    return {mix(&Rgba8::r), mix(&Rgba8::g), mix(&Rgba8::b), 255};
}

}  // namespace

int PanoramaLayout::face_px() const {
    return static_cast<int>(std::ceil(width / kPi));
}

std::array<Camera, kPanoramaFaces> panorama_cameras(const Camera& camera, const PanoramaLayout& layout) {
    const glm::dvec3 up(0, 1, 0);
    const glm::dvec3 ahead = direction_ahead(camera);
    const glm::dmat3 world_from_panorama(glm::cross(ahead, up), up, -ahead);
    std::array<Camera, kPanoramaFaces> cameras;
    for (std::size_t face = 0; face < kPanoramaFaces; ++face) {
        Camera& made = cameras[face];
        made.width = made.height = layout.face_px() + 2 * layout.margin_px;
        made.fl_x = made.fl_y = layout.face_px() / 2.0;
        made.cx = made.cy = made.width / 2.0;
        const FaceAxes& axes = kFaces[face];
        made.world_from_camera =
            glm::dmat4(glm::dvec4(world_from_panorama * axes.right, 0), glm::dvec4(world_from_panorama * axes.up, 0),
                       glm::dvec4(world_from_panorama * -axes.forward, 0), glm::dvec4(camera.centre(), 1));
    }
    return cameras;
}

Image<Rgba8> panorama_from_faces(const std::array<Image<Rgba8>, kPanoramaFaces>& faces, const PanoramaLayout& layout) {
    Image<Rgba8> panorama(layout.width, layout.height());
    const double focal_px = layout.face_px() / 2.0;
    for_each_index(layout.height(), 0, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        const double polar = kPi * (y + 0.5) / layout.height();
        for (int x = 0; x < layout.width; ++x) {
            const double turn = 2 * kPi * ((x + 0.5) / layout.width - 0.5);
            const glm::dvec3 d(std::sin(polar) * std::sin(turn), std::cos(polar), -std::sin(polar) * std::cos(turn));
            const std::size_t face = face_of(d);
            const FaceAxes& axes = kFaces[face];
            const double depth = glm::dot(d, axes.forward);
            const double middle = faces[face].width() / 2.0;
            panorama(x, y) = sample_face(faces[face], middle + focal_px * glm::dot(d, axes.right) / depth,
                                         middle - focal_px * glm::dot(d, axes.up) / depth);
        }
    });
    return panorama;
}

}  // namespace rs::compositor
