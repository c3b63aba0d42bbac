#include "compositor/scene/light/lights_file.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::uint64_t kMaxLightList_bytes = 4U << 20U;
constexpr std::size_t kMaxLights = 4096;
constexpr double kMaxLightTurn_deg = 36000;
constexpr std::uint32_t kMaxScope = 1U << 20U;

class ListReader {
public:
    explicit ListReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

    LightEntry read(JsonObject object) {
        LightEntry entry;
        entry.kind = kind_of(object.take("kind"));
        const LightWords& words = model_of(entry).words;
        if (object.has("colour")) entry.colour = object.take("colour").triple(0, kMaxLightStrength);
        if (words.has_place) entry.location = object.take("location").triple(-kMaxLightDistance, kMaxLightDistance);
        if (words.has_aim && (!words.aims_down || object.has("aim"))) entry.aim = aim_of(object);
        if (words.turns) entry.turn_deg = turn_of(object);
        read_size(object, words, entry);
        read_power(object, words, entry);
        if (words.falls_off && object.has("reach"))
            entry.reach = object.take("reach").number(kShortest, kMaxLightDistance);
        read_numbers(object, words, entry);
        if (words.has_file) read_file(object, entry);
        if (object.has("ambient")) entry.ambient = object.take("ambient").triple(0, kMaxLightStrength);
        if (object.has("scope")) {
            entry.scope = static_cast<std::uint32_t>(object.take("scope").whole_number(0, kMaxScope));
        }
        if (object.has("name")) entry.name = object.take("name").text();
        object.expect_no_unknown_keys();
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
        object.read("scale", entry.scale, 0, kMaxLightStrength);
        entry.turn_deg = turn_of(object);
        object.read("seen", entry.seen);
        object.expect_no_unknown_keys();
        return entry;
    }

private:
    static LightKind kind_of(const JsonValue& value) {
        const std::string word = value.text();
        std::string known;
        for (std::size_t i = 0; i < kLightKinds; ++i) {
            const auto kind = static_cast<LightKind>(i);
            const char* const name = model_of(kind).words.kind;
            if (word == name) return kind;
            known += (i == 0 ? "" : i + 1 < kLightKinds ? ", " : " or ") + std::string(name);
        }
        throw value.wrong("must be " + known);
    }

    static glm::dvec3 aim_of(JsonObject& object) {
        const JsonValue aim = object.take("aim");
        static_cast<void>(aim.direction());  // throws if not a direction
        return aim.triple(-kMaxLightDistance, kMaxLightDistance);
    }

    static double turn_of(JsonObject& object) {
        return object.has("turn_deg") ? object.take("turn_deg").number(-kMaxLightTurn_deg, kMaxLightTurn_deg) : 0;
    }

    static void read_size(JsonObject& object, const LightWords& words, LightEntry& entry) {
        if (words.sizes.empty()) return;
        const JsonValue size = object.take("size");
        if (words.sizes.size() == 1) {
            entry.size = glm::dvec2(size.number(kShortest, kMaxLightDistance));
        } else {
            size.list_size(2, 2);
            entry.size = {size.item(0).number(kShortest, kMaxLightDistance),
                          size.item(1).number(kShortest, kMaxLightDistance)};
        }
    }

    static void read_power(JsonObject& object, const LightWords& words, LightEntry& entry) {
        if (words.power_is_factor && !object.has(words.power)) return;
        if (words.radiance != nullptr && object.has(words.radiance) == object.has(words.power)) {
            throw object.wrong(std::string("must have either ") + words.power + " or " + words.radiance);
        }
        if (words.radiance == nullptr || object.has(words.power)) {
            entry.power = object.take(words.power).number(0, kMaxLightStrength);
            return;
        }
        entry.radiance = object.take(words.radiance).triple(0, kMaxLightStrength);
        if (!words.falls_off || !object.has("attenuation")) return;
        const JsonValue attenuation = object.take("attenuation");
        entry.attenuation = attenuation.triple(0, kMaxLightStrength);
        if (entry.attenuation == glm::dvec3(0)) throw attenuation.wrong("is nowhere above 0; give [1, 0, 0]");
    }

    // Optional numbers default to their upper limit, which is another number of the light.
    static void read_numbers(JsonObject& object, const LightWords& words, LightEntry& entry) {
        for (const LightNumber& number : words.numbers) {
            if (number.at_most != nullptr) continue;
            entry.*number.value = object.take(number.key).number(number.lowest, number.highest);
        }
        for (const LightNumber& number : words.numbers) {
            if (number.at_most == nullptr) continue;
            const double most = entry.*number.at_most;
            entry.*number.value =
                object.has(number.key) ? object.take(number.key).number(number.lowest, number.highest) : most;
            if (entry.*number.value > most) {
                const auto other = std::ranges::find(words.numbers, number.at_most, &LightNumber::value);
                throw object.take(number.key).wrong(std::string("must not be above ") + other->key);
            }
        }
    }

    void read_file(JsonObject& object, LightEntry& entry) {
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
    return read_json(text, path.string(), [&](JsonObject& top) {
        LightList list;
        top.read("replace", list.replace);
        ListReader reader(path.parent_path());
        top.read("headlight", list.headlight);
        const JsonValue lights = top.take("lights");
        const std::size_t count = lights.list_size(0, kMaxLights);
        for (std::size_t i = 0; i < count; ++i) {
            list.entries.push_back(reader.read(JsonObject(lights.item(i))));
            list.lights.push_back(light_of(list.entries.back()));
        }
        if (top.has("environment")) {
            list.environment_entry = reader.read_environment(JsonObject(top.take("environment")));
            list.environment = environment_of(list.environment_entry);
        }
        return list;
    });
}

Result<LightList> read_light_list(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxLightList_bytes));
    return light_list_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

}  // namespace rs::compositor
