#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/street/pen.hpp"
#include "datasets-synthetic/street/traffic.hpp"
#include "rayspace/api/types/check.hpp"

#include <array>
#include <map>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

void wheels(Pen& pen, std::initializer_list<float> axles, float half_width, float radius) {
    for (const float x : axles) {
        for (const float side : {-1.0F, 1.0F}) {
            const float outer = side * half_width;
            pen.cylinder("tyre", {.foot = {x, radius, outer - side * 0.22F},
                                  .axis = {0, 0, side},
                                  .radius = radius,
                                  .length = 0.2F,
                                  .segments = 14});
            pen.cylinder("rim", {.foot = {x, radius, outer - side * 0.05F},
                                 .axis = {0, 0, side},
                                 .radius = 0.6F * radius,
                                 .length = 0.04F,
                                 .end_radius_share = 0.7F});
        }
    }
}

// Lamps at the front and the back, on both sides.
void lamps(Pen& pen, float front, float back, float half_width, float height, float size) {
    for (const float side : {-1.0F, 1.0F}) {
        const float z = side * (half_width - 0.26F);
        pen.box("headlamp", {front - 0.04F, height, z - 0.17F}, {front + 0.03F, height + size, z + 0.17F});
        pen.box("taillamp", {back - 0.03F, height + 0.1F, z - 0.15F}, {back + 0.04F, height + 0.1F + size, z + 0.15F});
    }
    pen.box("plate", {front - 0.02F, height - 0.28F, -0.26F}, {front + 0.035F, height - 0.17F, 0.26F});
    pen.box("plate", {back - 0.035F, height - 0.22F, -0.26F}, {back + 0.02F, height - 0.11F, 0.26F});
}

void hatchback(Pen& pen, const std::string& paint) {
    constexpr float w = 0.86F;
    const std::array<vec2, 12> body{vec2{-2.05F, 0.42F}, {-1.95F, 0.26F}, {1.92F, 0.26F},  {2.05F, 0.42F},
                                    {2.03F, 0.66F},      {1.78F, 0.82F},  {0.95F, 0.93F},  {0.4F, 0.98F},
                                    {-1.2F, 1.0F},       {-1.85F, 0.98F}, {-2.02F, 0.86F}, {-2.06F, 0.6F}};
    pen.prism(paint, body, -w, w);
    const std::array<vec2, 5> cabin{vec2{-1.83F, 0.97F}, {0.98F, 0.9F}, {0.3F, 1.38F}, {-0.6F, 1.45F}, {-1.5F, 1.38F}};
    pen.prism("car_glass", cabin, -w + 0.05F, w - 0.05F, 0.2F, 1.1F);
    const std::array<vec2, 6> roof{vec2{-1.56F, 1.36F}, {-0.6F, 1.42F},  {0.33F, 1.355F},
                                   {0.26F, 1.4F},       {-0.6F, 1.475F}, {-1.5F, 1.41F}};
    pen.prism(paint, roof, -w + 0.235F, w - 0.235F);
    // Pillars on both sides.
    for (const float side : {-1.0F, 1.0F}) {
        const float low = side * (w - 0.045F);
        const float high = side * (w - 0.24F);
        for (const float x : {-0.42F, -1.36F}) {
            std::array<vec3, 4> pillar{vec3{x - 0.06F, 0.98F, low},
                                       {x + 0.06F, 0.98F, low},
                                       {x + 0.04F, 1.41F, high},
                                       {x - 0.06F, 1.41F, high}};
            if (side < 0) std::swap(pillar[0], pillar[1]), std::swap(pillar[2], pillar[3]);
            pen.quad(paint, pillar);
        }
        pen.box(paint, {0.62F, 0.97F, side * (w + 0.03F) - 0.09F}, {0.74F, 1.09F, side * (w + 0.03F) + 0.09F});
    }
    pen.box("trim", {1.9F, 0.24F, -w + 0.03F}, {2.08F, 0.4F, w - 0.03F});
    pen.box("trim", {-2.09F, 0.24F, -w + 0.03F}, {-1.9F, 0.42F, w - 0.03F});
    lamps(pen, 2.0F, -2.04F, w, 0.6F, 0.15F);
    wheels(pen, {1.28F, -1.28F}, w + 0.05F, 0.31F);
}

void van(Pen& pen, const std::string& paint) {
    constexpr float w = 0.98F;
    const std::array<vec2, 8> body{vec2{-2.6F, 0.34F}, {2.5F, 0.34F},  {2.6F, 0.6F}, {2.5F, 1.0F},
                                   {1.95F, 1.22F},     {1.25F, 2.12F}, {1.0F, 2.2F}, {-2.6F, 2.2F}};
    pen.prism(paint, body, -w, w);
    pen.quad("car_glass", {vec3{1.93F, 1.26F, w - 0.12F},
                           {1.93F, 1.26F, -w + 0.12F},
                           {1.31F, 2.06F, -w + 0.14F},
                           {1.31F, 2.06F, w - 0.14F}});
    for (const float side : {-1.0F, 1.0F}) {
        const float z = side * (w + 0.012F);
        std::array<vec3, 4> door{vec3{0.5F, 1.28F, z}, {1.72F, 1.28F, z}, {1.2F, 1.98F, z}, {0.5F, 1.98F, z}};
        if (side < 0) std::swap(door[0], door[1]), std::swap(door[2], door[3]);
        pen.quad("car_glass", door);
        pen.box("trim", {1.72F, 1.2F, side * (w + 0.1F) - 0.07F}, {1.82F, 1.5F, side * (w + 0.1F) + 0.07F});
    }
    pen.box("trim", {2.4F, 0.3F, -w + 0.03F}, {2.64F, 0.5F, w - 0.03F});
    pen.box("trim", {-2.66F, 0.3F, -w + 0.03F}, {-2.5F, 0.5F, w - 0.03F});
    lamps(pen, 2.56F, -2.6F, w, 0.72F, 0.22F);
    wheels(pen, {1.65F, -1.6F}, w + 0.05F, 0.34F);
}

void bus(Pen& pen, const std::string& paint) {
    constexpr float w = 1.24F;
    const std::array<vec2, 8> body{vec2{-5.25F, 0.36F}, {5.15F, 0.36F}, {5.25F, 0.7F},  {5.2F, 2.6F},
                                   {5.0F, 2.95F},       {-5.0F, 3.0F},  {-5.22F, 2.8F}, {-5.25F, 0.7F}};
    pen.prism(paint, body, -w, w);
    for (const float side : {-1.0F, 1.0F}) {
        const float z = side * (w + 0.012F);
        for (int i = 0; i < 6; ++i) {
            const float x = -4.8F + 1.62F * static_cast<float>(i);
            std::array<vec3, 4> pane{vec3{x, 1.35F, z}, {x + 1.5F, 1.35F, z}, {x + 1.5F, 2.45F, z}, {x, 2.45F, z}};
            if (side < 0) std::swap(pane[0], pane[1]), std::swap(pane[2], pane[3]);
            pen.quad("bus_glass", pane);
        }
    }
    pen.quad("car_glass", {vec3{5.235F, 1.15F, w - 0.12F},
                           {5.235F, 1.15F, -w + 0.12F},
                           {5.215F, 2.5F, -w + 0.14F},
                           {5.215F, 2.5F, w - 0.14F}});
    pen.quad("car_glass", {vec3{-5.262F, 1.5F, -w + 0.2F},
                           {-5.262F, 1.5F, w - 0.2F},
                           {-5.25F, 2.4F, w - 0.2F},
                           {-5.25F, 2.4F, -w + 0.2F}});
    pen.box("headlamp", {5.0F, 2.62F, -0.7F}, {5.17F, 2.84F, 0.7F});  // destination display
    pen.box("trim", {5.0F, 0.3F, -w + 0.03F}, {5.29F, 0.52F, w - 0.03F});
    lamps(pen, 5.22F, -5.25F, w, 0.72F, 0.2F);
    wheels(pen, {3.1F, -2.9F}, w + 0.05F, 0.46F);
}

}  // namespace

World make_vehicles(bool night, std::set<std::string>& unlit) {
    World world;
    world.looks["tyre"] = {.diffuse = 0x222222};
    world.looks["rim"] = {.diffuse = 0x9A9DA0, .specular = 0x808080, .shininess = 0.3F};
    world.looks["trim"] = {.diffuse = 0x2B2C2E, .specular = 0x202020, .shininess = 0.2F};
    world.looks["car_glass"] = {.diffuse = 0x1B2126, .specular = 0xC0C8D0, .shininess = 0.9F};
    world.looks["bus_glass"] = {.diffuse = night ? 0xF2D9A0U : 0x28323AU, .specular = 0xA0A8B0, .shininess = 0.9F};
    world.looks["plate"] = {.diffuse = 0xE6E4DC};
    world.looks["headlamp"] = {.diffuse = night ? 0xFFF6D8U : 0xDADFE2U, .specular = 0xC0C0C0, .shininess = 0.6F};
    world.looks["taillamp"] = {.diffuse = night ? 0xFF2A1AU : 0x9A1A16U, .specular = 0x604040, .shininess = 0.5F};
    if (night) unlit.insert({"headlamp", "taillamp", "bus_glass"});
    const std::map<std::string, std::uint32_t> paints = {
        {"car_red", 0xB3231E},   {"car_blue", 0x27518F},   {"car_white", 0xE4E4E0},
        {"car_black", 0x24262A}, {"car_silver", 0x9DA3A8}, {"car_yellow", 0xE0A81C},
        {"van_white", 0xEDEDE8}, {"van_green", 0x2F6B4A},  {"bus_red", 0xA82A24}};
    for (const VehicleModel& model : vehicle_models()) {
        const std::string paint = "paint_" + model.name;
        world.looks[paint] = {.diffuse = paints.at(model.name), .specular = 0xA0A0A0, .shininess = 0.5F};
        Pen pen(world, model.name);
        if (model.kind == Vehicle::kHatchback) hatchback(pen, paint);
        if (model.kind == Vehicle::kVan) van(pen, paint);
        if (model.kind == Vehicle::kBus) bus(pen, paint);
    }
    return world;
}

}  // namespace rs::synthetic
