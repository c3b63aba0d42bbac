#include "tests/bench/scenes/cabin_pieces.hpp"

#include "tests/bench/scenes/group_builder.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr CabinMaterials kCabinPiece;
constexpr float kTubeRadius_m = 1.85F;
constexpr float kTubeMiddle_m = 0.75F;

vec3 on_wall(float x, float height) {
    return {x, height, cabin_half_width(height)};
}

// Closed path around a rectangle with rounded corners, in the plane z = const.
std::vector<vec3> piping(vec3 low, vec3 high, int points) {
    std::vector<vec3> path;
    const vec3 middle = 0.5F * (low + high), half = 0.5F * (high - low);
    for (int i = 0; i <= points; ++i) {
        const float turn = portable::kTwoPiF * static_cast<float>(i) / static_cast<float>(points);
        const auto soft = [](float v) { return std::copysign(std::sqrt(std::abs(v)), v); };
        path.emplace_back(middle + half * vec3(soft(portable::cos(turn)), soft(portable::sin(turn)), 0));
    }
    return path;
}

// Point on the border of the unit square at step i of 4 * side, counter-clockwise from the lower left corner.
vec2 on_edge(int i, int side) {
    const float along = static_cast<float>(i % side) / static_cast<float>(side);
    switch ((i / side) % 4) {
        case 0:
            return {along, 0};
        case 1:
            return {1, along};
        case 2:
            return {1 - along, 1};
        default:
            return {0, 1 - along};
    }
}

}  // namespace

std::vector<ModelMaterial> cabin_materials() {
    return {{"panel", {0.72F, 0.71F, 0.68F}, 0.6F},   {"fabric", {0.05F, 0.09F, 0.2F}, 0.95F},
            {"leather", {0.28F, 0.16F, 0.09F}, 0.5F}, {"grey", {0.38F, 0.39F, 0.4F}, 0.5F},
            {"metal", {0.5F, 0.5F, 0.52F}, 0.35F},    {"carpet", {0.09F, 0.1F, 0.14F}, 0.95F},
            {"aisle", {0.16F, 0.15F, 0.17F}, 0.95F},  {"curtain", {0.3F, 0.06F, 0.08F}, 0.9F},
            {"dark", {0.03F, 0.03F, 0.035F}, 0.4F},   {"blanket", {0.55F, 0.4F, 0.2F}, 0.95F}};
}

float cabin_half_width(float height_m) {
    const float above = height_m - kTubeMiddle_m;
    return std::sqrt(kTubeRadius_m * kTubeRadius_m - above * above);
}

ModelGroup cabin_seat() {
    GroupBuilder seat("seat");
    seat.cushion(kCabinPiece.fabric, {-0.215F, 0.36F, -0.2F}, {0.215F, 0.5F, 0.26F}, 1, 60, 30);
    seat.cushion(kCabinPiece.fabric, {-0.215F, 0.46F, -0.3F}, {0.215F, 1.06F, -0.15F}, 1, 60, 30);
    seat.cushion(kCabinPiece.leather, {-0.17F, 0.96F, -0.27F}, {0.17F, 1.18F, -0.13F}, 1, 48, 24);
    seat.cushion(kCabinPiece.grey, {-0.22F, 0.42F, -0.335F}, {0.22F, 1.1F, -0.255F}, 2, 32, 16);
    for (const float side : {-1.0F, 1.0F}) {
        seat.cushion(kCabinPiece.grey, {side * 0.225F - 0.022F, 0.6F, -0.22F}, {side * 0.225F + 0.022F, 0.645F, 0.2F},
                     1, 32, 16);
        seat.box(kCabinPiece.metal, {side * 0.225F - 0.01F, 0.34F, -0.2F}, {side * 0.225F + 0.01F, 0.61F, -0.14F});
        const vec3 leg[] = {{side * 0.15F, 0, 0.16F}, {side * 0.15F, 0.2F, 0.08F}, {side * 0.15F, 0.37F, 0.04F}};
        seat.tube(kCabinPiece.metal, leg, 0.016F, 8);
        const vec3 back_leg[] = {{side * 0.15F, 0, -0.2F}, {side * 0.15F, 0.37F, -0.1F}};
        seat.tube(kCabinPiece.metal, back_leg, 0.016F, 8);
        const vec3 belt[] = {
            {side * 0.2F, 0.46F, -0.16F}, {side * 0.14F, 0.51F, -0.02F}, {side * 0.03F, 0.515F, 0.06F}};
        seat.tube(kCabinPiece.dark, belt, 0.012F, 8);
    }
    seat.box(kCabinPiece.metal, {-0.03F, 0.5F, 0.04F}, {0.03F, 0.522F, 0.09F});
    seat.tube(kCabinPiece.leather, piping({-0.2F, 0.52F, -0.165F}, {0.2F, 0.95F, -0.165F}, 36), 0.006F, 6);
    // On the back: a folded table, a pocket with a card, a screen.
    seat.box(kCabinPiece.grey, {-0.19F, 0.66F, -0.355F}, {0.19F, 0.9F, -0.335F});
    seat.box(kCabinPiece.dark, {-0.03F, 0.9F, -0.35F}, {0.03F, 0.915F, -0.335F});
    seat.cushion(kCabinPiece.fabric, {-0.18F, 0.42F, -0.37F}, {0.18F, 0.64F, -0.32F}, 2, 16, 10);
    seat.box(kCabinPiece.blanket, {-0.1F, 0.5F, -0.352F}, {0.08F, 0.68F, -0.348F});
    seat.box(kCabinPiece.dark, {-0.1F, 0.93F, -0.345F}, {0.1F, 1.06F, -0.33F});
    return seat.take();
}

ModelGroup cabin_window(bool shade_down) {
    GroupBuilder window("window");
    constexpr int kSide = 12, kRings = 6;
    constexpr float kLow = 0.03F, kMiddle = 1.02F;
    constexpr vec2 kHalf{0.125F, 0.185F};
    // From the border inwards to the opening. The wall faces -Z, so that the loop goes to the right as seen from there.
    Grid wall(4 * kSide, kRings, true);
    std::vector<vec3> opening;
    for (int column = 0; column <= wall.columns; ++column) {
        const vec2 edge = on_edge(column % wall.columns, kSide);
        const vec2 outer{kWindowPitch_m * edge.x, kLow + (kWallTop_m - kLow) * edge.y};
        const vec2 away = outer - vec2(0.5F * kWindowPitch_m, kMiddle);
        const vec2 unit = away / kHalf;
        const vec2 squared = unit * unit;
        const float reach = std::sqrt(std::sqrt(squared.x * squared.x + squared.y * squared.y));
        const vec2 inner = vec2(0.5F * kWindowPitch_m, kMiddle) + away / reach;
        for (int row = 0; row <= kRings; ++row) {
            const vec2 p = glm::mix(inner, outer, static_cast<float>(row) / kRings);
            wall.positions[wall.index(column, row)] = on_wall(p.x, p.y);
            wall.uvs[wall.index(column, row)] = p;
        }
        opening.push_back(on_wall(inner.x, inner.y));
    }
    window.surface(kCabinPiece.panel, std::move(wall));
    // The reveal widens towards the inside.
    std::vector<vec3> outside;
    for (const vec3& p : opening) {
        const vec3 middle = on_wall(0.5F * kWindowPitch_m, kMiddle);
        outside.push_back(middle + 0.86F * (p - middle) + vec3(0, 0, 0.07F));
    }
    window.strip(kCabinPiece.panel, outside, opening);
    window.tube(kCabinPiece.grey, opening, 0.01F, 6);
    if (shade_down) {
        window.box(kCabinPiece.panel, {0.5F * kWindowPitch_m - kHalf.x, 0.95F, cabin_half_width(1.0F) + 0.03F},
                   {0.5F * kWindowPitch_m + kHalf.x, kMiddle + kHalf.y, cabin_half_width(1.0F) + 0.036F});
    }
    // Dado below the window.
    window.box(kCabinPiece.grey, {0, 0.03F, cabin_half_width(0.1F) - 0.03F},
               {kWindowPitch_m, 0.25F, cabin_half_width(0.1F)});
    return window.take();
}

ModelGroup cabin_bin() {
    GroupBuilder bin("bin");
    constexpr int kAlong = 16;
    // (z, height) from the wall over the underside and the lid to the ceiling.
    std::vector<vec2> profile{{1.66F, 1.55F}, {1.5F, 1.56F}, {1.2F, 1.58F}, {0.98F, 1.6F}};
    for (int i = 1; i < 12; ++i) {
        const float turn = portable::kPiF * static_cast<float>(i) / 24;
        profile.emplace_back(0.92F - 0.14F * portable::sin(turn) * 1.9F - 0.02F * static_cast<float>(i) * 0.3F,
                             1.62F + 0.54F * static_cast<float>(i) / 12);
    }
    profile.insert(profile.end(), {{0.66F, 2.16F}, {0.72F, 2.2F}, {0.78F, 2.21F}});
    Grid shell(kAlong, static_cast<int>(profile.size()) - 1);
    for (int row = 0; row <= shell.rows; ++row) {
        for (int column = 0; column <= kAlong; ++column) {
            const float share = static_cast<float>(column) / kAlong;
            const vec2 p = profile[static_cast<std::size_t>(row)];
            // Groove at the ends of the lids.
            const float groove = (column == 0 || column == kAlong) && row > 4 && row < shell.rows - 3 ? 0.015F : 0.0F;
            shell.positions[shell.index(column, row)] = {kBinLength_m * share, p.y, p.x + groove};
            shell.uvs[shell.index(column, row)] = {share, p.y};
        }
    }
    bin.surface(kCabinPiece.panel, std::move(shell));
    bin.cushion(kCabinPiece.metal, {0.47F, 1.69F, 0.82F}, {0.59F, 1.73F, 0.86F}, 1, 24, 12);
    const std::vector<vec3> rail{
        {0, 1.585F, 0.955F}, {0.5F * kBinLength_m, 1.585F, 0.955F}, {kBinLength_m, 1.585F, 0.955F}};
    bin.tube(kCabinPiece.grey, rail, 0.018F, 10);
    return bin.take();
}

ModelGroup service_panel() {
    GroupBuilder panel("service panel");
    panel.cushion(kCabinPiece.grey, {-0.11F, 1.53F, 0.98F}, {0.11F, 1.58F, 1.5F}, 2, 24, 12);
    for (int seat = 0; seat < 3; ++seat) {
        const float z = 1.08F + 0.15F * static_cast<float>(seat);
        panel.lathe(kCabinPiece.metal, {-0.05F, 1.5F, z},
                    {{0, 0}, {0.018F, 0.004F}, {0.026F, 0.02F}, {0.028F, 0.04F}, {0, 0.04F}}, 16);
        panel.lathe(kCabinPiece.dark, {0.05F, 1.51F, z},
                    {{0, 0}, {0.016F, 0}, {0.02F, 0.015F}, {0.02F, 0.03F}, {0, 0.03F}}, 16);
    }
    return panel.take();
}

ModelGroup curtain(std::int64_t fringe_triangles) {
    GroupBuilder cloth("curtain");
    constexpr int kFolds = 9, kAcross = kFolds * 12, kUp = 12;
    constexpr float kInner = 0.32F, kOuter = 1.6F, kLow = 0.16F, kHigh = 1.52F;
    Grid folds(kAcross, kUp);
    for (int row = 0; row <= kUp; ++row) {
        const float up = static_cast<float>(row) / kUp;
        for (int column = 0; column <= kAcross; ++column) {
            const float share = static_cast<float>(column) / kAcross;
            const float wave = portable::sin(portable::kTwoPiF * kFolds * share + 0.8F * up);
            folds.positions[folds.index(column, row)] = {
                0.045F * wave * (1.15F - 0.3F * up), kLow + (kHigh - kLow) * up, kInner + (kOuter - kInner) * share};
            folds.uvs[folds.index(column, row)] = {share, up};
        }
    }
    cloth.surface(kCabinPiece.curtain, std::move(folds));
    const std::vector<vec3> rod{{0, kHigh + 0.01F, kInner}, {0, kHigh + 0.01F, kOuter}};
    cloth.tube(kCabinPiece.metal, rod, 0.012F, 8);
    Random random(93);
    constexpr int kTassels = 24;
    const std::int64_t share = fringe_triangles / kTassels;
    for (int i = 0; i < kTassels; ++i) {
        const std::int64_t count = i + 1 < kTassels ? share : fringe_triangles - share * (kTassels - 1);
        const float z = kInner + (kOuter - kInner) * (static_cast<float>(i) + 0.5F) / kTassels;
        cloth.blades(kCabinPiece.blanket,
                     {.foot = {0, kLow + 0.005F, z},
                      .up = {0, -1, 0},
                      .spread = 0.025F,
                      .length = 0.1F,
                      .width = 0.004F,
                      .bend = 0.25F},
                     count, random);
    }
    return cloth.take();
}

}  // namespace rs::synthetic
