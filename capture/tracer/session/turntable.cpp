#include "capture/tracer/session/turntable.hpp"

#include "capture/tracer/scene/scene_transform.hpp"
#include "capture/tracer/session/seeded_draws.hpp"
#include "capture/tracer/session/still_backdrop.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace rs::capture {

namespace {

constexpr double kHair = 1e-4;  // gap between coinciding surfaces; a fortieth of a pixel in usual images
constexpr int kSegments = 256;  // the disc's rim is true to 1e-4 of its radius
constexpr int kTextureSide_px = 1024;

enum TurntablePurpose : std::uint64_t { kSpeckles = 11, kBoard };

int add_material(Scene& scene, const std::string& name, const glm::vec3& colour, int texture = -1) {
    Material material;
    material.name = name;
    material.colour = colour;
    material.texture = texture;
    scene.materials.push_back(std::move(material));
    return static_cast<int>(scene.materials.size()) - 1;
}

int add_texture(Scene& scene, const std::string& name, Image<RgbaF> pixels) {
    scene.textures.push_back({name, std::move(pixels)});
    return static_cast<int>(scene.textures.size()) - 1;
}

RgbaF grey(double value) {
    const auto v = static_cast<float>(value);
    return {v, v, v, 1};
}

// Texture with grey value(r); r is the distance from the centre, 1 at the rim.
template <class Value>
Image<RgbaF> round_texture(const Value& value) {
    Image<RgbaF> pixels(kTextureSide_px, kTextureSide_px);
    for (int y = 0; y < kTextureSide_px; ++y) {
        for (int x = 0; x < kTextureSide_px; ++x) {
            const double u = (x + 0.5) / kTextureSide_px * 2 - 1;
            const double v = (y + 0.5) / kTextureSide_px * 2 - 1;
            pixels(x, y) = grey(value(std::hypot(u, v)));
        }
    }
    return pixels;
}

Image<RgbaF> ring_texture() {
    constexpr double kSoft = 3.0 / kTextureSide_px;
    return round_texture([&](double r) {
        double value = 0.55;
        for (const double ring : {0.25, 0.5, 0.75, 0.94}) {
            value -= 0.2 * soft_step((0.008 - std::abs(r - ring)) / kSoft);
        }
        return value;
    });
}

Image<RgbaF> speckled_texture(std::uint64_t seed) {
    Image<RgbaF> pixels(kTextureSide_px, kTextureSide_px, grey(0.5));
    SeededDraws draws(seed, kSpeckles);
    for (int dot = 0; dot < 700; ++dot) {
        const double x = draws.uniform() * kTextureSide_px;
        const double y = draws.uniform() * kTextureSide_px;
        const double radius = draws.uniform(3, 16);
        const double value = draws.uniform(0.08, 0.85);
        const auto from = [](double low) { return std::max(0, static_cast<int>(low)); };
        const auto to = [](double high) { return std::min(kTextureSide_px, static_cast<int>(high) + 1); };
        for (int py = from(y - radius - 3); py < to(y + radius + 3); ++py) {
            for (int px = from(x - radius - 3); px < to(x + radius + 3); ++px) {
                const double share = soft_step((radius - std::hypot(px + 0.5 - x, py + 0.5 - y)) / 1.5);
                RgbaF& p = pixels(px, py);
                p = grey(static_cast<double>(p.r) * (1 - share) + value * share);
            }
        }
    }
    return pixels;
}

Mesh disc_top(const Turntable& turntable) {
    Mesh mesh;
    mesh.name = "disc";
    const auto y = static_cast<float>(turntable.top);
    mesh.positions.push_back({0, y, 0});
    mesh.uvs.push_back({0.5F, 0.5F});
    for (unsigned i = 0; i < kSegments; ++i) {
        const double angle = 2 * kPi * i / kSegments;
        const double x = std::sin(angle), z = std::cos(angle);
        mesh.positions.push_back(
            {static_cast<float>(turntable.radius * x), y, static_cast<float>(turntable.radius * z)});
        mesh.uvs.push_back({static_cast<float>(0.5 + 0.5 * x), static_cast<float>(0.5 - 0.5 * z)});
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % kSegments});
    }
    return mesh;
}

Mesh disc_side(const Turntable& turntable) {
    Mesh mesh;
    mesh.name = "disc side";
    for (unsigned i = 0; i < kSegments; ++i) {
        const double angle = 2 * kPi * i / kSegments;
        const glm::vec3 normal(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
        for (const double height : {turntable.top, turntable.bottom()}) {
            const auto radius = static_cast<float>(turntable.radius);
            mesh.positions.push_back({normal.x * radius, static_cast<float>(height), normal.z * radius});
            mesh.normals.push_back(normal);
        }
        const unsigned a = 2 * i, b = 2 * ((i + 1) % kSegments);
        mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, b + 1}, {a, b + 1, b}});
    }
    return mesh;
}

Mesh board_mesh(const Board& board) {
    Mesh mesh;
    mesh.name = "board";
    for (const glm::dvec3& corner : board.corners) mesh.positions.emplace_back(corner);
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.triangles = {{0, 3, 2}, {0, 2, 1}};  // the outer side is up
    return mesh;
}

}  // namespace

double Turntable::reach() const {
    double farthest = surface == DiscSurface::none ? 0.0 : radius;
    if (board) {
        for (const glm::dvec3& corner : board->corners) farthest = std::max(farthest, std::hypot(corner.x, corner.z));
    }
    return farthest;
}

Turntable fit_turntable(const Scene& object, double object_radius, DiscSurface surface, std::uint64_t seed) {
    Turntable turntable;
    turntable.surface = surface;
    turntable.radius = 1.15 * object_radius;
    turntable.top = ground_height(object) - kHair;
    turntable.thickness = 0.08 * object_radius;
    turntable.seed = seed;
    return turntable;
}

void lay_board(Turntable& turntable, Image<RgbaF> image, double width) {
    SeededDraws draws(turntable.seed, kBoard);
    const double distance = width * draws.uniform(0.06, 0.14);
    const double way = draws.uniform(0, 2 * kPi);
    const double turn = draws.uniform(0, 2 * kPi);
    const double height = width * image.height() / image.width();
    const glm::dvec3 right(std::cos(turn), 0, -std::sin(turn));
    const glm::dvec3 down(std::sin(turn), 0, std::cos(turn));  // of the image: +Z without rotation
    const glm::dvec3 middle(distance * std::sin(way), turntable.top, distance * std::cos(way));
    turntable.top -= kHair;  // between object and disc
    Board board;
    for (RgbaF& p : image.pixels()) p.a = 1;
    board.image = std::move(image);
    const glm::dvec3 u = right * (width / 2), v = down * (height / 2);
    board.corners = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    turntable.board = std::move(board);
}

void add_turntable(Scene& scene, const Turntable& turntable) {
    if (turntable.surface != DiscSurface::none) {
        int texture = -1;
        if (turntable.surface == DiscSurface::rings) texture = add_texture(scene, "rings", ring_texture());
        if (turntable.surface == DiscSurface::speckled) {
            texture = add_texture(scene, "speckles", speckled_texture(turntable.seed));
        }
        Mesh top = disc_top(turntable);
        top.material = add_material(scene, "disc", glm::vec3(texture < 0 ? 0.5F : 1.0F), texture);
        scene.meshes.push_back(std::move(top));
        Mesh side = disc_side(turntable);
        side.material = add_material(scene, "disc side", glm::vec3(0.12F));
        scene.meshes.push_back(std::move(side));
    }
    if (turntable.board) {
        Mesh board = board_mesh(*turntable.board);
        board.material =
            add_material(scene, "board", glm::vec3(1.0F), add_texture(scene, "board", turntable.board->image));
        scene.meshes.push_back(std::move(board));
    }
}

}  // namespace rs::capture
