#include "compositor/scene/light/lights_file.hpp"

#include "compositor/scene/strict_json.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/pictures/picture_io.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::uint64_t kMostListBytes = 4U << 20U;
constexpr std::size_t kMostLights = 4096;
constexpr double kMostTurned_deg = 36000;
constexpr std::uint32_t kMostScope = 1U << 20U;

class ListReader {
public:
    explicit ListReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

    LightEntry read(JsonObject object) {
        const JsonValue kind_value = object.take("kind");
        const std::string kind = kind_value.text();
        LightEntry entry;
        if (!known_kind(kind, entry.kind)) {
            throw kind_value.wrong("must be directional, point, spot, rectangle, disc or luminaire");
        }
        if (object.has("colour")) entry.colour = object.take("colour").triple(0, kStrongest);
        if (entry.kind != LightKind::kDirectional) {
            entry.location = object.take("location").triple(-kMostDistant, kMostDistant);
        }
        switch (entry.kind) {
            case LightKind::kDirectional:
                entry.aim = aim_of(object);
                entry.power = power_of(object, "lux");
                break;
            case LightKind::kPoint:
            case LightKind::kSpot:
                read_punctual(object, entry);
                break;
            case LightKind::kRectangle:
            case LightKind::kDisc:
                read_area(object, entry);
                break;
            case LightKind::kLuminaire:
                read_luminaire_light(object, entry);
                break;
        }
        if (object.has("ambient")) entry.ambient = object.take("ambient").triple(0, kStrongest);
        if (object.has("scope")) {
            entry.scope = static_cast<std::uint32_t>(object.take("scope").whole_number(0, kMostScope));
        }
        if (object.has("name")) entry.name = object.take("name").text();
        object.expect_all_taken();
        if (Status fine = check_light(light_of(entry)); !fine) throw object.wrong(fine.error().message);
        return entry;
    }

    [[nodiscard]] EnvironmentEntry read_environment(JsonObject object) const {
        EnvironmentEntry entry;
        const JsonValue file = object.take("file");
        entry.file = folder_ / file.text();
        Result<Image<RgbaF>> pixels = read_radiance(entry.file);
        if (!pixels) throw file.wrong(pixels.error().message);
        entry.pixels = std::make_shared<const Image<RgbaF>>(std::move(*pixels));
        if (object.has("scale")) entry.scale = object.take("scale").number(0, kStrongest);
        entry.turn_deg = turn_of(object);
        if (object.has("seen")) entry.seen = object.take("seen").boolean();
        object.expect_all_taken();
        return entry;
    }

private:
    static bool known_kind(const std::string& word, LightKind& kind) {
        for (const LightKind known : {LightKind::kDirectional, LightKind::kPoint, LightKind::kSpot,
                                      LightKind::kRectangle, LightKind::kDisc, LightKind::kLuminaire}) {
            if (word != name_of(known)) continue;
            kind = known;
            return true;
        }
        return false;
    }

    static double power_of(JsonObject& object, const char* key) { return object.take(key).number(0, kStrongest); }

    static glm::dvec3 aim_of(JsonObject& object) {
        const JsonValue aim = object.take("aim");
        static_cast<void>(aim.direction());  // refuses what is none
        return aim.triple(-kMostDistant, kMostDistant);
    }

    static double turn_of(JsonObject& object) {
        return object.has("turn_deg") ? object.take("turn_deg").number(-kMostTurned_deg, kMostTurned_deg) : 0;
    }

    static void read_punctual(JsonObject& object, LightEntry& entry) {
        if (object.has("intensity")) {
            entry.radiance = object.take("intensity").triple(0, kStrongest);
            if (object.has("attenuation")) {
                const JsonValue attenuation = object.take("attenuation");
                entry.attenuation = attenuation.triple(0, kStrongest);
                if (entry.attenuation == glm::dvec3(0)) {
                    throw attenuation.wrong("is nowhere above 0; give [1, 0, 0]");
                }
            }
        } else {
            entry.power = power_of(object, "candela");
        }
        if (object.has("reach")) entry.reach = object.take("reach").number(kShortest, kMostDistant);
        if (entry.kind == LightKind::kPoint) return;
        entry.aim = aim_of(object);
        const JsonValue cut_off = object.take("cut_off_deg");
        entry.cut_off_deg = cut_off.number(kLeastCutOff_deg, 180);
        entry.beam_deg = object.has("beam_deg") ? object.take("beam_deg").number(0, 180) : entry.cut_off_deg;
        if (entry.beam_deg > entry.cut_off_deg) throw cut_off.wrong("must not be below beam_deg");
    }

    static void read_area(JsonObject& object, LightEntry& entry) {
        entry.turn_deg = turn_of(object);
        entry.aim = aim_of(object);
        const JsonValue size = object.take("size");
        if (entry.kind == LightKind::kDisc) {
            entry.size = glm::dvec2(size.number(kShortest, kMostDistant));
        } else {
            size.list_size(2, 2);
            entry.size = {size.item(0).number(kShortest, kMostDistant), size.item(1).number(kShortest, kMostDistant)};
        }
        if (object.has("lumens") == object.has("radiance")) throw object.wrong("must have either lumens or radiance");
        if (object.has("radiance")) {
            entry.radiance = object.take("radiance").triple(0, kStrongest);
        } else {
            entry.power = power_of(object, "lumens");
        }
    }

    void read_luminaire_light(JsonObject& object, LightEntry& entry) {
        if (object.has("aim")) entry.aim = aim_of(object);
        entry.turn_deg = turn_of(object);
        if (object.has("dimmer")) entry.power = power_of(object, "dimmer");
        const JsonValue file = object.take("file");
        entry.file = folder_ / file.text();
        auto& read = luminaires_[entry.file.string()];
        if (!read) {
            Result<Luminaire> luminaire = read_luminaire(entry.file);
            if (!luminaire) throw file.wrong(luminaire.error().message);
            read = std::make_shared<const Luminaire>(std::move(*luminaire));
        }
        entry.luminaire = read;
    }

    std::filesystem::path folder_;
    std::map<std::string, std::shared_ptr<const Luminaire>> luminaires_;
};

}  // namespace

std::optional<EnvironmentLight> environment_of(const std::optional<EnvironmentEntry>& entry) {
    if (!entry) return std::nullopt;
    return EnvironmentLight{entry->pixels, static_cast<float>(entry->scale),
                            static_cast<float>(radians(entry->turn_deg)), entry->seen};
}

Result<LightList> light_list_from_json(const std::string& text, const std::filesystem::path& path) {
    try {
        const nlohmann::json json = parse_json_text(text, path.string());
        JsonObject top(JsonValue(json, path.string(), ""));
        LightList list;
        if (top.has("replace")) list.replace = top.take("replace").boolean();
        ListReader reader(path.parent_path());
        if (top.has("headlight")) list.headlight = top.take("headlight").boolean();
        const JsonValue lights = top.take("lights");
        const std::size_t count = lights.list_size(0, kMostLights);
        for (std::size_t i = 0; i < count; ++i) {
            list.entries.push_back(reader.read(JsonObject(lights.item(i))));
            list.lights.push_back(light_of(list.entries.back()));
        }
        if (top.has("environment")) {
            list.environment_entry = reader.read_environment(JsonObject(top.take("environment")));
            list.environment = environment_of(list.environment_entry);
        }
        top.expect_all_taken();
        return list;
    } catch (const MalformedJson& malformed) {
        return Error{printable(malformed.message)};  // files may have any names
    }
}

Result<LightList> read_light_list(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMostListBytes);
    if (!bytes) return bytes.error();
    return light_list_from_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

}  // namespace rs::compositor
