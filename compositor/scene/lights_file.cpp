#include "compositor/scene/lights_file.hpp"

#include "compositor/scene/strict_json.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/pictures/picture_io.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::uint64_t kMostListBytes = 4U << 20U;
constexpr std::size_t kMostLights = 4096;
constexpr double kMostDistant = 1e6;
constexpr double kShortest = 1e-6;
constexpr double kStrongest = 1e12;

// Across and along an aim; along x across = -aim, so that an area of these halves shines to where it is aimed. Across
// lies where +X is best seen, or +Z where the aim is along X.
struct Axes {
    glm::dvec3 across, along;
};
Axes axes_of(const glm::dvec3& aim, double turn_rad) {
    const glm::dvec3 towards = std::abs(aim.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 across = glm::normalize(towards - glm::dot(towards, aim) * aim);
    const glm::dvec3 quarter = glm::cross(-aim, across);  // counter-clockwise, seen from behind the light
    return {std::cos(turn_rad) * across + std::sin(turn_rad) * quarter,
            std::cos(turn_rad) * quarter - std::sin(turn_rad) * across};
}

class ListReader {
public:
    explicit ListReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

    Light read(JsonObject object) {
        const JsonValue kind_value = object.take("kind");
        const std::string kind = kind_value.text();
        Light light;
        const glm::vec3 colour =
            object.has("colour") ? glm::vec3(object.take("colour").triple(0, kStrongest)) : glm::vec3(1);
        if (kind == "directional") {
            light = directional_light(object.take("aim").direction(), watts(object, "lux") * colour);
            if (object.has("ambient")) light.ambient = glm::vec3(object.take("ambient").triple(0, kStrongest));
        } else if (kind == "point" || kind == "spot") {
            const glm::dvec3 location = object.take("location").triple(-kMostDistant, kMostDistant);
            light = object.has("intensity") ? fading_light(object, location, colour)
                                            : point_light(location, watts(object, "candela") * colour);
            if (object.has("reach")) light.radius = object.take("reach").number(kShortest, kMostDistant);
            if (kind == "spot") read_cone(object, light);
        } else if (kind == "rectangle" || kind == "disc") {
            read_area(object, kind == "disc", colour, light);
        } else if (kind == "luminaire") {
            read_luminaire_light(object, light);
            light.colour = colour;
        } else {
            throw kind_value.wrong("must be directional, point, spot, rectangle, disc or luminaire");
        }
        if (object.has("name")) light.name = object.take("name").text();
        object.expect_all_taken();
        if (Status fine = check_light(light); !fine) throw object.wrong(fine.error().message);
        return light;
    }

    [[nodiscard]] EnvironmentLight read_environment(JsonObject object) const {
        const JsonValue file = object.take("file");
        Result<Image<RgbaF>> pixels = read_radiance(folder_ / file.text());
        if (!pixels) throw file.wrong(pixels.error().message);
        EnvironmentLight light;
        light.pixels = std::make_shared<const Image<RgbaF>>(std::move(*pixels));
        if (object.has("scale")) light.scale = static_cast<float>(object.take("scale").number(0, kStrongest));
        if (object.has("turn_deg")) {
            light.turn_rad = static_cast<float>(radians(object.take("turn_deg").number(-36000, 36000)));
        }
        if (object.has("seen")) light.seen = object.take("seen").boolean();
        object.expect_all_taken();
        return light;
    }

private:
    static float watts(JsonObject& object, const char* key) {
        return static_cast<float>(object.take(key).number(0, kStrongest) / kLumensPerWatt);
    }

    // Phong's E and f(r) = min(1 / (c0 + c1 r + c2 r^2), 1).
    static Light fading_light(JsonObject& object, const glm::dvec3& location, const glm::vec3& colour) {
        Light light;
        light.kind = LightKind::kPoint;
        light.location = location;
        light.colour = glm::vec3(object.take("intensity").triple(0, kStrongest)) * colour;
        light.radius = std::numeric_limits<double>::infinity();
        if (!object.has("attenuation")) return light;
        const JsonValue attenuation = object.take("attenuation");
        light.attenuation = glm::vec3(attenuation.triple(0, kStrongest));
        if (light.attenuation == glm::vec3(0)) throw attenuation.wrong("is nowhere above 0; give [1, 0, 0]");
        return light;
    }

    static void read_cone(JsonObject& object, Light& light) {
        light.kind = LightKind::kSpot;
        light.towards = object.take("aim").direction();
        const JsonValue cut_off = object.take("cut_off_deg");
        light.cut_off_rad = radians(cut_off.number(0.1, 180)) / 2;
        light.beam_width_rad = light.cut_off_rad;
        if (object.has("beam_deg")) light.beam_width_rad = radians(object.take("beam_deg").number(0, 180)) / 2;
        if (light.beam_width_rad > light.cut_off_rad) throw cut_off.wrong("must not be below beam_deg");
    }

    static void read_area(JsonObject& object, bool round, const glm::vec3& colour, Light& light) {
        light.kind = round ? LightKind::kDisc : LightKind::kRectangle;
        light.location = object.take("location").triple(-kMostDistant, kMostDistant);
        const double turn = object.has("turn_deg") ? radians(object.take("turn_deg").number(-36000, 36000)) : 0;
        const Axes axes = axes_of(object.take("aim").direction(), turn);
        const JsonValue size = object.take("size");
        double across = 0, along = 0;
        if (round) {
            across = along = size.number(kShortest, kMostDistant);
        } else {
            size.list_size(2, 2);
            across = size.item(0).number(kShortest, kMostDistant);
            along = size.item(1).number(kShortest, kMostDistant);
        }
        light.half_u = 0.5 * along * axes.along;
        light.half_v = 0.5 * across * axes.across;
        if (object.has("lumens") == object.has("radiance")) throw object.wrong("must have either lumens or radiance");
        if (object.has("radiance")) {
            light.colour = glm::vec3(object.take("radiance").triple(0, kStrongest)) * colour;
        } else {
            light.colour = watts(object, "lumens") / static_cast<float>(kPi * area_of(light)) * colour;
        }
    }

    void read_luminaire_light(JsonObject& object, Light& light) {
        light.kind = LightKind::kLuminaire;
        light.location = object.take("location").triple(-kMostDistant, kMostDistant);
        const glm::dvec3 aim = object.has("aim") ? object.take("aim").direction() : glm::dvec3(0, -1, 0);
        const double turn = object.has("turn_deg") ? radians(object.take("turn_deg").number(-36000, 36000)) : 0;
        const Axes axes = axes_of(aim, turn);
        // Its X, -Z and aim: planes C0 and C90, and the nadir.
        light.world_from_luminaire = glm::dmat3(axes.across, -aim, -axes.along);
        const JsonValue file = object.take("file");
        const std::filesystem::path path = folder_ / file.text();
        auto& read = luminaires_[path.string()];
        if (!read) {
            Result<Luminaire> luminaire = read_luminaire(path);
            if (!luminaire) throw file.wrong(luminaire.error().message);
            read = std::make_shared<const Luminaire>(std::move(*luminaire));
        }
        light.luminaire = read;
    }

    std::filesystem::path folder_;
    std::map<std::string, std::shared_ptr<const Luminaire>> luminaires_;
};

}  // namespace

Result<LightList> light_list_from_json(const std::string& text, const std::filesystem::path& path) {
    try {
        const nlohmann::json json = parse_json_text(text, path.string());
        JsonObject top(JsonValue(json, path.string(), ""));
        LightList list;
        if (top.has("replace")) list.replace = top.take("replace").boolean();
        ListReader reader(path.parent_path());
        const JsonValue lights = top.take("lights");
        const std::size_t count = lights.list_size(0, kMostLights);
        for (std::size_t i = 0; i < count; ++i) list.lights.push_back(reader.read(JsonObject(lights.item(i))));
        if (top.has("environment")) list.environment = reader.read_environment(JsonObject(top.take("environment")));
        top.expect_all_taken();
        return list;
    } catch (const MalformedJson& malformed) {
        return Error{malformed.message};
    }
}

Result<LightList> read_light_list(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMostListBytes);
    if (!bytes) return bytes.error();
    return light_list_from_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

}  // namespace rs::compositor
