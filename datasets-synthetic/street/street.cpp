#include "datasets-synthetic/street/street.hpp"

#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/street/obj_file.hpp"
#include "datasets-synthetic/street/sky.hpp"
#include "datasets-synthetic/street/street_models.hpp"
#include "datasets-synthetic/street/traffic.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

namespace fs = std::filesystem;
using glm::vec2;
using glm::vec3;
using nlohmann::ordered_json;

constexpr double kHazeVisibility_m = 2500;

// An instance of an object in the static world.
struct StaticInstance {
    std::string object;
    vec3 foot{0};
    float turn_deg = 0;
    float size = 1;
};

struct Street {
    World world;
    std::set<std::string> unlit;
    std::vector<StaticInstance> instances;
    std::vector<vec3> street_lights;
    std::vector<vec3> shop_lights;
};

// A row of houses with aligned fronts, from `begin` towards +X of the row's frame.
struct HouseRow {
    std::string name;  // prefix of the houses' names
    vec3 begin{0};
    float turn_deg = 0;
    float length_m = 0;
};

void build_row(const HouseRow& row, bool night, Street& street, RoomBuilder& builder, Random& random) {
    static constexpr std::array kShops{"ORIENTALIA", "FLORA", "TOYS", "LUMEN", "GEOMETRY", "CAFE"};
    static const std::array<std::vector<std::string>, 6> kGoods{std::vector<std::string>{"vase", "lamp"},
                                                                {"flower", "flower"},
                                                                {"doll", "blocks"},
                                                                {"lamp", "lattice"},
                                                                {"lattice", "vase"},
                                                                {"vase", "flower"}};
    float at = 0;
    for (int number = 0; row.length_m - at > 7; ++number) {
        HouseStyle style;
        style.width_m = std::min(random.uniform(7.5F, 10.5F), row.length_m - at);
        if (row.length_m - at - style.width_m < 7) style.width_m = row.length_m - at;
        style.floors = 2 + random.below(3);
        style.wall = random.below(kWallLooks);
        style.gable = random.uniform() < 0.6F;
        style.slate = random.uniform() < 0.4F;
        style.night = night;
        style.seed = random.next();
        Pen pen(street.world, row.name + "_" + std::to_string(number));
        pen.set_frame(row.begin, row.turn_deg);
        const vec3 corner = pen.point({at, 0, 0});
        const float from_crossing = std::max(std::abs(corner.x), std::abs(pen.point({at + style.width_m, 0, 0}).x));
        const bool on_main = std::abs(corner.z) < kHalfStreet_m + 1;
        const std::size_t shops = street.shop_lights.size();
        const bool at_crossing = on_main && from_crossing < 18;
        const bool begins_there = std::abs(corner.x) < kHalfStreet_m + 1;
        style.open_left = at_crossing && begins_there;
        style.open_right = at_crossing && !begins_there && at + style.width_m > row.length_m - 0.1F;
        // Shops are near the crossing: at the row's beginning or end.
        if (on_main && from_crossing < 36 && shops < kShops.size() && style.width_m < 14) {
            style.shop = kShops.at(shops);
            style.objects = kGoods.at(shops);
            street.shop_lights.push_back(shop_light(corner, row.turn_deg, style));
        }
        build_house(street.world, pen, builder, corner, row.turn_deg, style);
        at += style.width_m;
    }
}

// Trees, lamps and other furniture between carriageway and pavement, symmetric about both streets.
void furnish_pavements(Street& street, Random& random) {
    const auto put = [&](const std::string& object, float x, float z, float turn_deg, float size = 1) {
        street.instances.push_back({object, {x, kKerb_m, z}, turn_deg, size});
    };
    for (int i = 0; i < 5; ++i) {
        for (const float sx : {-1.0F, 1.0F}) {
            for (const float sz : {-1.0F, 1.0F}) {
                const float x = sx * (17 + 12 * static_cast<float>(i)) + 3 * sz;
                const float inwards = sz > 0 ? 180.0F : 0.0F;
                const std::string tree = "tree_" + std::to_string(random.below(kTrees));
                const float turn = random.uniform(0, 360);
                const float size = random.uniform(0.9F, 1.2F);
                put(tree, x, sz * 4.9F, turn, size);
                put("lamp", x + 6 * sx, sz * 4.6F, inwards);
                street.street_lights.emplace_back(x + 6 * sx, kLampHeight_m + 0.1F, sz * 3.4F);
                const int kind = random.below(3);
                if (kind == 0) put("bench", x + 2.4F * sx, sz * 4.75F, inwards + 180);
                if (kind == 1) put("bin", x + 5.2F * sx, sz * 4.65F, 0);
                if (kind == 2) put("sign", x + 3.2F * sx, sz * 4.5F, sx * sz > 0 ? 90.0F : -90.0F);
            }
        }
    }
    for (const float sx : {-1.0F, 1.0F}) {
        for (const float sz : {-1.0F, 1.0F}) {
            put("bollard", sx * 6.2F, sz * 4.35F, 0);
            put("bollard", sx * 4.35F, sz * 6.2F, 0);
        }
    }
}

void plant_surroundings(Street& street, Random& random) {
    const auto plant = [&](vec2 low, vec2 high, int count) {
        for (int i = 0; i < count; ++i) {
            for (const float sx : {-1.0F, 1.0F}) {
                for (const float sz : {-1.0F, 1.0F}) {
                    const float x = sx * random.uniform(low.x, high.x);
                    const float z = sz * random.uniform(low.y, high.y);
                    const float turn = random.uniform(0, 360);
                    const float size = random.uniform(0.9F, 2.0F);
                    const std::string kind = i % 2 == 0 ? "bush" : "tree_" + std::to_string(random.below(kTrees));
                    street.instances.push_back({kind, {x, -0.06F, z}, turn, size});
                }
            }
        }
    };
    plant({76, 11}, {166, 55}, 10);
    plant({11, 52}, {50, 105}, 6);
}

Street make_street(const StreetOptions& options) {
    Street street;
    const bool night = options.scenario.night;
    RoomBuilder builder(street.world, "street", options.texture_scale);
    add_house_looks(street.world, builder, options.texture_scale, night, street.unlit);
    add_road_looks(builder);
    add_tree_looks(street.world, builder, options.texture_scale);
    add_furniture_looks(builder, night, street.unlit);
    build_roads(street.world);
    build_trees(street.world);
    build_furniture(street.world);
    Random random(2024, 1);
    const auto build = [&](const HouseRow& row) { build_row(row, night, street, builder, random); };
    const float h = kHalfStreet_m;
    const float length = 62;
    // Along the main street, both sides and both halves; rows that face -Z run towards -X.
    build({.name = "house_ne", .begin = {h, 0, -h}, .turn_deg = 0, .length_m = length});
    build({.name = "house_sw", .begin = {-h, 0, h}, .turn_deg = 180, .length_m = length});
    build({.name = "house_nw", .begin = {-h - length, 0, -h}, .turn_deg = 0, .length_m = length});
    build({.name = "house_se", .begin = {h + length, 0, h}, .turn_deg = 180, .length_m = length});
    // Along the crossing street, behind them.
    const float behind = h + 10.5F;
    const float side = 30;
    build({.name = "house_en", .begin = {h, 0, -behind - side}, .turn_deg = -90, .length_m = side});
    build({.name = "house_es", .begin = {h, 0, behind}, .turn_deg = -90, .length_m = side});
    build({.name = "house_wn", .begin = {-h, 0, -behind}, .turn_deg = 90, .length_m = side});
    build({.name = "house_ws", .begin = {-h, 0, behind + side}, .turn_deg = 90, .length_m = side});
    furnish_pavements(street, random);
    plant_surroundings(street, random);
    return street;
}

struct Box {
    vec3 low{1e9F};
    vec3 high{-1e9F};
};

std::map<std::string, Box> boxes_of(const World& world) {
    std::map<std::string, Box> boxes;
    for (const WorldPart& part : world.parts) {
        Box& box = boxes[part.room];
        for (const vec3& p : part.mesh.positions) {
            // Rounded as in the file.
            const vec3 rounded = glm::round(p * 1e4F) / 1e4F;
            box.low = glm::min(box.low, rounded);
            box.high = glm::max(box.high, rounded);
        }
    }
    return boxes;
}

std::string line_of(const std::string& kind, const std::string& id, const glm::dvec3& move, double turn_deg,
                    double size, const std::string& material) {
    std::string text = kind + " " + id;
    for (int k = 0; k < 3; ++k) text += " " + obj_number(move[k]);
    text += " 0 " + obj_number(turn_deg) + " 0";
    for (int k = 0; k < 3; ++k) text += " " + obj_number(size);
    return text + " " + material + "\n";
}

// Instance line of the file format. Instances are positioned by their centre, `instance` by its origin at `foot`.
std::string instance_line(const StaticInstance& instance, const Box& box) {
    const vec3 middle = 0.5F * (box.low + box.high);
    const Frame turned{instance.foot,
                       rotation({0, 1, 0}, static_cast<float>(radians(static_cast<double>(instance.turn_deg))))};
    return line_of("instance", instance.object, turned.point(instance.size * middle), instance.turn_deg, instance.size,
                   "-");
}

// Traffic lights at the four stop lines, facing the vehicles that come.
std::string signal_lines(const TrafficFrame& frame, const std::map<std::string, Box>& boxes) {
    struct Place {
        vec3 foot;
        float turn_deg;
    };
    constexpr float kAlong_m = 11.8F;
    constexpr float kBeside_m = 4.4F;
    const std::array<Place, 4> places{Place{{-kAlong_m, kKerb_m, kBeside_m}, -90},
                                      {{kAlong_m, kKerb_m, -kBeside_m}, 90},
                                      {{kBeside_m, kKerb_m, kAlong_m}, 0},
                                      {{-kBeside_m, kKerb_m, -kAlong_m}, 180}};
    std::string text;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const SignalColour colour = i < 2 ? frame.main_signal : frame.cross_signal;
        const std::string object = kSignals.at(static_cast<std::size_t>(colour));
        text += instance_line({object, places.at(i).foot, places.at(i).turn_deg, 1}, boxes.at(object));
    }
    return text;
}

std::string frame_text(const TrafficFrame& frame, const std::map<std::string, Box>& boxes, double fov_degrees) {
    std::string text;
    for (const VehiclePose& vehicle : frame.vehicles) {
        const StaticInstance instance{vehicle.model, vec3(vehicle.place), static_cast<float>(vehicle.turn_deg), 1};
        text += instance_line(instance, boxes.at(vehicle.model));
    }
    text += "camera";
    for (const glm::dvec3& p : {frame.view.eye, frame.view.at}) {
        for (int k = 0; k < 3; ++k) text += " " + obj_number(p[k]);
    }
    return text + " " + obj_number(fov_degrees) + "\n";
}

ordered_json triple(const vec3& v) {
    ordered_json list = ordered_json::array();
    for (int k = 0; k < 3; ++k) list.push_back(std::round(static_cast<double>(v[k]) * 1e4) / 1e4);
    return list;
}

ordered_json lights_of_street(const Street& street, bool night) {
    ordered_json lights = ordered_json::array();
    lights.push_back({{"kind", "directional"},
                      {"name", night ? "moon" : "sun"},
                      {"aim", triple(kSunAim)},
                      {"lux", night ? 9 : 700},
                      {"colour", night ? triple({0.55F, 0.65F, 1.0F}) : triple({1.0F, 0.92F, 0.79F})}});
    if (night) {
        for (const vec3& place : street.street_lights) {
            lights.push_back({{"kind", "spot"},
                              {"name", "street lamp"},
                              {"location", triple(place)},
                              {"aim", {0, -1, 0}},
                              {"intensity", {1.5, 1.12, 0.66}},
                              {"attenuation", {0.3, 0, 0.06}},
                              {"beam_deg", 60},
                              {"cut_off_deg", 158},
                              {"reach", 13}});
        }
        for (const vec3& place : street.shop_lights) {
            lights.push_back({{"kind", "point"},
                              {"name", "shop"},
                              {"location", triple(place)},
                              {"intensity", {1.0, 0.82, 0.55}},
                              {"attenuation", {0.5, 0, 0.25}},
                              {"reach", 6}});
        }
    }
    return {
        {"replace", true}, {"lights", lights}, {"environment", {{"file", "sky.exr"}, {"scale", 1}, {"seen", true}}}};
}

struct Sky {
    vec3 zenith;
    vec3 horizon;
};

Sky sky_of(bool night) {
    if (night) return {{0.03F, 0.04F, 0.09F}, {0.1F, 0.12F, 0.2F}};
    return {{0.32F, 0.53F, 0.82F}, {0.797F, 0.848F, 0.896F}};  // kHaze in sRGB
}

std::string frame_name(std::size_t number) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame-%04zu.obj", number);
    return name.data();
}

ordered_json frames_json(std::size_t count, const Scenario& scenario) {
    const Sky sky = sky_of(scenario.night);
    ordered_json frames = ordered_json::array();
    for (std::size_t i = 0; i < count; ++i) frames.push_back(frame_name(i));
    return {{"base", "../../../../models/street.obj"},
            {"models", {"../../../../models/source/cars/cars.obj"}},
            {"frames_per_second", scenario.frames_per_second},
            {"haze_m", kHazeVisibility_m},
            {"lights", "lights.json"},
            {"background", {{"zenith", triple(sky.zenith)}, {"horizon", triple(sky.horizon)}}},
            {"frames", frames}};
}

Status write_model(const World& world, const std::set<std::string>& unlit, const fs::path& folder,
                   const std::string& name, const std::string& more) {
    const ObjTexts texts = obj_texts(world, name + ".mtl", unlit);
    for (const auto& [file, image] : world.textures) {
        if (Status status = write_png(folder / file, image); !status) return status;
    }
    if (Status status = write_file(folder / (name + ".mtl"), texts.mtl); !status) return status;
    return write_file(folder / (name + ".obj"), texts.obj + more);
}

std::size_t triangles_of(const World& world, const std::string& object) {
    std::size_t count = 0;
    for (const WorldPart& part : world.parts) count += part.room == object ? part.mesh.triangles.size() : 0;
    return count;
}

}  // namespace

Result<StreetStatistics> write_street(const StreetOptions& options, const fs::path& output) {
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output, "files of a street", options.force));
    const fs::path map = staged.temporary_path() / "maps" / options.name / "anim";
    const fs::path models = staged.temporary_path() / "models";
    std::error_code error;
    for (const fs::path& folder : {map / "configs", map / "out", models / "source" / "cars"}) {
        fs::create_directories(folder, error);
        if (error) return Error{folder.string() + ": cannot be created; choose another folder"};
    }
    const Street street = make_street(options);
    const std::map<std::string, Box> boxes = boxes_of(street.world);
    std::string still;
    StreetStatistics figures;
    std::set<std::string> instanced(kSignals.begin(), kSignals.end());
    for (const StaticInstance& instance : street.instances) {
        still += instance_line(instance, boxes.at(instance.object));
        figures.static_triangles += triangles_of(street.world, instance.object);
        instanced.insert(instance.object);
    }
    for (const auto& [object, box] : boxes) {
        if (!instanced.contains(object)) figures.static_triangles += triangles_of(street.world, object);
    }
    for (const WorldObject& object : street.world.objects) {
        if (options.objects.empty()) break;
        const fs::path file = fs::path(options.objects) / (object.name + ".rso");
        still += line_of("instance", (fs::path("..") / file).generic_string(), object.foot, object.turn_deg,
                         object.size, "-");
        std::error_code ignored;  // the folder may not exist yet
        if (!fs::exists((fs::absolute(output) / file).lexically_normal(), ignored)) {
            figures.missing.insert(file.filename().string());
        }
    }
    still += "camera -44 1.9 5.6 -10 2 -1 65\n";
    RS_TRY(write_model(street.world, street.unlit, models, "street", still));
    std::set<std::string> unlit;
    const World vehicles = make_vehicles(options.scenario.night, unlit);
    RS_TRY(write_model(vehicles, unlit, models / "source" / "cars", "cars", ""));
    const std::map<std::string, Box> vehicle_boxes = boxes_of(vehicles);
    const std::vector<TrafficFrame> frames = simulate_traffic(options.scenario);
    const auto write_out = [&](const std::string& name, const std::string& text) {
        return write_file(map / "out" / name, text);
    };
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const std::string text =
            signal_lines(frames[i], boxes) + frame_text(frames[i], vehicle_boxes, options.scenario.fov_degrees);
        RS_TRY(write_out(frame_name(i), text));
        figures.vehicles = std::max(figures.vehicles, frames[i].vehicles.size());
    }
    figures.frames = frames.size();
    const bool night = options.scenario.night;
    const int sky_height = std::max(static_cast<int>(512 * options.texture_scale), 16);
    const fs::path scenario = map / "configs" / "scenario.json";
    RS_TRY(write_file(scenario, scenario_json(options.scenario)));
    RS_TRY(write_exr(map / "out" / "sky.exr", sky_image(night, sky_height)));
    const std::string lights = lights_of_street(street, night).dump(1) + "\n";
    RS_TRY(write_out("lights.json", lights));
    const std::string json = frames_json(frames.size(), options.scenario).dump(1) + "\n";
    RS_TRY(write_out("frames.json", json));
    RS_TRY(staged.commit());
    return figures;
}

}  // namespace rs::synthetic
