#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/street/surface_patterns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kPiece_m = 12;
constexpr float kFarther_m = 168;  // extent of the main street
constexpr float kCrossFarther_m = 108;

// Asphalt that repeats after kPiece_m along x: stones, wheel tracks at `tracks_y`, cracks, repaired places.
vec3 asphalt(vec2 p, std::uint32_t seed, std::span<const float> tracks_y) {
    const auto noise = [&](float per_m, int octaves, std::uint32_t more) {
        return layered_noise({p * per_m, 0.3F}, octaves, seed + more, static_cast<int>(kPiece_m * per_m));
    };
    const float stone = hash_share(static_cast<int>(p.x * 70), static_cast<int>(p.y * 70), seed);
    float tone = 1 + 0.5F * noise(30, 2, 0) + 0.35F * noise(1, 4, 9);
    if (stone > 0.93F) tone *= 1.5F;
    for (const float y : tracks_y) {
        const float off = std::abs(p.y - y);
        tone *= 1 - 0.16F * smooth_step(0.35F, 0.1F, std::abs(off - 0.75F));
        if (off < 0.28F) tone *= 1 - 0.22F * smooth_step(0.28F, 0, off) * (0.6F + noise(2, 2, 21));  // oil
    }
    // Repaired places: rectangles with sealed joints.
    const vec2 cell = p / vec2{3, 2.7F};
    const float chance = hash_share(static_cast<int>(cell.x) % 4, static_cast<int>(cell.y), seed + 5);
    const vec2 in = (cell - glm::floor(cell)) * vec2{3, 2.7F} - vec2{0.4F, 0.5F};
    const float inside = std::min({in.x, in.y, 2.1F - in.x, 1.3F - in.y});
    if (chance < 0.22F && inside > 0) tone *= inside < 0.03F ? 0.45F : 0.74F;
    const float crack = std::abs(noise(1, 4, 33));
    if (crack < 0.006F && noise(1, 1, 41) > 0.05F) tone *= 0.5F;
    return vec3(0.098F, 0.097F, 0.096F) * tone;
}

// Road paint, worn where the stones stand out.
vec3 with_paint(vec3 ground, vec2 p) {
    const float wear = layered_noise({p * 7.0F, 0.1F}, 4, 5) + 0.5F * layered_noise({p * 1.1F, 0.6F}, 2, 6);
    return glm::mix(ground, vec3(0.58F), 0.9F * smooth_step(0.3F, -0.05F, wear));
}

// Two courses of setts beside the kerbs.
bool is_gutter(float from_middle) {
    return from_middle > kHalfRoad_m - 0.3F;
}

vec3 gutter(vec2 p) {
    const float from_edge = std::min(p.y, 2 * kHalfRoad_m - p.y);
    return block_colour({p.x, from_edge}, {0.2F, 0.15F}, 0.014F, vec3(0.17F, 0.165F, 0.155F), 0.25F, 51);
}

bool is_manhole(vec2 p, vec2 middle, vec3& colour) {
    const float r = glm::distance(p, middle);
    if (r > 0.36F) return false;
    const vec2 in = glm::fract((p - middle) / 0.09F);
    const bool stud = in.x > 0.25F && in.y > 0.25F;
    colour = vec3(0.06F, 0.055F, 0.05F) * (r > 0.3F ? (r > 0.325F && r < 0.345F ? 0.4F : 1.3F) : stud ? 1.5F : 0.8F);
    return true;
}

constexpr std::array<float, 2> kTracks_y{kHalfRoad_m - 2, kHalfRoad_m + 2};

// Road texture: dashed centre line, gutters.
vec3 road_image(vec2 p) {
    const float from_middle = std::abs(p.y - kHalfRoad_m);
    if (is_gutter(from_middle)) return gutter(p);
    vec3 iron;
    if (is_manhole(p, {4.3F, 1.6F}, iron)) return iron;
    const vec3 ground = asphalt(p, 21, kTracks_y);
    const bool dash = from_middle < 0.06F && std::fmod(p.x, 6.0F) < 3.0F;
    return dash ? with_paint(ground, p) : ground;
}

// From the edge of the crossing outwards: zebra crossing, and the stop line of the incoming lane.
vec3 approach_image(vec2 p, bool right_lane) {
    const vec3 road = p.x > 5.2F ? road_image(p) : asphalt(p, 21, kTracks_y);
    if (is_gutter(std::abs(p.y - kHalfRoad_m))) return gutter(p);
    const bool zebra = p.x > 0.8F && p.x < 3.8F && std::fmod(p.y + 0.25F, 1.0F) < 0.5F;
    const bool in_lane = right_lane ? p.y < kHalfRoad_m : p.y > kHalfRoad_m;
    const bool stop = p.x > 4.6F && p.x < 5.0F && in_lane && std::abs(p.y - kHalfRoad_m) < 3.6F;
    return zebra || stop ? with_paint(road, p) : road;
}

vec3 paving(vec2 p) {
    const vec3 slab = block_colour(p, {0.5F, 0.5F}, 0.012F, vec3(0.37F, 0.36F, 0.335F), 0.14F, 4);
    const float dirt = tiling_noise(p, 4, 1, 5, 44);
    const vec2 cell = p / 0.4F;
    const float spot = hash_share(static_cast<int>(cell.x), static_cast<int>(cell.y), 45);
    const vec2 in = glm::fract(cell) - vec2{0.3F + 0.4F * spot, 0.5F};
    const bool gum = spot > 0.8F && glm::length(in) < 0.06F;
    return slab * (1 + 0.38F * dirt) * (gum ? 0.55F : 1.0F);
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
        pen.box("kerb", {0, -0.05F, low}, {length, kKerb_m, low + 0.2F}, 4);
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

void add_road_looks(RoomBuilder& builder) {
    const vec2 piece{kPiece_m, 2 * kHalfRoad_m};
    const Look tar{.specular = 0x202020, .shininess = 0.06F};
    builder.painted_look("road", piece, 90, road_image, tar);
    // As seen along the pen's X, vehicles approach the crossing in the left lane.
    builder.painted_look(
        "road_approach", piece, 90, [](vec2 p) { return approach_image(p, false); }, tar);
    builder.painted_look(
        "crossing", {14, 14}, 64, [](vec2 p) { return asphalt(p, 22, {}); }, tar);
    builder.painted_look("paving", {4, 4}, 128, paving);
    builder.painted_look("kerb", {4, 4}, 32, [](vec2 p) {
        return block_colour(p, {1, 4}, 0.02F, vec3(0.36F, 0.35F, 0.33F), 0.15F, 47);
    });
    builder.painted_look("grass", {8, 8}, 48, [](vec2 p) {
        const float patches = tiling_noise(p, 8, 1, 4, 9);
        const float blades = tiling_noise(p, 8, 12, 2, 10);
        return glm::mix(vec3(0.05F, 0.1F, 0.025F), vec3(0.12F, 0.15F, 0.045F), 0.5F + patches) * (1 + 0.7F * blades);
    });
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

}  // namespace rs::synthetic
