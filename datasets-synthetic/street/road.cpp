#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kPiece_m = 12;
constexpr float kFarther_m = 168;  // extent of the main street
constexpr float kCrossFarther_m = 108;

vec3 asphalt(vec2 p, std::uint32_t seed) {
    const float grain = gradient_noise({p * 40.0F, 0.3F}, seed);
    const float patches = layered_noise({p * 0.9F, 0.7F}, 3, seed + 1);
    return vec3(0.085F, 0.086F, 0.09F) * (1 + 0.3F * grain + 0.18F * patches);
}

vec3 with_paint(vec3 ground, vec2 p) {
    return glm::mix(ground, vec3(0.62F), 0.8F + 0.15F * gradient_noise({p * 9.0F, 0.1F}, 5));
}

// Road texture: dashed centre line, continuous edge lines.
vec3 road_image(vec2 p) {
    const vec3 ground = asphalt(p, 21);
    const float from_middle = std::abs(p.y - kHalfRoad_m);
    const bool dash = from_middle < 0.07F && std::fmod(p.x, 6.0F) < 3.0F;
    const bool edge = std::abs(from_middle - 3.72F) < 0.06F;
    return dash || edge ? with_paint(ground, p) : ground;
}

// From the edge of the crossing outwards: zebra crossing, and the stop line of the incoming lane.
vec3 approach_image(vec2 p, bool right_lane) {
    const vec3 ground = asphalt(p, 21);
    const bool zebra = p.x > 0.8F && p.x < 3.8F && std::fmod(p.y + 0.25F, 1.0F) < 0.5F;
    const bool in_lane = right_lane ? p.y < kHalfRoad_m : p.y > kHalfRoad_m;
    const bool stop = p.x > 4.6F && p.x < 5.0F && in_lane && std::abs(p.y - kHalfRoad_m) < 3.6F;
    return zebra || stop ? with_paint(ground, p) : p.x > 5.2F ? road_image(p) : ground;
}

vec3 paving(vec2 p) {
    const vec2 stone = p / 0.5F;
    const vec2 in = stone - glm::floor(stone);
    const auto tone =
        static_cast<float>(lattice_hash(static_cast<int>(stone.x) % 8, static_cast<int>(stone.y) % 8, 0, 4) >> 8U) /
        16777216.0F;
    const bool joint = std::min(in.x, in.y) < 0.035F;
    return joint ? vec3(0.2F) : vec3(0.36F, 0.35F, 0.33F) * (0.85F + 0.3F * tone);
}

// A piece of road from `begin` to `begin + length` along the pen's X, over its whole width.
void road_piece(World& world, const std::string& object, const std::string& look, vec3 origin, float turn_deg,
                float length) {
    Pen pen(world, object);
    pen.set_frame(origin, turn_deg);
    const float half = kHalfRoad_m;
    pen.quad(look, {vec3{0, 0, half}, {length, 0, half}, {length, 0, -half}, {0, 0, -half}},
             {vec2{0, 0}, {length / kPiece_m, 0}, {length / kPiece_m, 1}, {0, 1}});
    for (const float side : {-1.0F, 1.0F}) {
        const float kerb = side * half;
        const float low = std::min(kerb, kerb + side * 0.2F);
        pen.box("kerb", {0, -0.05F, low}, {length, kKerb_m, low + 0.2F});
        const float inner = kerb + side * 0.2F;
        const float outer = side * kHalfStreet_m;
        const float near = std::max(inner, outer);
        const float far = std::min(inner, outer);
        const float y = kKerb_m;
        pen.quad("paving", {vec3{0, y, near}, {length, y, near}, {length, y, far}, {0, y, far}},
                 {vec2{0, 0}, vec2{length, 0} / 4.0F, vec2{length, near - far} / 4.0F, vec2{0, near - far} / 4.0F});
    }
}

// Both directions of a street, from the crossing outwards.
void arm(World& world, const std::string& name, float turn_deg, float reach) {
    Pen turned(world, name);
    turned.set_frame({0, 0, 0}, turn_deg);
    int piece = 0;
    for (float at = kHalfStreet_m; at < reach; at += kPiece_m, ++piece) {
        const float length = std::min(kPiece_m, reach - at);
        road_piece(world, name + "_" + std::to_string(piece), piece == 0 ? "road_approach" : "road",
                   turned.point({at, 0, 0}), turn_deg, length);
    }
}

}  // namespace

void add_road_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit) {
    const vec2 piece{kPiece_m, 2 * kHalfRoad_m};
    builder.painted_look("road", piece, 40, road_image, {.specular = 0x181818, .shininess = 0.08F});
    // As seen along the pen's X, vehicles approach the crossing in the left lane.
    builder.painted_look("road_approach", piece, 40, [](vec2 p) { return approach_image(p, false); },
                         {.specular = 0x181818, .shininess = 0.08F});
    builder.painted_look("crossing", {14, 14}, 24, [](vec2 p) { return asphalt(p, 22); },
                         {.specular = 0x181818, .shininess = 0.08F});
    builder.painted_look("paving", {4, 4}, 64, paving);
    builder.painted_look("grass", {8, 8}, 24, [](vec2 p) {
        return vec3(0.07F, 0.115F, 0.035F) * (1 + 0.35F * layered_noise({p * 2.2F, 0.2F}, 4, 9));
    });
    builder.painted_look("leaves", {1, 1}, 96, [](vec2 p) {
        const float n = layered_noise({p * 14.0F, 0.4F}, 3, 31);
        return glm::mix(vec3(0.025F, 0.06F, 0.012F), vec3(0.12F, 0.2F, 0.04F), 0.5F + 0.8F * n);
    });
    builder.look("bark", {.diffuse = 0x4E3D2E});
    builder.look("kerb", {.diffuse = 0xA6A39B});
    builder.look("pole", {.diffuse = 0x3A403F, .specular = 0x404040, .shininess = 0.3F});
    builder.look("lamp_glass", {.diffuse = night ? 0xFFE9B8U : 0xE4E6E2U});
    if (night) unlit.insert("lamp_glass");
}

void build_roads(World& world) {
    Pen pen(world, "crossing");
    const float h = kHalfStreet_m;
    pen.quad("crossing", {vec3{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}});
    // Corners of the pavement.
    for (const float sx : {-1.0F, 1.0F}) {
        for (const float sz : {-1.0F, 1.0F}) {
            const vec2 low{std::min(sx * kHalfRoad_m, sx * h), std::min(sz * kHalfRoad_m, sz * h)};
            pen.box("paving", {low.x, -0.05F, low.y}, {low.x + h - kHalfRoad_m, kKerb_m, low.y + h - kHalfRoad_m}, 4);
        }
    }
    arm(world, "road_east", 0, kFarther_m);
    arm(world, "road_west", 180, kFarther_m);
    arm(world, "road_north", 90, kCrossFarther_m);
    arm(world, "road_south", -90, kCrossFarther_m);
    Pen ground(world, "ground");
    const float far = 420;
    ground.quad("grass", {vec3{-far, -0.06F, far}, {far, -0.06F, far}, {far, -0.06F, -far}, {-far, -0.06F, -far}},
                {vec2{0, 0}, {105, 0}, {105, 105}, {0, 105}});
}

void build_street_furniture(World& world) {
    for (int kind = 0; kind < 2; ++kind) {
        Pen tree(world, "tree_" + std::to_string(kind));
        const float height = kind == 0 ? 3.0F : 2.5F;
        tree.cylinder("bark", {.radius = 0.17F, .length = height, .segments = 7, .end_radius_share = 0.65F});
        Random random(7, static_cast<std::uint64_t>(kind));
        const int crowns = kind == 0 ? 3 : 2;
        for (int i = 0; i < crowns; ++i) {
            const float x = random.uniform(-0.55F, 0.55F);
            const float z = random.uniform(-0.55F, 0.55F);
            const float y = height + 0.9F + 0.75F * static_cast<float>(i);
            const float r = (kind == 0 ? 1.75F : 1.6F) - 0.35F * static_cast<float>(i);
            tree.crown("leaves", {x, y, z}, {r, 0.85F * r, r}, 9, 6, static_cast<std::uint32_t>(50 + 10 * kind + i));
        }
    }
    Pen bush(world, "bush");
    bush.crown("leaves", {0, 1.4F, 0}, {2.6F, 2.0F, 2.2F}, 7, 4, 77);
    Pen lamp(world, "lamp");
    lamp.cylinder("pole", {.radius = 0.1F, .length = 0.7F, .end_radius_share = 0.75F});
    lamp.cylinder("pole",
                  {.foot = {0, 0.7F, 0}, .radius = 0.065F, .length = kLampHeight_m - 0.6F, .end_radius_share = 0.8F});
    lamp.box("pole", {-0.04F, kLampHeight_m, -0.05F}, {0.04F, kLampHeight_m + 0.09F, 1.3F});
    lamp.box("pole", {-0.17F, kLampHeight_m + 0.02F, 0.85F}, {0.17F, kLampHeight_m + 0.15F, 1.55F});
    lamp.box("lamp_glass", {-0.13F, kLampHeight_m - 0.05F, 0.92F}, {0.13F, kLampHeight_m + 0.03F, 1.48F});
}

}  // namespace rs::synthetic
