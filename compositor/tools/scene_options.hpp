#pragma once
// Options of rs-view that choose the scene: its file, a list of lights, and added ray-space objects.

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct SceneOptions {
    std::optional<std::string> scene;       // or the first object file
    std::vector<std::string> more_objects;  // further object files, beside the first one
    std::vector<std::string> objects;       // FILE.rso[@X,Y,Z[,TURN_DEG[,SCALE]]]
    std::optional<std::string> lights;
};

/// Adds SCENE, --object and --lights.
void add_scene_options(CLI::App& command, SceneOptions& options);
/// Adds SCENE, required, and --lights, for subcommands that do not draw objects.
void add_scene_without_objects_options(CLI::App& command, SceneOptions& options);
/// Adds --lights.
void add_lights_option(CLI::App& command, std::optional<std::string>& lights);
/// Omits -h from the options that --help lists, for lists that would not fit on a screen.
void hide_help_option(CLI::App& command);
/// Throws CLI::ValidationError if neither a scene nor an object is given, and for several scenes.
void check_scene_options(const SceneOptions& options);

/// Reads the scene file, or makes a scene of object files (object_scene.hpp), and adds the lights and the objects.
/// Without a file, the objects get a floor. Prints the scene's warnings.
Result<Scene> load_scene(const SceneOptions& options);

/// Reads a list of lights and adds it to the scene, or replaces the scene's by it.
Status add_lights_of_file(Scene& scene, const std::string& file);

/// Files of a subcommand in addition to those of its scene. Empty names stand for options that are not given.
struct CommandFiles {
    std::vector<std::filesystem::path> outputs;
    std::vector<std::filesystem::path> inputs = {};
};

/// Refuses outputs that would overwrite a file of the scene or of its options, an input, or one another.
Status check_outputs(const SceneOptions& options, const Scene& scene, const CommandFiles& files);

/// load_scene(), then prints the warnings about the scene's lights (light_warnings.hpp) and checks the outputs.
Result<Scene> open_scene(const SceneOptions& options, const CommandFiles& files);

/// The scene's file name for messages and titles; "rs-view" if there is none.
std::string scene_name(const SceneOptions& options);

/// Prints each warning as one line on stderr.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace rs::compositor
