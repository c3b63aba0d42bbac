#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/shapes/surfaces.hpp"
#include "datasets-synthetic/street/car_body.hpp"
#include "datasets-synthetic/street/pen.hpp"
#include "datasets-synthetic/street/traffic.hpp"
#include "rayspace/api/types/check.hpp"

#include <map>

namespace rs::synthetic {
namespace {

using glm::vec3;

// An ellipsoid, for lamps and mirrors.
void blob(Pen& pen, const std::string& look, vec3 middle, vec3 radii) {
    pen.surface(look, [&](capture::Mesh& mesh) { append_ellipsoid(mesh, {{middle, glm::mat3{1.0F}}, radii}, 10, 6); });
}

// Lamps and number plates at the front and the back.
struct Lamps {
    vec3 head{0};  // centre of the one at +z
    vec3 head_radii{0.1F};
    vec3 tail{0};
    vec3 tail_radii{0.1F};
    float plate_y = 0.4F;
    float plate_back_y = 0.55F;
};

void add_lamps(Pen& pen, const Lamps& lamps, float front, float back) {
    for (const float side : {-1.0F, 1.0F}) {
        blob(pen, "headlamp", lamps.head * vec3{1, 1, side}, lamps.head_radii);
        blob(pen, "taillamp", lamps.tail * vec3{1, 1, side}, lamps.tail_radii);
    }
    pen.box("plate", {front - 0.02F, lamps.plate_y, -0.26F}, {front + 0.065F, lamps.plate_y + 0.11F, 0.26F});
    pen.box("plate", {back - 0.065F, lamps.plate_back_y, -0.26F}, {back + 0.02F, lamps.plate_back_y + 0.11F, 0.26F});
}

void mirrors(Pen& pen, const std::string& look, vec3 place, vec3 radii) {
    for (const float side : {-1.0F, 1.0F}) blob(pen, look, place * vec3{1, 1, side}, radii);
}

void hatchback(Pen& pen, const std::string& paint) {
    const CarShape shape{
        .roof = {{-2.02F, 0.8F},
                 {-1.97F, 0.98F},
                 {-1.55F, 1.4F},
                 {-0.9F, 1.475F},
                 {-0.2F, 1.475F},
                 {0.2F, 1.43F},
                 {1.02F, 0.98F},
                 {1.65F, 0.86F},
                 {1.92F, 0.74F},
                 {2.02F, 0.6F}},
        .belt = {{-2.02F, 0.78F}, {-1.5F, 0.96F}, {-0.4F, 0.92F}, {1.0F, 0.86F}, {1.65F, 0.76F}, {2.02F, 0.56F}},
        .width = {{-2.02F, 0.6F}, {-1.8F, 0.82F}, {-1.0F, 0.87F}, {1.0F, 0.87F}, {1.65F, 0.81F}, {2.02F, 0.5F}},
        .axles = {-1.28F, 1.28F},
        .side_windows = {{-1.5F, -1.12F}, {-1.07F, -0.3F}, {-0.2F, 0.78F}},
        .screens = {{-1.9F, -1.56F}, {0.24F, 0.98F}},
        .seams = {-0.25F, 0.86F}};
    build_car_body(pen, paint, shape);
    mirrors(pen, paint, {0.62F, 0.99F, 0.92F}, {0.07F, 0.065F, 0.1F});
    for (const float side : {-1.0F, 1.0F}) {
        for (const float x : {-0.42F, -1.2F}) {
            pen.box("rim", {x, 0.79F, side * 0.862F - 0.012F}, {x + 0.17F, 0.815F, side * 0.862F + 0.012F});
        }
    }
    pen.box("trim", {1.98F, 0.3F, -0.34F}, {2.075F, 0.38F, 0.34F});
    pen.box("grille", {1.95F, 0.5F, -0.3F}, {2.05F, 0.56F, 0.3F});
    add_lamps(pen,
              {{1.85F, 0.62F, 0.58F}, {0.15F, 0.07F, 0.16F}, {-1.9F, 0.82F, 0.62F}, {0.085F, 0.09F, 0.15F}, 0.4F, 0.5F},
              2.02F, -2.02F);
}

void van(Pen& pen, const std::string& paint) {
    const CarShape shape{.roof = {{-2.58F, 2.08F},
                                  {-2.5F, 2.2F},
                                  {-1.5F, 2.26F},
                                  {0.9F, 2.26F},
                                  {1.3F, 2.14F},
                                  {2.0F, 1.3F},
                                  {2.45F, 1.08F},
                                  {2.58F, 0.86F}},
                         .belt = {{-2.58F, 1.16F}, {1.8F, 1.16F}, {2.3F, 0.98F}, {2.58F, 0.78F}},
                         .width = {{-2.58F, 0.94F}, {-2.4F, 0.98F}, {1.8F, 0.98F}, {2.3F, 0.9F}, {2.58F, 0.66F}},
                         .sill = 0.27F,
                         .lean = 0.1F,
                         .axles = {-1.6F, 1.65F},
                         .wheel_radius = 0.35F,
                         .side_windows = {{0.62F, 1.78F}},
                         .screens = {{1.3F, 1.94F}},
                         .seams = {-0.75F, 0.5F, 1.84F}};
    build_car_body(pen, paint, shape);
    mirrors(pen, "trim", {1.72F, 1.36F, 1.08F}, {0.06F, 0.16F, 0.09F});
    for (const float side : {-1.0F, 1.0F}) {
        // Rub strip.
        pen.box("trim", {-2.2F, 0.7F, side * 0.978F - 0.01F}, {2.0F, 0.76F, side * 0.978F + 0.01F});
    }
    pen.box("grille", {2.5F, 0.62F, -0.4F}, {2.625F, 0.74F, 0.4F});
    pen.box("trim", {2.45F, 0.3F, -0.62F}, {2.66F, 0.5F, 0.62F});
    pen.box("grille", {-2.645F, 0.5F, -0.006F}, {-2.6F, 2.0F, 0.006F});
    for (const float side : {-1.0F, 1.0F}) {
        pen.box("car_glass", {-2.63F, 1.4F, side * 0.42F - 0.32F}, {-2.55F, 1.9F, side * 0.42F + 0.32F});
    }
    add_lamps(pen,
              {{2.3F, 0.84F, 0.68F}, {0.22F, 0.11F, 0.17F}, {-2.58F, 1.0F, 0.86F}, {0.05F, 0.22F, 0.06F}, 0.4F, 0.55F},
              2.6F, -2.58F);
}

void bus(Pen& pen, const std::string& paint) {
    CarShape shape{
        .roof = {{-5.2F, 2.78F}, {-5.05F, 2.96F}, {-4.5F, 3.02F}, {4.6F, 3.02F}, {5.08F, 2.95F}, {5.2F, 2.8F}},
        .belt = {{-5.2F, 1.22F}, {5.2F, 1.22F}},
        .width = {{-5.2F, 1.1F}, {-5.0F, 1.24F}, {5.0F, 1.24F}, {5.2F, 1.1F}},
        .sill = 0.3F,
        .lean = 0.03F,
        .axles = {-2.9F, 3.1F},
        .wheel_radius = 0.46F,
        .side_windows = {},
        .screens = {},
        .seams = {-0.045F, 3.255F},
        .glass_ends = true,
        .side_glass = "bus_glass"};
    for (int i = 0; i < 6; ++i) {
        const float x = -4.95F + 1.65F * static_cast<float>(i);
        shape.side_windows.emplace_back(x, x + 1.56F);
    }
    build_car_body(pen, paint, shape);
    mirrors(pen, "trim", {5.15F, 2.1F, 1.38F}, {0.08F, 0.24F, 0.09F});
    pen.box("headlamp", {5.0F, 2.78F, -0.75F}, {5.235F, 2.94F, 0.75F});  // destination display
    for (const float side : {-1.0F, 1.0F}) {
        pen.box("stripe", {-4.95F, 0.92F, side * 1.238F - 0.012F}, {4.95F, 1.06F, side * 1.238F + 0.012F});
    }
    add_lamps(pen,
              {{5.12F, 0.72F, 0.88F}, {0.13F, 0.1F, 0.16F}, {-5.18F, 0.95F, 0.98F}, {0.08F, 0.18F, 0.09F}, 0.42F, 0.6F},
              5.2F, -5.2F);
}

}  // namespace

World make_vehicles(bool night, std::set<std::string>& unlit) {
    World world;
    world.looks["tyre"] = {.diffuse = 0x262626, .specular = 0x181818, .shininess = 0.06F};
    world.looks["rim"] = {.diffuse = 0xA8ABAE, .specular = 0xB0B0B0, .shininess = 0.3F};
    world.looks["trim"] = {.diffuse = 0x1C1D1E, .specular = 0x303030, .shininess = 0.15F};
    world.looks["grille"] = {.diffuse = 0x0C0C0D, .specular = 0x404040, .shininess = 0.3F};
    world.looks["stripe"] = {.diffuse = 0xE6E0D0, .specular = 0x606060, .shininess = 0.5F};
    world.looks["car_glass"] = {.diffuse = 0x0E1215, .specular = 0xE0E4E8, .shininess = 1};
    world.looks["bus_glass"] = {.diffuse = night ? 0xF2D9A0U : 0x28323AU, .specular = 0xD0D8E0, .shininess = 1};
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
        world.looks[paint] = {.diffuse = paints.at(model.name), .specular = 0xC8C8C8, .shininess = 0.8F};
        Pen pen(world, model.name);
        if (model.kind == Vehicle::kHatchback) hatchback(pen, paint);
        if (model.kind == Vehicle::kVan) van(pen, paint);
        if (model.kind == Vehicle::kBus) bus(pen, paint);
    }
    return world;
}

}  // namespace rs::synthetic
