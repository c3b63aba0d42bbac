#include "datasets-synthetic/showroom/furniture.hpp"

#include <algorithm>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec3;

std::string one_of_six(const char* kind, Random& random) {
    return kind + std::to_string(random.below(6));
}

void bowl(RoomBuilder& room, vec3 foot, float r, const std::string& glaze) {
    room.lathe(glaze, foot,
               {{0.0F, 0.0F},
                {0.42F * r, 0.0F},
                {0.8F * r, 0.26F * r},
                {r, 0.62F * r},
                {0.94F * r, 0.62F * r},
                {0.6F * r, 0.2F * r},
                {0.0F, 0.12F * r}},
               11, 0.8F);
}

void jar(RoomBuilder& room, vec3 foot, float r, float height, const std::string& glaze) {
    const float h = height;
    room.lathe(glaze, foot,
               {{0.0F, 0.0F},
                {0.62F * r, 0.0F},
                {0.95F * r, 0.25F * h},
                {0.9F * r, 0.6F * h},
                {0.55F * r, 0.78F * h},
                {0.6F * r, 0.84F * h},
                {0.15F * r, 0.92F * h},
                {0.0F, h}},
               11, 0.75F);
}

void bottle(RoomBuilder& room, vec3 foot, float r, float height, const std::string& glaze) {
    const float h = height;
    room.lathe(glaze, foot,
               {{0.0F, 0.0F},
                {r, 0.0F},
                {r, 0.42F * h},
                {0.6F * r, 0.57F * h},
                {0.26F * r, 0.67F * h},
                {0.32F * r, h},
                {0.0F, h}},
               10, 0.75F);
}

void plates(RoomBuilder& room, vec3 foot, float r, int count, const std::string& glaze) {
    for (int k = 0; k < count; ++k) {
        const vec3 at = foot + vec3{0, 0.018F * static_cast<float>(k), 0};
        room.lathe(glaze, at, {{0.0F, 0.0F}, {0.6F * r, 0.0F}, {r, 0.025F}, {0.62F * r, 0.012F}, {0.0F, 0.012F}}, 14,
                   0.5F);
    }
}

}  // namespace

void books(RoomBuilder& room, const GoodsArea& place, Random& random) {
    float x = place.x_low;
    while (true) {
        const float width = random.uniform(0.02F, 0.045F);
        const float height = std::min(random.uniform(0.2F, 0.31F), 0.9F * place.room_above_m);
        const float depth = std::min(random.uniform(0.15F, 0.21F), place.depth_m);
        const std::string binding = one_of_six("binding", random);
        if (x + width > place.x_high) return;
        const float front = place.z + 0.5F * place.depth_m - random.uniform(0.0F, 0.02F);
        room.box(binding, {x, place.y, front - depth}, {x + width, place.y + height, front});
        x += width + 0.0015F;
    }
}

void folded_cloth(RoomBuilder& room, const GoodsArea& place, Random& random) {
    const float half = 0.5F * place.depth_m - 0.02F;
    for (float x = place.x_low; x + 0.3F <= place.x_high; x += 0.34F) {
        float y = place.y;
        const int count = 2 + random.below(3);
        for (int k = 0; k < count; ++k) {
            const float height = random.uniform(0.04F, 0.065F);
            const float shift = random.uniform(-0.008F, 0.008F);
            if (y + height > place.y + place.room_above_m) break;
            room.soft_box(one_of_six("cloth", random), {x + shift, y, place.z - half},
                          {x + 0.3F + shift, y + height, place.z + half}, 0.018F);
            y += height;
        }
    }
}

void pottery(RoomBuilder& room, const GoodsArea& place, Random& random) {
    float x = place.x_low;
    while (true) {
        const int kind = random.below(4);
        const float r = random.uniform(0.065F, 0.115F);
        const std::string glaze = one_of_six("glaze", random);
        const vec3 foot{x + r, place.y, place.z + random.uniform(-0.03F, 0.03F)};
        if (x + 2.0F * r > place.x_high) return;
        const float height = std::min(r * random.uniform(2.2F, 3.2F), 0.85F * place.room_above_m);
        if (kind == 0) bowl(room, foot, r, glaze);
        if (kind == 1) jar(room, foot, r, height, glaze);
        if (kind == 2) bottle(room, foot, 0.7F * r, height, glaze);
        if (kind == 3) plates(room, foot, r, 2, glaze);
        x += 2.0F * r + 0.05F;
    }
}

void basket(RoomBuilder& room, vec3 foot, float radius_m, float height_m, int rolls, Random& random) {
    const float r = radius_m;
    const float h = height_m;
    room.lathe("cane", foot,
               {{0.0F, 0.0F}, {0.78F * r, 0.0F}, {r, h}, {r - 0.025F, h}, {0.74F * r, 0.05F * h}, {0.0F, 0.05F * h}},
               16, 0.7F);
    for (int k = 0; k < rolls; ++k) {
        const double angle_rad = 6.2831853 * static_cast<double>(k) / rolls + 0.5;
        const float out = rolls == 1 ? 0.0F : 0.42F * r;
        const vec3 side{static_cast<float>(portable::cos(angle_rad)), 0, static_cast<float>(portable::sin(angle_rad))};
        const vec3 low = foot + side * out + vec3{0, 0.12F * h, 0};
        const vec3 high = foot + side * (out * 1.35F) + vec3{0, h + random.uniform(0.08F, 0.28F), 0};
        const vec3 path[] = {low, high};
        room.tube(one_of_six("cloth", random), path, 0.2F * r, 6);
    }
}

}  // namespace rs::synthetic
