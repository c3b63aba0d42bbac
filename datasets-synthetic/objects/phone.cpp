#include "datasets-synthetic/objects/generators.hpp"

#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kLogoWidth_px = 512;
constexpr int kLogoHeight_px = 1024;

// A slab in its own frame: a rectangle with rounded corners in x and y, extruded along z, with rounded edges.
struct Slab {
    Frame frame;
    vec3 half_size;
    float corner_radius;  // of the rectangle
    float edge_radius;    // between the faces and the sides; at most half_size.z
};

// A point of a cross-section through a slab's edge.
struct EdgePoint {
    float inset;  // distance inwards from the contour; 1 or more: the middle of a face
    float z;
    float sideways, along_z;  // normal relative to the contour's
};

// Contour points, counter-clockwise seen from +z, with their normals.
std::vector<std::pair<vec2, vec2>> contour(const Slab& slab) {
    constexpr int kStepsPerCorner = 10;
    const vec2 core = vec2{slab.half_size} - slab.corner_radius;
    std::vector<std::pair<vec2, vec2>> points;
    for (int corner = 0; corner < 4; ++corner) {
        const vec2 middle{corner == 0 || corner == 3 ? core.x : -core.x, corner < 2 ? core.y : -core.y};
        for (int step = 0; step <= kStepsPerCorner; ++step) {
            const float quarter = static_cast<float>(corner) + static_cast<float>(step) / kStepsPerCorner;
            const float angle_rad = 0.25F * portable::kTwoPiF * quarter;
            const vec2 normal{portable::cos(angle_rad), portable::sin(angle_rad)};
            points.emplace_back(middle + slab.corner_radius * normal, normal);
        }
    }
    points.push_back(points.front());
    return points;
}

// Sweeps a cross-section, from the back (-z) to the front, around the slab's contour. Texture coordinates are x and y
// of the slab's rectangle, mirrored in x so that they are upright on the back.
void append_section(capture::Mesh& mesh, const Slab& slab, std::span<const EdgePoint> section) {
    const std::vector<std::pair<vec2, vec2>> around = contour(slab);
    Grid grid(static_cast<int>(around.size()) - 1, static_cast<int>(section.size()) - 1, true);
    grid.normals.resize(grid.positions.size());
    for (int j = 0; j <= grid.rows; ++j) {
        const EdgePoint& edge = section[static_cast<std::size_t>(j)];
        for (int i = 0; i <= grid.columns; ++i) {
            const auto& [place, normal] = around[static_cast<std::size_t>(i)];
            const vec2 xy = edge.inset >= 1.0F ? vec2{0.0F} : place - edge.inset * normal;
            const std::size_t k = grid.index(i, j);
            grid.positions[k] = slab.frame.point({xy, edge.z});
            grid.normals[k] = slab.frame.direction({edge.sideways * normal, edge.along_z});
            grid.uvs[k] = {0.5F - 0.5F * xy.x / slab.half_size.x, 0.5F + 0.5F * xy.y / slab.half_size.y};
        }
    }
    append_grid(mesh, std::move(grid));
}

void append_back(capture::Mesh& mesh, const Slab& slab) {
    const float z = -slab.half_size.z;
    append_section(mesh, slab, std::vector<EdgePoint>{{1.0F, z, 0.0F, -1.0F}, {slab.edge_radius, z, 0.0F, -1.0F}});
}

void append_front(capture::Mesh& mesh, const Slab& slab) {
    const float z = slab.half_size.z;
    append_section(mesh, slab, std::vector<EdgePoint>{{slab.edge_radius, z, 0.0F, 1.0F}, {1.0F, z, 0.0F, 1.0F}});
}

void append_sides(capture::Mesh& mesh, const Slab& slab) {
    constexpr int kSteps = 6;
    std::vector<EdgePoint> section;
    const float core = slab.half_size.z - slab.edge_radius;
    for (const float side : {-1.0F, 1.0F}) {
        for (int step = 0; step <= kSteps; ++step) {
            if (core <= 0.0F && side > 0.0F && step == 0) continue;  // the two quarter circles meet
            const float part = static_cast<float>(side < 0.0F ? kSteps - step : step) / kSteps;
            const float angle_rad = 0.25F * portable::kTwoPiF * part;
            const float sideways = portable::cos(angle_rad);
            const float along_z = side * portable::sin(angle_rad);
            section.push_back(
                {slab.edge_radius * (1.0F - sideways), side * core + slab.edge_radius * along_z, sideways, along_z});
        }
    }
    append_section(mesh, slab, section);
}

void append_slab(capture::Mesh& mesh, const Slab& slab) {
    append_back(mesh, slab);
    append_sides(mesh, slab);
    append_front(mesh, slab);
}

// A plain colour with a ring and a word.
capture::Texture paint_logo(const std::string& text, std::uint64_t seed) {
    Random random(seed, 57);
    Canvas canvas(kLogoWidth_px, kLogoHeight_px, srgb(0xB9BDC4));
    const Ink ink{srgb(0x33363C), 0.95F, 0.1F, 0.0F, random.next()};
    constexpr int kRingSteps = 48;
    std::vector<vec2> ring;
    for (int step = 0; step <= kRingSteps; ++step) {
        const float angle_rad = portable::kTwoPiF * static_cast<float>(step) / kRingSteps;
        ring.push_back(vec2{256.0F, 600.0F} + 62.0F * vec2{portable::cos(angle_rad), portable::sin(angle_rad)});
    }
    const float ring_px = 14.0F;
    canvas.stroke(ring, {&ring_px, 1}, ink);
    constexpr float kLetter_px = 52.0F;
    constexpr float kSpace_px = 12.0F;
    float width_px = -kSpace_px;
    for (const char letter : text) width_px += kLetter_px * pen_letter(letter).width + kSpace_px;
    vec2 corner_px{0.5F * (static_cast<float>(kLogoWidth_px) - width_px), 420.0F};
    const float pen_px = 5.0F;
    for (const char which : text) {
        const Letter letter = pen_letter(which);
        for (const std::vector<vec2>& stroke : letter.strokes) {
            std::vector<vec2> path;
            for (const vec2& p : stroke) path.push_back(corner_px + kLetter_px * p);
            canvas.stroke(path, {&pen_px, 1}, ink);
        }
        corner_px.x += kLetter_px * letter.width + kSpace_px;
    }
    return std::move(canvas).texture("logo");
}

}  // namespace

Result<capture::Scene> generate_phone(const nlohmann::json& parameters, std::uint64_t seed) {
    Parameters in("phone", parameters);
    const std::string text = in.letters("text", "RAYSPACE", 8);
    const float lean_rad = in.number("lean", 0.2F, 0.0F, 0.35F);
    const float gloss = in.number("gloss", 0.3F, 0.05F, 0.6F);
    RS_TRY(in.finish());

    ObjectAssembly assembly("phone");
    const int logo = assembly.add_texture(paint_logo(text, seed));
    const auto material = [&](const char* name, capture::SurfaceKind kind, vec3 colour, float roughness, int texture) {
        return assembly.add_material({.name = name,
                                      .kind = kind,
                                      .colour = colour,
                                      .texture = texture,
                                      .roughness = roughness,
                                      .two_sided = false});
    };
    const int glass = material("screen", capture::SurfaceKind::glossy, vec3{0.012F}, 0.03F, -1);
    const int lacquer = material("lacquer", capture::SurfaceKind::glossy, vec3{1.0F}, gloss, logo);
    const int metal = material("metal", capture::SurfaceKind::metal, vec3{0.62F, 0.61F, 0.6F}, 0.3F, -1);

    constexpr float kDockHalfHeight = 0.07F;
    constexpr vec3 kPhoneHalf{0.37F, 0.76F, 0.045F};
    const Frame leaning{{0.0F, kDockHalfHeight + kPhoneHalf.y * portable::cos(lean_rad) - 0.01F, -0.02F},
                        rotation({1, 0, 0}, -lean_rad)};
    const Slab body{leaning, kPhoneHalf, 0.1F, 0.03F};
    append_sides(assembly.add_mesh("frame", metal), body);
    append_front(assembly.add_mesh("screen", glass), body);
    append_back(assembly.add_mesh("back", lacquer), body);
    const Frame on_back{leaning.point({0.2F, 0.58F, -0.055F}), leaning.axes};
    append_slab(assembly.add_mesh("cameras", glass), {on_back, {0.11F, 0.11F, 0.02F}, 0.04F, 0.01F});
    const Frame lying{vec3{0.0F}, rotation({1, 0, 0}, -0.25F * portable::kTwoPiF)};
    append_slab(assembly.add_mesh("dock", metal), {lying, {0.34F, 0.28F, kDockHalfHeight}, 0.12F, 0.03F});
    return std::move(assembly).finish();
}

}  // namespace rs::synthetic
