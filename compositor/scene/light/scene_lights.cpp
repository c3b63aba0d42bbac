#include "compositor/scene/light/scene_lights.hpp"

#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

std::map<std::uint32_t, std::vector<std::uint32_t>> scopes_of(const Scene& scene) {
    if (!scene.listed.scopes.empty()) return scene.listed.scopes;
    std::map<std::uint32_t, std::vector<std::uint32_t>> scopes;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (!scene.lights[i].everywhere) scopes[i];
    }
    for (std::uint32_t n = 0; n < scene.geometry.size(); ++n) {
        for (const std::uint32_t light : scene.geometry[n].lights) scopes[light].push_back(n);
    }
    return scopes;
}

}  // namespace

LightList lights_as_list(const Scene& scene) {
    LightList list;
    list.replace = true;
    list.headlight = scene.navigation.headlight;
    const std::size_t own = scene.lights.size() - scene.listed.entries.size();
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (i >= own) {
            list.entries.push_back(scene.listed.entries[i - own]);
        } else {
            if (!check_light(light)) continue;
            list.entries.push_back(entry_from_light(light));
            if (!light.everywhere) list.entries.back().scope = static_cast<std::uint32_t>(i);
        }
        list.lights.push_back(light_of(list.entries.back()));
    }
    list.environment_entry = scene.listed.environment;
    list.environment = environment_of(list.environment_entry);
    return list;
}

Status add_lights(Scene& scene, LightList list, const std::string& from) {
    auto scopes = scopes_of(scene);
    for (std::size_t i = 0; i < list.entries.size(); ++i) {
        const auto& scope = list.entries[i].scope;
        if (!scope || scopes.contains(*scope)) continue;
        return Error{from + ": lights[" + std::to_string(i) + "].scope: the scene's file has no light " +
                     std::to_string(*scope) + " that shines on parts of it only; leave scope out"};
    }
    if (list.replace) {
        scene.lights.clear();
        scene.listed.entries.clear();
        scene.listed.scopes = scopes;
        scene.navigation.headlight = false;
        for (GeometryNode& node : scene.geometry) node.lights.clear();
    }
    scene.navigation.headlight = scene.navigation.headlight || list.headlight;
    for (std::size_t i = 0; i < list.entries.size(); ++i) {
        const auto number = static_cast<std::uint32_t>(scene.lights.size());
        scene.lights.push_back(list.lights[i]);
        if (!list.entries[i].scope) continue;
        for (const std::uint32_t n : scopes[*list.entries[i].scope]) scene.geometry[n].lights.push_back(number);
    }
    scene.listed.entries.insert(scene.listed.entries.end(), list.entries.begin(), list.entries.end());
    scene.listed.environment = std::move(list.environment_entry);
    scene.environment = std::move(list.environment);
    return {};
}

}  // namespace rs::compositor
