#include "tests/bench/scenes/hall_pieces.hpp"

#include "datasets-synthetic/shapes/noise.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/bench/scenes/group_builder.hpp"

#include <algorithm>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr HallMaterials kHallPiece;

// Marble with veins at the zero crossings of layered noise. The texture is tileable: the noise is periodic.
Image<Rgba8> stone_image(vec3 ground, vec3 vein, std::uint32_t seed) {
    constexpr int kSide = 256;
    Image<Rgba8> image(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const float s = portable::kTwoPiF * static_cast<float>(x) / kSide;
            const float t = portable::kTwoPiF * static_cast<float>(y) / kSide;
            const float around = 1.0F + 0.4F * portable::cos(t);
            const vec3 place{2.2F * around * portable::cos(s), 2.2F * around * portable::sin(s),
                             1.8F * portable::sin(t)};
            const float streak = std::abs(layered_noise(place, 5, seed));
            const float share = std::clamp(1.0F - 7.0F * streak, 0.0F, 1.0F);
            const float cloud = 0.92F + 0.12F * layered_noise(place * 0.7F + vec3(5.0F), 3, seed + 1);
            const vec3 colour = glm::mix(ground, vein, 0.6F * share) * cloud;
            image(x, y) = {srgb8_from_linear(colour.r), srgb8_from_linear(colour.g), srgb8_from_linear(colour.b), 255};
        }
    }
    return image;
}

void legs(GroupBuilder& piece, vec2 half, float height) {
    for (const float x : {-half.x, half.x}) {
        for (const float z : {-half.y, half.y}) {
            piece.lathe(kHallPiece.oak, {x, 0, z},
                        {{0, 0},
                         {0.025F, 0},
                         {0.035F, 0.1F},
                         {0.02F, 0.14F},
                         {0.04F, 0.6F * height},
                         {0.03F, height},
                         {0, height}},
                        6);
        }
    }
}

}  // namespace

std::vector<ModelMaterial> hall_materials() {
    return {{"plaster", {0.74F, 0.70F, 0.62F}},
            {"marble", {0.9F, 0.9F, 0.9F}, 0.35F, "marble.png"},
            {"dark_marble", {0.9F, 0.9F, 0.9F}, 0.35F, "dark.png"},
            {"stone", {0.62F, 0.56F, 0.47F}},
            {"oak", {0.32F, 0.17F, 0.08F}, 0.5F},
            {"leather", {0.25F, 0.05F, 0.04F}, 0.55F},
            {"brass", {0.68F, 0.47F, 0.16F}, 0.3F},
            {"candle", {0.85F, 0.8F, 0.68F}},
            {"leaf", {0.08F, 0.25F, 0.06F}, 0.6F},
            {"clay", {0.45F, 0.19F, 0.1F}},
            {"iron", {0.06F, 0.06F, 0.065F}, 0.5F},
            {"carpet", {0.35F, 0.06F, 0.07F}}};
}

std::map<std::string, Image<Rgba8>> hall_images() {
    return {{"marble.png", stone_image({0.78F, 0.75F, 0.7F}, {0.42F, 0.4F, 0.38F}, 71)},
            {"dark.png", stone_image({0.12F, 0.14F, 0.13F}, {0.5F, 0.5F, 0.46F}, 72)}};
}

ModelGroup fluted_column(int flutes, int rows) {
    GroupBuilder piece("column");
    constexpr float kShaftLow = 0.42F, kShaftHigh = 4.5F, kRadius = 0.3F;
    piece.box(kHallPiece.marble, {-0.45F, 0, -0.45F}, {0.45F, 0.14F, 0.45F});
    piece.lathe(kHallPiece.marble, {0, 0.14F, 0},
                {{0.42F, 0},
                 {0.45F, 0.03F},
                 {0.45F, 0.07F},
                 {0.41F, 0.1F},
                 {0.36F, 0.13F},
                 {0.36F, 0.17F},
                 {0.4F, 0.2F},
                 {0.4F, 0.23F},
                 {0.33F, 0.28F}},
                32);
    Grid shaft(6 * flutes, rows, true);
    for (int row = 0; row <= rows; ++row) {
        const float up = static_cast<float>(row) / static_cast<float>(rows);
        const float radius = kRadius * (1.08F - 0.06F * up - 0.1F * up * up);
        for (int column = 0; column <= shaft.columns; ++column) {
            const float turn = portable::kTwoPiF * static_cast<float>(column) / static_cast<float>(shaft.columns);
            const int in_flute = column % 6;
            const float depth =
                in_flute == 0 ? 0.0F : 0.07F * (1.0F - 0.16F * std::abs(static_cast<float>(in_flute) - 3.0F));
            shaft.positions[shaft.index(column, row)] =
                portable::around(turn, radius * (1.0F - depth), kShaftLow + (kShaftHigh - kShaftLow) * up);
            shaft.uvs[shaft.index(column, row)] = {
                2.0F * static_cast<float>(column) / static_cast<float>(shaft.columns), 2.0F * up};
        }
    }
    piece.surface(kHallPiece.marble, std::move(shaft));
    piece.lathe(kHallPiece.marble, {0, kShaftHigh, 0},
                {{0.28F, 0},
                 {0.32F, 0.03F},
                 {0.32F, 0.06F},
                 {0.28F, 0.09F},
                 {0.29F, 0.16F},
                 {0.34F, 0.26F},
                 {0.42F, 0.33F},
                 {0.42F, 0.36F}},
                32);
    piece.box(kHallPiece.marble, {-0.46F, kShaftHigh + 0.36F, -0.46F}, {0.46F, kColumnHeight_m, 0.46F});
    return piece.take();
}

ModelGroup baluster() {
    GroupBuilder piece("baluster");
    piece.lathe(kHallPiece.marble, {0, 0, 0},
                {{0, 0},
                 {0.07F, 0},
                 {0.07F, 0.06F},
                 {0.04F, 0.1F},
                 {0.05F, 0.16F},
                 {0.075F, 0.28F},
                 {0.06F, 0.42F},
                 {0.035F, 0.6F},
                 {0.04F, 0.7F},
                 {0.065F, 0.74F},
                 {0.065F, 0.8F},
                 {0, 0.8F}},
                10);
    return piece.take();
}

ModelGroup hall_table() {
    GroupBuilder piece("table");
    legs(piece, {0.8F, 0.38F}, 0.72F);
    piece.box(kHallPiece.oak, {-0.84F, 0.64F, -0.42F}, {0.84F, 0.72F, 0.42F});
    piece.box(kHallPiece.oak, {-0.95F, 0.72F, -0.5F}, {0.95F, 0.76F, 0.5F});
    piece.lathe(kHallPiece.clay, {0.1F, 0.76F, 0.05F},
                {{0, 0}, {0.07F, 0}, {0.13F, 0.08F}, {0.15F, 0.16F}, {0.14F, 0.16F}, {0.11F, 0.08F}, {0, 0.02F}}, 24);
    return piece.take();
}

ModelGroup hall_chair() {
    GroupBuilder piece("chair");
    legs(piece, {0.19F, 0.19F}, 0.42F);
    piece.cushion(kHallPiece.leather, {-0.23F, 0.4F, -0.22F}, {0.23F, 0.5F, 0.23F}, 1, 16, 8);
    for (const float x : {-0.2F, 0.2F}) {
        const vec3 post[] = {{x, 0.42F, -0.2F}, {x, 0.75F, -0.23F}, {x, 1.05F, -0.28F}};
        piece.tube(kHallPiece.oak, post, 0.018F, 5);
    }
    for (const float y : {0.62F, 0.76F, 0.9F}) {
        piece.box(kHallPiece.oak, {-0.19F, y, -0.26F}, {0.19F, y + 0.07F, -0.235F});
    }
    return piece.take();
}

ModelGroup hall_bench() {
    GroupBuilder piece("bench");
    for (const float x : {-0.7F, 0.7F}) piece.box(kHallPiece.stone, {x - 0.1F, 0, -0.2F}, {x + 0.1F, 0.38F, 0.2F});
    piece.box(kHallPiece.oak, {-1.0F, 0.38F, -0.24F}, {1.0F, 0.44F, 0.24F});
    piece.cushion(kHallPiece.leather, {-0.98F, 0.43F, -0.23F}, {0.98F, 0.52F, 0.23F}, 2, 16, 8);
    return piece.take();
}

ModelGroup chandelier() {
    GroupBuilder piece("chandelier");
    constexpr int kArms = 8;
    constexpr float kDrop = 2.0F, kRadius = 0.75F;
    const vec3 rod[] = {{0, 0, 0}, {0, -kDrop + 0.4F, 0}};
    piece.tube(kHallPiece.brass, rod, 0.015F, 8);
    std::vector<vec3> ring;
    for (int i = 0; i <= 30; ++i) {
        ring.push_back(portable::around(portable::kTwoPiF * static_cast<float>(i) / 30, kRadius, -kDrop));
    }
    piece.tube(kHallPiece.brass, ring, 0.02F, 6);
    piece.cushion(kHallPiece.brass, {-0.1F, -kDrop + 0.2F, -0.1F}, {0.1F, -kDrop + 0.45F, 0.1F}, 0, 16, 8);
    for (int arm = 0; arm < kArms; ++arm) {
        const float turn = portable::kTwoPiF * static_cast<float>(arm) / kArms;
        const vec3 bow[] = {portable::around(turn, 0.08F, -kDrop + 0.3F), portable::around(turn, 0.4F, -kDrop + 0.12F),
                            portable::around(turn, kRadius, -kDrop)};
        piece.tube(kHallPiece.brass, bow, 0.012F, 5);
        const vec3 foot = portable::around(turn, kRadius, -kDrop + 0.02F);
        piece.lathe(kHallPiece.brass, foot, {{0, 0}, {0.05F, 0.01F}, {0.06F, 0.03F}, {0, 0.02F}}, 10);
        piece.lathe(kHallPiece.candle, foot, {{0.014F, 0.02F}, {0.014F, 0.16F}, {0, 0.165F}}, 8);
    }
    return piece.take();
}

ModelGroup plant(std::int64_t leaf_triangles, std::uint64_t seed) {
    GroupBuilder piece("plant");
    piece.lathe(
        kHallPiece.clay, {0, 0, 0},
        {{0, 0}, {0.2F, 0}, {0.28F, 0.4F}, {0.3F, 0.4F}, {0.3F, 0.45F}, {0.26F, 0.45F}, {0.25F, 0.4F}, {0, 0.4F}}, 24);
    Random random(seed);
    piece.blades(kHallPiece.leaf,
                 {.foot = {0, 0.4F, 0}, .spread = 0.15F, .length = 0.85F, .width = 0.05F, .bend = 0.5F}, leaf_triangles,
                 random);
    return piece.take();
}

}  // namespace rs::synthetic
