#include "datasets-synthetic/objects/generators.hpp"

#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using capture::Mesh;
using capture::SurfaceKind;
using glm::vec2;
using glm::vec3;

constexpr int kCorners = 12;
constexpr int kColours = 6;  // opposite pentagons share one

// The icosahedron's corners, opposite ones six apart.
std::array<vec3, kCorners> icosahedron() {
    const float golden = 0.5F * (1.0F + std::sqrt(5.0F));
    std::array<vec3, kCorners> corners{vec3{0, 1, golden},  vec3{0, -1, golden}, vec3{1, golden, 0},
                                       vec3{-1, golden, 0}, vec3{golden, 0, 1},  vec3{golden, 0, -1}};
    for (std::size_t i = 0; i < 6; ++i) {
        corners[i] = glm::normalize(corners[i]);
        corners[i + 6] = -corners[i];
    }
    return corners;
}

bool adjacent(vec3 a, vec3 b) {
    return glm::dot(a, b) > 0.4F && glm::dot(a, b) < 0.5F;
}

// The corner of the truncated icosahedron on the edge from a to b, nearer to a; on the unit sphere.
vec3 cut_corner(vec3 a, vec3 b) {
    return glm::normalize(2.0F * a + b);
}

void append_arc(Mesh& mesh, vec3 from, vec3 to, float sphere_radius, float tube_radius, float v_per_length) {
    constexpr int kSteps = 14;
    std::vector<vec3> path;
    for (int k = 0; k <= kSteps; ++k)
        path.push_back(sphere_radius * glm::normalize(glm::mix(from, to, static_cast<float>(k) / kSteps)));
    append_tube(mesh, path, {&tube_radius, 1}, {.sides = 20, .facing = from, .v_per_length = v_per_length});
}

// Enamel: a barber's-pole spiral of two colours with thin gold lines, chipped a little.
capture::Texture paint_enamel(vec3 colour, vec3 second, std::uint32_t seed) {
    constexpr int kEnamel_px = 256;
    Canvas canvas(kEnamel_px, kEnamel_px, vec3{0.0F});
    canvas.shade({0, 0}, vec2{kEnamel_px}, [&](vec2 p, vec3) {
        const float phase = p.x / kEnamel_px + p.y / kEnamel_px;
        const float t = phase - std::floor(phase);
        const float cloud = layered_noise({p.x / 32.0F, p.y / 32.0F, 0.0F}, 3, seed, kEnamel_px / 32);
        if (std::abs(t - 0.02F) < 0.025F || std::abs(t - 0.38F) < 0.025F) return srgb(0xD9B45A);
        return (t > 0.02F && t < 0.38F ? second : colour) * (1.0F + 0.22F * cloud);
    });
    return std::move(canvas).texture("enamel");
}

// One hue cycle along the knot, with rows of dots and rings.
capture::Texture paint_core(float hue_turns) {
    constexpr int kAround_px = 256;
    constexpr int kAlong_px = 2048;
    constexpr int kRows = 40;
    Canvas canvas(kAround_px, kAlong_px, vec3{0.0F});
    canvas.shade({0, 0}, {kAround_px, kAlong_px},
                 [&](vec2 p, vec3) { return hue_colour(hue_turns + p.y / kAlong_px, 0.74F, 0.88F); });
    for (int row = 0; row < kRows; ++row) {
        const float y = (static_cast<float>(row) + 0.5F) * kAlong_px / kRows;
        if (row % 4 == 3) {
            canvas.band(y - 5.0F, y + 5.0F, {srgb(0x1B2233), 1.0F, 0.0F, 0.0F, 0});
            continue;
        }
        for (int k = 0; k < 6; ++k) {
            const vec2 dot{(static_cast<float>(k) + (row % 2 == 0 ? 0.25F : 0.75F)) * kAround_px / 6.0F, y};
            const float radius_px = row % 4 == 1 ? 9.0F : 6.0F;
            canvas.stroke({&dot, 1}, {&radius_px, 1}, {srgb(0xFFF6E0), 1.0F, 0.0F, 0.0F, 0});
        }
    }
    return std::move(canvas).texture("rainbow");
}

// The (2, windings) torus knot about the Y axis.
std::vector<vec3> knot_path(float radius, int windings) {
    constexpr int kPoints = 480;
    std::vector<vec3> path;
    for (int k = 0; k < kPoints; ++k) {
        const double t = 2.0 * kPi * k / kPoints;
        const auto ring = radius * (1.0F + 0.45F * static_cast<float>(portable::cos(windings * t)));
        path.push_back({ring * static_cast<float>(portable::sin(2.0 * t)),
                        0.62F * radius * static_cast<float>(portable::sin(windings * t)),
                        ring * static_cast<float>(portable::cos(2.0 * t))});
    }
    return path;
}

class LatticeBuilder {
public:
    LatticeBuilder(float strut, float hue, std::uint64_t seed)
        : strut_(strut), hue_(hue), seed_(static_cast<std::uint32_t>(seed)) {
        // A random orientation, so that the axes of symmetry are not aligned with the turntable's axis.
        Random random(seed, 71);
        const vec3 axis = random.direction();
        attitude_ = rotation(axis, random.uniform(0.3F, 2.8F));
        corners_ = icosahedron();
        for (vec3& corner : corners_) corner = attitude_ * corner;
    }

    void append_cages(ObjectAssembly& assembly) {
        std::array<Mesh, kColours> pentagons;
        Mesh bridges;
        Mesh joints;
        Mesh inner;
        for (std::size_t a = 0; a < kCorners; ++a) {
            for (std::size_t b = 0; b < kCorners; ++b) {
                if (a == b || !adjacent(corners_[a], corners_[b])) continue;
                const vec3 here = cut_corner(corners_[a], corners_[b]);
                append_ellipsoid(joints, {frame_facing(here, here, {0, 1, 0}), vec3{1.65F * strut_}}, 24, 14);
                if (a < b) {
                    append_arc(bridges, here, cut_corner(corners_[b], corners_[a]), 1.0F, strut_, 9.0F);
                    append_arc(inner, corners_[a], corners_[b], 0.66F, 0.4F * strut_, 4.0F);
                }
                for (std::size_t c = b + 1; c < kCorners; ++c) {
                    if (adjacent(corners_[a], corners_[c]) && adjacent(corners_[b], corners_[c]))
                        append_arc(pentagons[a % kColours], here, cut_corner(corners_[a], corners_[c]), 1.0F, strut_,
                                   9.0F);
                }
            }
        }
        for (const vec3& corner : corners_)
            append_ellipsoid(inner, {frame_facing(0.66F * corner, corner, {0, 1, 0}), vec3{1.1F * strut_}}, 20, 12);
        for (int k = 0; k < kColours; ++k) {
            constexpr std::array<float, kColours> kHues{0.005F, 0.085F, 0.30F, 0.47F, 0.60F, 0.80F};
            const float turns = hue_ + kHues[static_cast<std::size_t>(k)];
            const vec3 colour = hue_colour(turns, 0.78F, 0.68F);
            const vec3 second = hue_colour(turns + 0.05F, 0.42F, 0.90F);
            add_enamel(assembly, pentagons[static_cast<std::size_t>(k)], "enamel " + std::to_string(k + 1), colour,
                       second, k);
        }
        add_enamel(assembly, bridges, "white enamel", srgb(0xEDE8DC), srgb(0x2B4C7E), kColours);
        add(assembly, joints,
            {.name = "brass joints", .kind = SurfaceKind::metal, .colour = {0.87F, 0.62F, 0.25F}, .roughness = 0.22F});
        add(assembly, inner,
            {.name = "steel wire", .kind = SurfaceKind::metal, .colour = {0.66F, 0.67F, 0.69F}, .roughness = 0.15F});
    }

    void append_core(ObjectAssembly& assembly, float radius, int windings) {
        std::vector<vec3> path = knot_path(radius, windings);
        for (vec3& p : path) p = attitude_ * p;
        Mesh core;
        const float tube = 0.30F * radius;
        append_tube(core, path, {&tube, 1}, {.sides = 40, .closed = true, .v_per_length = 0.01F});  // one repeat
        const int texture = assembly.add_texture(paint_core(hue_));
        add(assembly, core,
            {.name = "painted knot",
             .kind = SurfaceKind::glossy,
             .colour = vec3{1.0F},
             .texture = texture,
             .roughness = 0.18F});
    }

private:
    static void add(ObjectAssembly& assembly, Mesh& mesh, const capture::Material& material) {
        mesh.name = material.name;
        mesh.material = assembly.add_material(material);
        assembly.add_mesh(mesh.name, mesh.material) = std::move(mesh);
    }

    void add_enamel(ObjectAssembly& assembly, Mesh& mesh, const std::string& name, vec3 colour, vec3 second,
                    int number) const {
        const int texture =
            assembly.add_texture(paint_enamel(colour, second, seed_ + static_cast<std::uint32_t>(number)));
        add(assembly, mesh,
            {.name = name, .kind = SurfaceKind::glossy, .colour = vec3{1.0F}, .texture = texture, .roughness = 0.15F});
    }

    float strut_;
    float hue_;
    std::uint32_t seed_;
    glm::mat3 attitude_{1.0F};
    std::array<vec3, kCorners> corners_;
};

}  // namespace

Result<capture::Scene> generate_lattice(const nlohmann::json& parameters, std::uint64_t seed) {
    Parameters in("lattice", parameters);
    const float strut = in.number("strut", 0.032F, 0.015F, 0.06F);
    const float core = in.number("core", 0.30F, 0.15F, 0.4F);
    const int windings = in.whole_number("windings", 3, 2, 5);
    const float hue = in.number("hue", 0.0F, 0.0F, 1.0F);
    RS_TRY(in.finish());
    ObjectAssembly assembly("lattice");
    LatticeBuilder builder(strut, hue, seed);
    builder.append_cages(assembly);
    builder.append_core(assembly, core, windings);
    return std::move(assembly).finish();
}

}  // namespace rs::synthetic
