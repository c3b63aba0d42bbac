#include "tests/bench/scenes/hall.hpp"

#include "rayspace/api/types/check.hpp"
#include "tests/bench/scenes/group_builder.hpp"
#include "tests/bench/scenes/hall_pieces.hpp"
#include "tests/bench/scenes/light_list.hpp"

#include <cmath>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec3;

constexpr HallMaterials kHall;

constexpr float kBay_m = 3.6F;
constexpr float kHalfWidth_m = 5.4F;
constexpr float kWall_m = 5.2F;
constexpr float kColumnZ_m = 3.2F;
constexpr float kVaultRadius_m = 2.9F;
constexpr float kVaultFoot_m = 5.6F;
constexpr float kGallery_m = 2.56F;
constexpr float kGalleryDepth_m = 2.4F;
constexpr int kSteps = 16;
constexpr float kTread_m = 0.3F;

struct HallPlan {
    const char* name;
    int bays;
    int flutes;
    int shaft_rows;
    int tables;
    std::int64_t triangles;
};

float length_of(const HallPlan& plan) {
    return kBay_m * static_cast<float>(plan.bays);
}

glm::mat4 standing(vec3 foot, float turn_rad = 0.0F) {
    glm::mat4 m(rotation({0, 1, 0}, turn_rad));
    m[3] = glm::vec4(foot, 1.0F);
    return m;
}

// Bay of a wall that faces +Z, from the origin to the right, with an arched window, its reveal and bars.
void wall_bay(GroupBuilder& shell) {
    constexpr float kLeft = 0.9F, kRight = kBay_m - 0.9F, kSill = 0.9F, kSpring = 3.2F, kDeep = 0.35F;
    constexpr float kMiddle = 0.5F * (kLeft + kRight), kRadius = 0.5F * (kRight - kLeft);
    constexpr int kArch = 20;
    shell.sheet(kHall.plaster, {0, 0, 0}, {kLeft, 0, 0}, {0, kWall_m, 0});
    shell.sheet(kHall.plaster, {kRight, 0, 0}, {kBay_m - kRight, 0, 0}, {0, kWall_m, 0});
    shell.sheet(kHall.plaster, {kLeft, 0, 0}, {kRight - kLeft, 0, 0}, {0, kSill, 0});
    std::vector<vec3> arch, above, behind;
    for (int i = 0; i <= kArch; ++i) {
        const float turn = portable::kPiF * (1.0F - static_cast<float>(i) / kArch);
        const vec3 p{kMiddle + kRadius * portable::cos(turn), kSpring + kRadius * portable::sin(turn), 0};
        arch.push_back(p);
        above.emplace_back(p.x, kWall_m, 0);
        behind.push_back(p - vec3(0, 0, kDeep));
    }
    shell.strip(kHall.plaster, arch, above);
    shell.strip(kHall.stone, behind, arch);
    shell.sheet(kHall.stone, {kLeft, kSill, 0}, {0, 0, -kDeep}, {0, kSpring - kSill, 0});
    shell.sheet(kHall.stone, {kRight, kSill, -kDeep}, {0, 0, kDeep}, {0, kSpring - kSill, 0});
    shell.box(kHall.marble, {kLeft - 0.08F, kSill - 0.06F, -kDeep}, {kRight + 0.08F, kSill, 0.1F});
    constexpr float kBar = 0.02F, kBarZ = -0.2F;
    for (int i = 1; i < 4; ++i) {
        const float x = kLeft + 0.45F * static_cast<float>(i);
        const float rise = std::sqrt(kRadius * kRadius - (x - kMiddle) * (x - kMiddle));
        shell.box(kHall.iron, {x - kBar, kSill, kBarZ - kBar}, {x + kBar, kSpring + rise, kBarZ + kBar});
    }
    for (const float y : {1.5F, 2.1F, 2.7F, kSpring}) {
        shell.box(kHall.iron, {kLeft, y - kBar, kBarZ - kBar}, {kRight, y + kBar, kBarZ + kBar});
    }
    // A pilaster and a skirting.
    shell.box(kHall.stone, {-0.25F, 0, 0}, {0.25F, kWall_m - 0.3F, 0.12F});
    shell.box(kHall.stone, {-0.32F, kWall_m - 0.3F, 0}, {0.32F, kWall_m, 0.2F});
    shell.box(kHall.dark_marble, {0.25F, 0, 0}, {kBay_m - 0.25F, 0.18F, 0.04F});
}

void vault(GroupBuilder& shell, const HallPlan& plan) {
    constexpr int kArc = 24;
    const float length = length_of(plan);
    Grid inside(4 * plan.bays, kArc);
    for (int row = 0; row <= kArc; ++row) {
        const float turn = portable::kPiF * static_cast<float>(row) / kArc;
        for (int column = 0; column <= inside.columns; ++column) {
            const float x = length * static_cast<float>(column) / static_cast<float>(inside.columns);
            inside.positions[inside.index(column, row)] = {x, kVaultFoot_m + kVaultRadius_m * portable::sin(turn),
                                                           -kVaultRadius_m * portable::cos(turn)};
            inside.uvs[inside.index(column, row)] = {x, turn};
        }
    }
    shell.surface(kHall.plaster, std::move(inside));
    for (int bay = 1; bay < plan.bays; ++bay) {
        std::vector<vec3> rib;
        for (int i = 0; i <= kArc; ++i) {
            const float turn = portable::kPiF * static_cast<float>(i) / kArc;
            rib.emplace_back(kBay_m * static_cast<float>(bay),
                             kVaultFoot_m + (kVaultRadius_m - 0.02F) * portable::sin(turn),
                             (kVaultRadius_m - 0.02F) * portable::cos(turn));
        }
        shell.tube(kHall.stone, rib, 0.12F, 8);
    }
    for (const float side : {-1.0F, 1.0F}) {
        const float inner = side * (kColumnZ_m - 0.3F), outer = side * (kColumnZ_m + 0.3F);
        shell.box(kHall.marble, {0, kColumnHeight_m, std::min(inner, outer)},
                  {length, kVaultFoot_m, std::max(inner, outer)});
        const float wall = side * kHalfWidth_m;
        const float low = std::min(outer, wall), high = std::max(outer, wall);
        shell.sheet(kHall.plaster, {0, kWall_m, low}, {length, 0, 0}, {0, 0, high - low}, 2 * plan.bays, 2);
    }
}

// End wall that faces +X, at the origin's X.
void end_wall(GroupBuilder& shell) {
    shell.sheet(kHall.plaster, {0, 0, kHalfWidth_m}, {0, 0, -2 * kHalfWidth_m}, {0, kWall_m, 0}, 12, 6);
    std::vector<vec3> low, high;
    for (int i = 0; i <= 24; ++i) {
        const float turn = portable::kPiF * static_cast<float>(i) / 24;
        const float z = kVaultRadius_m * portable::cos(turn);
        low.emplace_back(0, kWall_m, z);
        high.emplace_back(0, kVaultFoot_m + kVaultRadius_m * portable::sin(turn), z);
    }
    shell.strip(kHall.plaster, low, high);
    shell.box(kHall.dark_marble, {0, 0, -kHalfWidth_m}, {0.05F, 0.18F, kHalfWidth_m});
    // A medallion.
    std::vector<vec3> ring;
    for (int i = 0; i <= 32; ++i) {
        const float turn = portable::kTwoPiF * static_cast<float>(i) / 32;
        ring.emplace_back(0.04F, 6.4F + 1.1F * portable::sin(turn), 1.1F * portable::cos(turn));
    }
    shell.tube(kHall.stone, ring, 0.1F, 10);
    shell.tube(kHall.brass, std::vector<vec3>{{0.02F, 5.3F, 0}, {0.02F, 7.5F, 0}}, 0.05F, 8);
    shell.tube(kHall.brass, std::vector<vec3>{{0.02F, 6.4F, -1.1F}, {0.02F, 6.4F, 1.1F}}, 0.05F, 8);
}

void floor_tiles(GroupBuilder& shell, const HallPlan& plan) {
    constexpr float kTile = 0.6F;
    for (int column = 0; column < 6 * plan.bays; ++column) {
        for (int row = 0; row < 18; ++row) {
            const vec3 corner{kTile * static_cast<float>(column), 0,
                              -kHalfWidth_m + kTile * static_cast<float>(row + 1)};
            shell.sheet((column + row) % 2 == 0 ? kHall.marble : kHall.dark_marble, corner, {kTile, 0, 0},
                        {0, 0, -kTile}, 1, 1, 1.1F);
        }
    }
}

vec3 step_middle(int step) {
    const float end = kGalleryDepth_m + kTread_m * kSteps;
    return {end - kTread_m * (static_cast<float>(step) + 0.5F), kGallery_m / kSteps * static_cast<float>(step + 1), 0};
}

void stairs(GroupBuilder& shell, Model& model, std::size_t baluster_group) {
    constexpr float kHalf = 1.5F;
    for (int step = 0; step < kSteps; ++step) {
        const vec3 p = step_middle(step);
        shell.box(kHall.marble, {p.x - kTread_m / 2, 0, -kHalf}, {p.x + kTread_m / 2 + 0.02F, p.y, kHalf});
        shell.box(kHall.carpet, {p.x - kTread_m / 2, p.y, -0.7F}, {p.x + kTread_m / 2 + 0.03F, p.y + 0.012F, 0.7F});
        for (const float z : {-kHalf + 0.12F, kHalf - 0.12F}) {
            model.nodes.push_back({baluster_group, standing({p.x, p.y, z})});
        }
    }
    shell.box(kHall.stone, {0, kGallery_m - 0.3F, -kVaultRadius_m}, {kGalleryDepth_m, kGallery_m, kVaultRadius_m});
    for (const float z : {-2.6F, -1.7F, 1.7F, 2.6F}) {
        shell.box(kHall.stone, {1.9F, 0, z - 0.15F}, {2.2F, kGallery_m - 0.3F, z + 0.15F});
    }
    const vec3 first = step_middle(0), last = step_middle(kSteps - 1);
    for (const float side : {-1.0F, 1.0F}) {
        const float z = side * (kHalf - 0.12F);
        const std::vector<vec3> rail{{first.x, first.y + 0.85F, z}, {last.x, last.y + 0.85F, z}};
        shell.tube(kHall.oak, rail, 0.06F, 10);
        const std::vector<vec3> along{{kGalleryDepth_m - 0.12F, kGallery_m + 0.85F, z},
                                      {kGalleryDepth_m - 0.12F, kGallery_m + 0.85F, side * kVaultRadius_m}};
        shell.tube(kHall.oak, along, 0.06F, 10);
        for (int i = 0; i < 5; ++i) {
            const float at = side * (kHalf - 0.12F + 0.28F * static_cast<float>(i + 1));
            model.nodes.push_back({baluster_group, standing({kGalleryDepth_m - 0.12F, kGallery_m, at})});
        }
    }
}

std::size_t add_group(Model& model, ModelGroup group) {
    model.groups.push_back(std::move(group));
    return model.groups.size() - 1;
}

void furnish(Model& model, const HallPlan& plan) {
    const std::size_t table = add_group(model, hall_table()), chair = add_group(model, hall_chair());
    const std::size_t bench = add_group(model, hall_bench()), lamp = add_group(model, chandelier());
    const float begin = kGalleryDepth_m + kTread_m * kSteps + 2.0F;
    const float apart = (length_of(plan) - begin - 1.0F) / static_cast<float>(plan.tables);
    for (int i = 0; i < plan.tables; ++i) {
        const float x = begin + apart * (static_cast<float>(i) + 0.5F);
        const float z = i % 2 == 0 ? -1.2F : 1.2F;
        model.nodes.push_back({table, standing({x, 0, z})});
        for (const float side : {-1.0F, 1.0F}) {
            for (const float along : {-0.45F, 0.45F}) {
                const float turn = side > 0 ? portable::kPiF : 0.0F;
                model.nodes.push_back({chair, standing({x + along, 0, z + side * 0.72F}, turn + 0.12F * along)});
            }
        }
    }
    for (int bay = 0; bay < plan.bays; ++bay) {
        const float x = kBay_m * (static_cast<float>(bay) + 0.5F);
        if (bay % 2 == 1) {
            model.nodes.push_back({bench, standing({x, 0, -kHalfWidth_m + 0.45F})});
            model.nodes.push_back({bench, standing({x, 0, kHalfWidth_m - 0.45F}, portable::kPiF)});
        }
        if (bay % 2 == 0 && bay > 0) {
            model.nodes.push_back({lamp, standing({x, kVaultFoot_m + kVaultRadius_m, 0})});
        }
    }
}

// Plants with the remaining number of triangles.
void add_plants(Model& model, const HallPlan& plan) {
    std::vector<glm::mat4> places;
    for (int bay = 1; bay < plan.bays; ++bay) {
        for (const float side : {-1.0F, 1.0F}) {
            places.push_back(standing({kBay_m * static_cast<float>(bay), 0, side * (kHalfWidth_m - 0.75F)},
                                      1.3F * static_cast<float>(bay) + side));
        }
    }
    const auto count = static_cast<std::int64_t>(places.size());
    const std::int64_t leaves = plan.triangles - triangle_count(model) - count * triangle_count(plant(0, 0));
    RS_CHECK(leaves >= 200 * count);
    const std::int64_t share = leaves / count;
    const std::size_t like = add_group(model, plant(share, 81));
    const std::size_t last = add_group(model, plant(leaves - share * (count - 1), 82));
    for (std::size_t i = 0; i < places.size(); ++i) {
        model.nodes.push_back({i + 1 < places.size() ? like : last, places[i]});
    }
}

Model make(const HallPlan& plan) {
    Model model;
    model.name = plan.name;
    model.materials = hall_materials();
    model.images = hall_images();
    const float length = length_of(plan);
    const std::size_t columns = add_group(model, fluted_column(plan.flutes, plan.shaft_rows));
    for (int bay = 1; bay < plan.bays; ++bay) {
        for (const float z : {-kColumnZ_m, kColumnZ_m}) {
            model.nodes.push_back({columns, standing({kBay_m * static_cast<float>(bay), 0, z})});
        }
    }
    const std::size_t balusters = add_group(model, baluster());
    GroupBuilder shell("shell");
    floor_tiles(shell, plan);
    vault(shell, plan);
    stairs(shell, model, balusters);
    for (int bay = 0; bay < plan.bays; ++bay) {
        shell.set_frame({kBay_m * static_cast<float>(bay), 0, -kHalfWidth_m});
        wall_bay(shell);
        shell.set_frame({kBay_m * static_cast<float>(bay + 1), 0, kHalfWidth_m}, portable::kPiF);
        wall_bay(shell);
    }
    shell.set_frame({0, 0, 0});
    end_wall(shell);
    shell.set_frame({length, 0, 0}, portable::kPiF);
    end_wall(shell);
    model.nodes.push_back({add_group(model, shell.take()), glm::mat4(1.0F)});
    furnish(model, plan);
    add_plants(model, plan);

    LightList lights;
    lights.sun({-0.35F, -0.62F, -0.7F}, 500, {1.0F, 0.93F, 0.8F});
    for (int bay = 2; bay < plan.bays; bay += 4) {
        lights.point({kBay_m * (static_cast<float>(bay) + 0.5F), kVaultFoot_m + kVaultRadius_m - 2.3F, 0}, 2600,
                     {1.0F, 0.85F, 0.65F});
    }
    model.lights = lights.text();
    model.views = {{"nave", {length - 0.8F, 1.7F, 0.4F}, {4.0F, 2.9F, -0.2F}},
                   {"stairs", {11.0F, 1.7F, 2.2F}, {2.0F, 2.4F, -0.4F}},
                   {"gallery", {1.2F, 4.2F, 0.3F}, {12.0F, 2.6F, 0.0F}},
                   {"aisle", {length - 1.0F, 1.6F, -4.4F}, {4.0F, 2.2F, -3.0F}}};
    return model;
}

}  // namespace

Model make_hall() {
    return make({"hall", 7, 12, 5, 2, kHallTriangles});
}

Model make_great_hall() {
    return make({"great hall", 13, 14, 10, 7, kGreatHallTriangles});
}

}  // namespace rs::synthetic
