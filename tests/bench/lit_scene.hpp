#pragma once
// Command-line arguments of benchmarks of tracing renderers: a scene, its lights and a camera.

#include "compositor/scene/light/lights_file.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <string>
#include <utility>

namespace rs::compositor {

struct LitSceneArguments {
    std::string scene, lights, eye, at, size;
    double fov_deg = 50;
    double exposure_ev = 0;

    explicit LitSceneArguments(std::string usual_size) : size(std::move(usual_size)) {}
    void add_to(CLI::App& app) {
        app.add_option("scene", scene, "scene file")->required();
        app.add_option("--lights", lights, "list of lights");
        app.add_option("--eye", eye, "eye position, X,Y,Z")->required();
        app.add_option("--at", at, "point to look at, X,Y,Z")->required();
        app.add_option("--fov", fov_deg, "horizontal field of view, degrees")->capture_default_str();
        app.add_option("--size", size, "image size, WxH")->capture_default_str();
        app.add_option("--exposure", exposure_ev, "exposure, EV")->capture_default_str();
    }
};

struct LitScene {
    Scene scene;
    Camera camera;
};

inline Result<LitScene> read_lit_scene(const LitSceneArguments& arguments) {
    Result<Scene> scene = read_scene(arguments.scene);
    if (!scene) return scene.error();
    if (!arguments.lights.empty()) {
        Result<LightList> list = read_light_list(arguments.lights);
        if (!list) return list.error();
        if (list->replace) scene->lights.clear();
        scene->lights.insert(scene->lights.end(), list->lights.begin(), list->lights.end());
        scene->environment = std::move(list->environment);
    }
    const auto size = parse_size(arguments.size);
    if (!size) return size.error();
    const auto eye = parse_triple(arguments.eye, "--eye"), at = parse_triple(arguments.at, "--at");
    if (!eye) return eye.error();
    if (!at) return at.error();
    return LitScene{std::move(*scene), look_at_camera({eye->x, eye->y, eye->z}, {at->x, at->y, at->z},
                                                      radians(arguments.fov_deg), size->width, size->height)};
}

}  // namespace rs::compositor
