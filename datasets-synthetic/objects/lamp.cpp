#include "datasets-synthetic/objects/generators.hpp"

#include "datasets-synthetic/objects/object_assembly.hpp"
#include "datasets-synthetic/objects/petal.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/parameters.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using capture::Material;
using capture::Mesh;
using capture::SurfaceKind;
using glm::vec2;
using glm::vec3;

constexpr int kSidesAround = 192;

// Offsets every interior point of a profile to its left by `distance`: the other side of a wall. The end on the axis
// stays on the axis.
std::vector<vec2> inset(const std::vector<vec2>& profile, float distance) {
    std::vector<vec2> moved;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const vec2 along = glm::normalize(profile[std::min(i + 1, profile.size() - 1)] - profile[i == 0 ? 0 : i - 1]);
        vec2 p = profile[i] + distance * vec2{-along.y, along.x};
        if (profile[i].x == 0.0F) p = {0.0F, profile[i].y + distance};
        moved.push_back(p);
    }
    return moved;
}

// A wall between `outside` and its inset, with a round lip at the upper end; from the axis or from the lower rim.
std::vector<vec2> wall(const std::vector<vec2>& outside, float thickness) {
    std::vector<vec2> profile = outside;
    const std::vector<vec2> inside = inset(outside, thickness);
    const vec2 middle = 0.5F * (outside.back() + inside.back());
    const vec2 across = 0.5F * (outside.back() - inside.back());
    const vec2 up{-across.y, across.x};
    for (int k = 1; k < 6; ++k) {
        const float angle_rad = portable::kPiF * static_cast<float>(k) / 6.0F;
        profile.push_back(middle + across * portable::cos(angle_rad) + up * portable::sin(angle_rad));
    }
    profile.insert(profile.end(), inside.rbegin(), inside.rend());
    return profile;
}

std::vector<vec2> font_outside() {
    const std::vector<vec2> controls{{0.0F, 0.70F},  {0.16F, 0.705F}, {0.34F, 0.77F},  {0.455F, 0.92F},
                                     {0.44F, 1.06F}, {0.32F, 1.19F},  {0.20F, 1.255F}, {0.15F, 1.32F}};
    std::vector<vec2> profile = smooth_curve<vec2>(controls, 12);
    profile.front().x = 0.0F;
    return profile;
}

// The oil: the font's inside up to a level, with a flat top.
std::vector<vec2> oil_profile(const std::vector<vec2>& font, float wall_thickness, float fill) {
    constexpr float kGap = 0.003F;
    const std::vector<vec2> inside = inset(font, wall_thickness + kGap);
    const float level = inside.front().y + fill * (1.24F - inside.front().y);
    std::vector<vec2> profile;
    for (const vec2& p : inside) {
        if (p.y > level) break;
        profile.push_back(p);
    }
    // A meniscus: the edge is drawn in over a short curve.
    const vec2 edge = profile.back();
    profile.push_back({edge.x - 0.006F, edge.y + 0.004F});
    profile.push_back({edge.x - 0.020F, edge.y + 0.006F});
    profile.push_back({0.5F * edge.x, edge.y + 0.006F});
    profile.push_back({0.0F, edge.y + 0.006F});
    return profile;
}

void append_font_and_oil(Mesh& glass, Mesh& oil, float fill) {
    constexpr float kThickness = 0.032F;
    const std::vector<vec2> outside = font_outside();
    append_lathe(glass, wall(outside, kThickness), {.segments = kSidesAround, .crease_rad = 3.0F});
    append_lathe(oil, oil_profile(outside, kThickness, fill), {.segments = kSidesAround, .crease_rad = 0.9F});
}

void append_chimney(Mesh& glass) {
    const std::vector<vec2> controls{{0.165F, 1.455F}, {0.175F, 1.50F}, {0.245F, 1.64F},
                                     {0.255F, 1.74F},  {0.19F, 1.93F},  {0.135F, 2.12F},
                                     {0.12F, 2.32F},   {0.135F, 2.50F}, {0.15F, 2.545F}};
    std::vector<vec2> profile = wall(smooth_curve<vec2>(controls, 10), 0.014F);
    profile.push_back(profile.front());  // the lower rim closes the ring
    append_lathe(glass, profile, {.segments = kSidesAround, .crease_rad = 0.9F});
}

void append_stand(Mesh& brushed, Mesh& polished) {
    const std::vector<vec2> foot{{0.0F, 0.15F},   {0.47F, 0.15F}, {0.49F, 0.165F},
                                 {0.49F, 0.195F}, {0.47F, 0.21F}, {0.42F, 0.215F}};
    append_lathe(polished, foot, {.segments = kSidesAround, .crease_rad = 0.9F});
    const std::vector<vec2> ogee{{0.42F, 0.215F}, {0.36F, 0.235F}, {0.25F, 0.275F}, {0.15F, 0.32F}, {0.105F, 0.355F}};
    append_lathe(brushed, smooth_curve<vec2>(ogee, 8), {.segments = kSidesAround});
    const std::vector<vec2> knop{{0.105F, 0.355F}, {0.10F, 0.37F},  {0.135F, 0.39F}, {0.165F, 0.43F},
                                 {0.135F, 0.475F}, {0.085F, 0.49F}, {0.075F, 0.51F}};
    append_lathe(polished, smooth_curve<vec2>(knop, 8), {.segments = kSidesAround});
    const std::vector<vec2> neck{{0.075F, 0.51F}, {0.07F, 0.56F}, {0.085F, 0.62F}, {0.14F, 0.665F}, {0.24F, 0.70F}};
    append_lathe(brushed, smooth_curve<vec2>(neck, 8), {.segments = kSidesAround});
    // The cup encloses the font's belly from below, with a small gap to the glass.
    const std::vector<vec2> cup{{0.24F, 0.70F},   {0.355F, 0.755F}, {0.375F, 0.775F}, {0.368F, 0.782F},
                                {0.345F, 0.763F}, {0.20F, 0.699F},  {0.0F, 0.694F}};
    append_lathe(polished, cup, {.segments = kSidesAround, .crease_rad = 0.9F});
}

void append_burner(Mesh& brushed, Mesh& polished) {
    const std::vector<vec2> collar{{0.156F, 1.275F}, {0.185F, 1.275F}, {0.19F, 1.285F},  {0.19F, 1.315F},
                                   {0.175F, 1.33F},  {0.15F, 1.345F},  {0.15F, 1.375F},  {0.165F, 1.40F},
                                   {0.21F, 1.425F},  {0.215F, 1.44F},  {0.205F, 1.447F}, {0.0F, 1.447F}};
    append_lathe(polished, collar, {.segments = kSidesAround, .crease_rad = 0.7F});
    // Beads around the collar and prongs that hold the chimney.
    constexpr int kBeads = 36;
    for (int k = 0; k < kBeads; ++k) {
        const vec3 centre = portable::around(2.0F * portable::kPiF * static_cast<float>(k) / kBeads, 0.192F, 1.30F);
        append_ellipsoid(polished, {{centre, glm::mat3{1.0F}}, vec3{0.0135F}}, 12, 8);
    }
    constexpr int kProngs = 8;
    for (int k = 0; k < kProngs; ++k) {
        const float angle_rad = 2.0F * portable::kPiF * (static_cast<float>(k) + 0.5F) / kProngs;
        const vec3 out = portable::around(angle_rad, 1.0F, 0.0F);
        PetalShape prong{.length = 0.13F, .width = 0.075F, .base_width = 0.9F, .widest_at = 0.4F, .pointedness = 0.4F};
        prong.curl_rad = 0.55F;
        prong.cup = 0.15F;
        append_petal(brushed,
                     frame_facing(portable::around(angle_rad, 0.205F, 1.435F), vec3{0, 1, 0} - 0.12F * out, -out),
                     prong);
    }
    // The wick's key: a rod with a milled wheel.
    const std::vector<vec3> rod{{0.15F, 1.36F, 0.0F}, {0.33F, 1.36F, 0.0F}};
    const float rod_radius = 0.011F;
    append_tube(polished, rod, {&rod_radius, 1}, {.sides = 16});
    const std::vector<vec3> wheel{
        {0.325F, 1.36F, 0.0F}, {0.331F, 1.36F, 0.0F}, {0.349F, 1.36F, 0.0F}, {0.355F, 1.36F, 0.0F}};
    const std::vector<float> wheel_radii{0.040F, 0.052F, 0.052F, 0.040F};
    append_tube(polished, wheel, wheel_radii, {.sides = 28, .thickness = 1.0F, .rounded_ends = false});
    for (const float x : {0.325F, 0.355F})
        append_ellipsoid(brushed, {{{x, 1.36F, 0.0F}, glm::mat3{1.0F}}, {0.006F, 0.0402F, 0.0402F}}, 32, 16);
}

void append_flame(Mesh& wick, Mesh& flame, bool lit) {
    const std::vector<vec2> wick_profile{
        {0.0F, 1.44F}, {0.022F, 1.44F}, {0.022F, 1.515F}, {0.014F, 1.53F}, {0.0F, 1.532F}};
    append_lathe(wick, wick_profile, {.segments = 24});
    if (!lit) return;
    const std::vector<vec2> teardrop{{0.0F, 1.535F},   {0.024F, 1.545F}, {0.047F, 1.59F}, {0.045F, 1.64F},
                                     {0.026F, 1.715F}, {0.008F, 1.785F}, {0.0F, 1.81F}};
    std::vector<vec2> profile = smooth_curve<vec2>(teardrop, 6);
    for (vec2& p : profile) p.x = std::max(p.x, 0.0F);
    append_lathe(flame, profile, {.segments = 48});
}

struct LampMaterials {
    Material glass{.name = "clear glass",
                   .kind = SurfaceKind::glass,
                   .colour = {0.90F, 0.96F, 0.94F},
                   .ior = 1.5F,
                   .two_sided = false};
    Material oil{.name = "lamp oil", .kind = SurfaceKind::glass, .ior = 1.4F, .two_sided = false};
    Material brushed{.name = "brushed brass", .kind = SurfaceKind::metal, .colour = {0.83F, 0.58F, 0.22F}};
    Material polished{.name = "polished brass", .kind = SurfaceKind::metal, .colour = {0.87F, 0.62F, 0.25F}};
    Material wick{.name = "wick", .colour = {0.35F, 0.31F, 0.26F}};
    Material flame{.name = "flame", .colour = {0.0F, 0.0F, 0.0F}};
};

}  // namespace

// The seed determines the rotation of the feet only.
Result<capture::Scene> generate_lamp(const nlohmann::json& parameters, std::uint64_t seed) {
    Parameters in("lamp", parameters);
    const float hue = in.number("hue", 0.985F, 0.0F, 1.0F);
    const float fill = in.number("fill", 0.62F, 0.1F, 0.9F);
    const float flame_radiance = in.number("flame", 5.0F, 0.0F, 20.0F);
    const float polish = in.number("polish", 0.8F, 0.0F, 1.0F);
    RS_TRY(in.finish());

    Mesh glass;
    Mesh oil;
    Mesh brushed;
    Mesh polished;
    Mesh wick;
    Mesh flame;
    append_font_and_oil(glass, oil, fill);
    append_chimney(glass);
    append_stand(brushed, polished);
    append_burner(brushed, polished);
    append_flame(wick, flame, flame_radiance > 0.0F);
    const float feet_turn_rad = Random(seed, 61).uniform(0.0F, 2.0F * portable::kPiF);
    for (int k = 0; k < 4; ++k) {
        const vec3 centre =
            portable::around(feet_turn_rad + 0.5F * portable::kPiF * static_cast<float>(k), 0.37F, 0.074F);
        append_ellipsoid(glass, {{centre, glm::mat3{1.0F}}, vec3{0.0735F}}, 64, 32);
    }

    LampMaterials materials;
    // Transmittance per unit length, a saturated colour over the font's diameter.
    materials.oil.colour = glm::max(hue_colour(hue, 0.93F, 0.86F), vec3{0.006F});
    materials.brushed.roughness = 0.48F - 0.12F * polish;
    materials.polished.roughness = 0.32F * (1.0F - polish) + 0.02F;
    materials.flame.emission = flame_radiance * vec3{1.0F, 0.62F, 0.22F};
    ObjectAssembly assembly("lamp");
    const auto add = [&](Mesh& mesh, Material& material) {
        mesh.name = material.name;
        mesh.material = assembly.add_material(std::move(material));
        assembly.add_mesh(mesh.name, mesh.material) = std::move(mesh);
    };
    add(glass, materials.glass);
    add(oil, materials.oil);
    add(brushed, materials.brushed);
    add(polished, materials.polished);
    add(wick, materials.wick);
    add(flame, materials.flame);
    return std::move(assembly).finish();
}

}  // namespace rs::synthetic
