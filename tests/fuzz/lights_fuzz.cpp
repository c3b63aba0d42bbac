#include "compositor/scene/light/scene_lights.hpp"
#include "rayspace/api/types/check.hpp"
#include "tests/fuzz/entries.hpp"

#include <string>

namespace rs::fuzz {

// Lists without file names must survive a round trip and be usable in a scene.
int fuzz_lights(const std::uint8_t* data, std::size_t size) {
    const std::filesystem::path nowhere = "/nonexistent/lights.json";
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto list = compositor::light_list_from_json(text, nowhere);
    if (!list) {
        RS_CHECK(list.error().message.find('\n') == std::string::npos);
        return 0;
    }
    for (const Light& light : list->lights) RS_CHECK(check_light(light).ok());
    const auto written = compositor::light_list_to_json(*list, nowhere);
    RS_CHECK(written.ok());
    const auto again = compositor::light_list_from_json(*written, nowhere);
    RS_CHECK(again.ok() && again->entries.size() == list->entries.size());
    for (std::size_t i = 0; i < list->entries.size(); ++i) RS_CHECK(again->entries[i] == list->entries[i]);
    compositor::Scene scene;
    if (!compositor::add_lights(scene, *list, "fuzz")) return 0;
    RS_CHECK(scene.lights.size() >= list->lights.size());
    RS_CHECK(compositor::lights_as_list(scene).entries.size() == scene.lights.size());
    return 0;
}

}  // namespace rs::fuzz
