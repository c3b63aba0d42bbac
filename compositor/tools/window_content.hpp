#pragma once
// Scenes and sequences that rs-view shows in a window, where one can replace the other.
//
//     file -> scene_content() or sequence_content() -> show_contents() -> next file

#include "compositor/scene/scene.hpp"
#include "compositor/tools/drawing_options.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/window/visit.hpp"
#include "compositor/window/window.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace rs::compositor {

/// Options that apply to all contents of a window.
struct WindowSettings {
    std::string size = "1280x720";
    RendererOptions renderer;
    DrawingOptions drawing;
    ExecutorOptions executor;
    std::optional<int> first_grid_cells = {};
};

/// A scene or sequence, ready to be visited.
struct WindowContent {
    std::string title;
    Scene scene;
    std::unique_ptr<Showroom> showroom;
    VisitOptions visit;
};

/// Loads a scene or object file (open_command.cpp).
Result<WindowContent> scene_content(const WindowSettings& settings, const std::string& file);
/// Loads a sequence (sequence_command.cpp).
Result<WindowContent> sequence_content(const WindowSettings& settings, const std::string& folder);

/// True for folders and files named frames.json.
bool is_sequence(const std::filesystem::path& file);

/// Loads the content that a file has.
using LoadContent = std::function<Result<WindowContent>(const std::string& file)>;

/// Shows the content until the user closes the window. Files that are opened in the window replace the content; one
/// that cannot be loaded leaves it as it is.
Status show_contents(Window window, WindowContent content, const LoadContent& load);

}  // namespace rs::compositor
