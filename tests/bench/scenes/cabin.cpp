#include "tests/bench/scenes/cabin.hpp"

#include "rayspace/api/types/check.hpp"
#include "tests/bench/scenes/cabin_pieces.hpp"
#include "tests/bench/scenes/group_builder.hpp"
#include "tests/bench/scenes/light_list.hpp"

#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec3;

constexpr CabinMaterials kCabin;

constexpr int kRows = 30;
constexpr float kPitch_m = 0.79F;
constexpr float kFirstRow_m = 1.9F;
constexpr int kBins = 26;
constexpr int kWindows = 52;
constexpr float kLength_m = kBinLength_m * kBins;
constexpr float kSeats_m[] = {0.5F, 0.96F, 1.42F};  // distance from the middle
constexpr const char* kSpotFile = "reading.ies";

// Placement of a piece built for the side of +Z. On the other side it is rotated about Y, so that its x axis points
// backwards from `x`.
glm::mat4 on_side(float x, float side) {
    glm::mat4 m(rotation({0, 1, 0}, side > 0 ? 0.0F : portable::kPiF));
    m[3] = {x, 0, 0, 1};
    return m;
}

std::size_t added(Model& model, ModelGroup group) {
    model.groups.push_back(std::move(group));
    return model.groups.size() - 1;
}

void seats(Model& model) {
    const std::size_t seat = added(model, cabin_seat()), panel = added(model, service_panel());
    for (int row = 0; row < kRows; ++row) {
        const float x = kFirstRow_m + kPitch_m * static_cast<float>(row);
        for (const float side : {-1.0F, 1.0F}) {
            for (const float away : kSeats_m) {
                glm::mat4 m(rotation({0, 1, 0}, -0.5F * portable::kPiF));
                m[3] = {x, 0, side * away, 1};
                model.nodes.push_back({seat, m});
            }
            model.nodes.push_back({panel, on_side(x - 0.12F, side)});
        }
    }
}

void walls(Model& model) {
    const std::size_t open = added(model, cabin_window(false)), shaded = added(model, cabin_window(true));
    const std::size_t bin = added(model, cabin_bin());
    for (const float side : {-1.0F, 1.0F}) {
        for (int i = 0; i < kWindows; ++i) {
            const float x = kWindowPitch_m * static_cast<float>(side > 0 ? i : i + 1);
            model.nodes.push_back({i % 5 == 3 ? shaded : open, on_side(x, side)});
        }
        for (int i = 0; i < kBins; ++i) {
            model.nodes.push_back({bin, on_side(kBinLength_m * static_cast<float>(side > 0 ? i : i + 1), side)});
        }
    }
    GroupBuilder shell("shell");
    const float half = cabin_half_width(0);
    shell.sheet(kCabin.carpet, {0, 0, half}, {kLength_m, 0, 0}, {0, 0, -2 * half}, 56, 8);
    shell.box(kCabin.aisle, {0, 0, -0.24F}, {kLength_m, 0.006F, 0.24F});
    constexpr int kArc = 24, kAlong = 56;
    Grid ceiling(kAlong, kArc);
    for (int row = 0; row <= kArc; ++row) {
        const float share = 2.0F * static_cast<float>(row) / kArc - 1.0F;
        for (int column = 0; column <= kAlong; ++column) {
            const float x = kLength_m * static_cast<float>(column) / kAlong;
            ceiling.positions[ceiling.index(column, row)] = {x, 2.21F + 0.12F * (1.0F - share * share), -0.79F * share};
            ceiling.uvs[ceiling.index(column, row)] = {x, share};
        }
    }
    shell.surface(kCabin.panel, std::move(ceiling));
    for (const float x : {0.0F, kLength_m}) {
        shell.sheet(kCabin.panel, {x, 0, x > 0 ? -1.85F : 1.85F}, {0, 0, x > 0 ? 3.7F : -3.7F}, {0, 2.4F, 0}, 12, 8);
        const float inwards = x > 0 ? -1.0F : 1.0F;
        shell.box(kCabin.grey, {std::min(x, x + 0.03F * inwards), 0.02F, -0.42F},
                  {std::max(x, x + 0.03F * inwards), 1.95F, 0.42F});
        shell.box(kCabin.metal, {std::min(x, x + 0.06F * inwards), 0.95F, 0.28F},
                  {std::max(x, x + 0.06F * inwards), 1.02F, 0.36F});
    }
    model.nodes.push_back({added(model, shell.take()), glm::mat4(1.0F)});
}

void curtains(Model& model) {
    constexpr float kPlaces[] = {0.9F, kLength_m - 1.4F};
    const std::int64_t fringes = kCabinTriangles - triangle_count(model) - 4 * triangle_count(curtain(0));
    RS_CHECK(fringes >= 4 * 24 * 6);
    const std::size_t like = added(model, curtain(fringes / 4));
    const std::size_t last = added(model, curtain(fringes - 3 * (fringes / 4)));
    for (const float x : kPlaces) {
        for (const float side : {-1.0F, 1.0F}) {
            const bool is_last = x == kPlaces[1] && side > 0;
            model.nodes.push_back({is_last ? last : like, on_side(x, side)});
        }
    }
}

std::string lights() {
    LightList list;
    const vec3 cool(0.85F, 0.92F, 1.0F), warm(1.0F, 0.83F, 0.62F);
    for (int i = 0; i < kCabinAreas; ++i) {
        const float x = kLength_m * (static_cast<float>(i) + 0.5F) / kCabinAreas;
        list.rectangle({x, 2.3F, 0}, {0, -1, 0}, {3.6F, 0.3F}, 900, cool);
    }
    // Every other row, on alternating sides.
    for (int i = 0; i < kCabinSpots / 3; ++i) {
        const float x = kFirstRow_m + kPitch_m * static_cast<float>(2 * i + 1);
        const float side = i % 2 == 0 ? 1.0F : -1.0F;
        for (const float away : kSeats_m)
            list.luminaire(kSpotFile, {x - 0.17F, 1.49F, side * (0.95F * away + 0.1F)}, {-0.12F, -1, 0}, warm);
    }
    list.sun({0.25F, -0.42F, -1.0F}, 3000, {1.0F, 0.9F, 0.72F});
    return list.text();
}

}  // namespace

Model make_cabin() {
    Model model;
    model.name = "cabin";
    model.materials = cabin_materials();
    seats(model);
    walls(model);
    curtains(model);
    model.lights = lights();
    model.luminaires[kSpotFile] = beam_ies("reading light", 110, 14);
    model.views = {{"aisle", {kLength_m - 2.2F, 1.55F, 0.05F}, {6.0F, 1.0F, -0.02F}},
                   {"front", {1.3F, 1.6F, 0}, {9.0F, 1.1F, 0.2F}},
                   {"seat", {12.9F, 1.2F, 1.0F}, {10.5F, 0.95F, 1.25F}},
                   {"window", {15.4F, 1.25F, -0.6F}, {15.1F, 1.0F, -1.9F}}};
    return model;
}

}  // namespace rs::synthetic
