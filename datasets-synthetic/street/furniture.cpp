#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <array>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

void lathe(Pen& pen, const std::string& look, std::initializer_list<vec2> profile, vec3 foot = {0, 0, 0}) {
    pen.surface(look, [&](capture::Mesh& mesh) {
        LatheStyle style;
        style.segments = 10;
        append_lathe(mesh, std::span<const vec2>(profile.begin(), profile.size()), style);
        for (vec3& p : mesh.positions) p += foot;
    });
}

// Round disc facing +Z with its texture.
void disc(Pen& pen, const std::string& look, vec3 middle, float radius) {
    pen.surface(look, [&](capture::Mesh& mesh) {
        constexpr unsigned kSegments = 18;
        for (unsigned i = 0; i < kSegments; ++i) {
            const float angle = portable::kTwoPiF * static_cast<float>(i) / kSegments;
            const vec2 out{portable::cos(angle), portable::sin(angle)};
            mesh.positions.push_back(middle + radius * vec3{out, 0});
            mesh.normals.emplace_back(0, 0, 1);
            mesh.uvs.push_back(0.5F + 0.5F * out);
            if (i >= 2) mesh.triangles.emplace_back(0, i - 1, i);
        }
    });
}

// Arm towards +Z, where the street's lights are.
void lamp(World& world) {
    Pen pen(world, "lamp");
    lathe(pen, "pole",
          {{0.13F, -0.05F},
           {0.13F, 0.12F},
           {0.085F, 0.2F},
           {0.08F, 0.85F},
           {0.1F, 0.9F},
           {0.06F, 0.98F},
           {0.052F, 3.6F},
           {0.045F, kLampHeight_m - 0.35F}});
    std::array<vec3, 4> bend{vec3{0, kLampHeight_m - 0.38F, 0},
                             {0, kLampHeight_m, 0.12F},
                             {0, kLampHeight_m + 0.2F, 0.5F},
                             {0, kLampHeight_m + 0.2F, 1.0F}};
    const std::vector<vec3> path = smooth_curve(std::span<const vec3>(bend), 3);
    const float radius = 0.042F;
    SweepStyle style;
    style.sides = 6;
    pen.surface("pole", [&](capture::Mesh& mesh) { append_tube(mesh, path, std::span(&radius, 1), style); });
    const vec3 head{0, kLampHeight_m + 0.16F, 1.2F};
    pen.surface("pole", [&](capture::Mesh& mesh) {
        append_ellipsoid(mesh, {{head, glm::mat3{1.0F}}, {0.17F, 0.075F, 0.4F}}, 10, 6);
    });
    pen.surface("lamp_glass", [&](capture::Mesh& mesh) {
        append_ellipsoid(mesh, {{head - vec3{0, 0.045F, 0}, glm::mat3{1.0F}}, {0.13F, 0.055F, 0.3F}}, 8, 4);
    });
}

void park_bench(World& world) {
    Pen pen(world, "bench");
    for (int i = 0; i < 4; ++i) {
        const float z = -0.18F + 0.125F * static_cast<float>(i);
        pen.box("bench_wood", {-0.85F, 0.44F, z}, {0.85F, 0.475F, z + 0.1F});
    }
    for (int i = 0; i < 3; ++i) {
        const float y = 0.56F + 0.12F * static_cast<float>(i);
        const float z = -0.23F - 0.03F * static_cast<float>(i);
        pen.box("bench_wood", {-0.85F, y, z}, {0.85F, y + 0.095F, z + 0.03F});
    }
    for (const float x : {-0.62F, 0.62F}) {
        pen.box("pole", {x - 0.025F, 0, 0.2F}, {x + 0.025F, 0.44F, 0.26F});
        pen.box("pole", {x - 0.025F, 0, -0.26F}, {x + 0.025F, 0.9F, -0.2F});
        pen.box("pole", {x - 0.025F, 0.38F, -0.2F}, {x + 0.025F, 0.44F, 0.2F});
        pen.box("pole", {x - 0.03F, 0.63F, -0.2F}, {x + 0.03F, 0.665F, 0.24F});
    }
}

void bin(World& world) {
    Pen pen(world, "bin");
    lathe(
        pen, "bin_green",
        {{0, 0.02F}, {0.2F, 0.02F}, {0.235F, 0.1F}, {0.25F, 0.75F}, {0.265F, 0.78F}, {0.265F, 0.82F}, {0.22F, 0.83F}});
    lathe(pen, "tyre_black", {{0.225F, 0.8F}, {0, 0.8F}});
    for (const float angle : {0.8F, 2.4F, 4.0F, 5.6F}) {
        pen.cylinder("bin_green",
                     {.foot = portable::around(angle, 0.22F, 0.8F), .radius = 0.015F, .length = 0.2F, .segments = 5});
    }
    lathe(pen, "bin_green", {{0.27F, 0.98F}, {0.27F, 1.0F}, {0.18F, 1.07F}, {0, 1.1F}});
}

void bollard(World& world) {
    Pen pen(world, "bollard");
    lathe(pen, "pole",
          {{0.09F, 0},
           {0.09F, 0.1F},
           {0.065F, 0.16F},
           {0.06F, 0.75F},
           {0.08F, 0.78F},
           {0.08F, 0.82F},
           {0.06F, 0.86F},
           {0.045F, 0.93F},
           {0, 0.96F}});
}

void sign(World& world) {
    Pen pen(world, "sign");
    pen.cylinder("steel", {.radius = 0.03F, .length = 2.75F, .segments = 8});
    disc(pen, "sign_no_stopping", {0, 2.45F, 0.045F}, 0.3F);
    pen.cylinder("steel",
                 {.foot = {0, 2.45F, 0.015F}, .axis = {0, 0, 1}, .radius = 0.3F, .length = 0.025F, .segments = 18});
}

// Traffic lights with one of three lights on.
void signal(World& world, int lit) {
    Pen pen(world, kSignals.at(static_cast<std::size_t>(lit)));
    pen.cylinder("pole", {.radius = 0.06F, .length = 3.3F, .segments = 10, .end_radius_share = 0.85F});
    pen.box("signal_case", {-0.16F, 2.45F, 0.07F}, {0.16F, 3.35F, 0.27F});
    pen.box("signal_case", {-0.2F, 2.4F, 0.05F}, {0.2F, 3.4F, 0.075F});
    const std::array<const char*, 3> looks{"signal_red", "signal_amber", "signal_green"};
    for (int i = 0; i < 3; ++i) {
        const float y = 3.2F - 0.3F * static_cast<float>(i);
        disc(pen, i == lit ? looks.at(static_cast<std::size_t>(i)) : "signal_off", {0, y, 0.275F}, 0.105F);
        // Hood.
        std::array<vec3, 2> corners{};
        for (int k = 0; k < 6; ++k) {
            for (std::size_t c = 0; c < 2; ++c) {
                const float angle = portable::kPiF * (0.08F + 0.84F * static_cast<float>(k + static_cast<int>(c)) / 6);
                corners.at(c) = {0.12F * portable::cos(angle), y + 0.12F * portable::sin(angle), 0.27F};
            }
            const vec3 out{0, 0, 0.16F};
            pen.quad("signal_case", {corners[0], corners[0] + out, corners[1] + out, corners[1]});
        }
    }
}

vec3 no_stopping(vec2 p) {
    const vec2 c = p - 0.3F;
    const float r = glm::length(c);
    const bool cross = std::min(std::abs(c.x - c.y), std::abs(c.x + c.y)) < 0.045F;
    return r > 0.235F || cross ? srgb(0xB01E22) : srgb(0x1C3F8F);
}

}  // namespace

void add_furniture_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit) {
    builder.look("pole", {.diffuse = 0x2A3230, .specular = 0x505050, .shininess = 0.4F});
    builder.look("steel", {.diffuse = 0x8A8F92, .specular = 0x606060, .shininess = 0.3F});
    builder.look("lamp_glass", {.diffuse = night ? 0xFFE9B8U : 0xE4E6E2U});
    builder.look("bench_wood", {.diffuse = 0x8A5A34, .specular = 0x202020, .shininess = 0.15F});
    builder.look("bin_green", {.diffuse = 0x1F3D30, .specular = 0x404040, .shininess = 0.4F});
    builder.look("tyre_black", {.diffuse = 0x101010});
    builder.look("signal_case", {.diffuse = 0x17191A, .specular = 0x303030, .shininess = 0.3F});
    builder.look("signal_off", {.diffuse = 0x1A1614, .specular = 0x606060, .shininess = 0.6F});
    builder.look("signal_red", {.diffuse = 0xFF3A22});
    builder.look("signal_amber", {.diffuse = 0xFFB020});
    builder.look("signal_green", {.diffuse = 0x2CF08A});
    builder.painted_look("sign_no_stopping", {0.6F, 0.6F}, 200, no_stopping, {.specular = 0x303030, .shininess = 0.3F});
    builder.look("soil", {.diffuse = 0x4A3F33});
    unlit.insert({"signal_red", "signal_amber", "signal_green"});
    if (night) unlit.insert("lamp_glass");
}

void build_furniture(World& world) {
    lamp(world);
    park_bench(world);
    bin(world);
    bollard(world);
    sign(world);
    for (int lit = 0; lit < 3; ++lit) signal(world, lit);
}

}  // namespace rs::synthetic
