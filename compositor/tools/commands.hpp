#pragma once
// The subcommands of rs-view. Each add_*_command() adds one subcommand to `app`; its callback checks how its options go
// together and sets `run`.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::compositor {

/// `open`: a window to walk through a scene.
void add_open_command(CLI::App& app, std::function<Status()>& run);
/// `render`: images, videos or folders of frames, without a window.
void add_render_command(CLI::App& app, std::function<Status()>& run);
/// `quilt`: light-field quilts for displays with horizontal parallax.
void add_quilt_command(CLI::App& app, std::function<Status()>& run);
/// `walls`: off-axis projections for CAVEs and power walls, in windows or as images.
void add_walls_command(CLI::App& app, std::function<Status()>& run);
/// `sequence`: frames of extended OBJ over a base scene, in a window or as images and videos.
void add_sequence_command(CLI::App& app, std::function<Status()>& run);
/// `probe`: the light that reaches a point, as an environment map.
void add_probe_command(CLI::App& app, std::function<Status()>& run);
/// `lights`: the lights of a scene as a JSON list.
void add_lights_command(CLI::App& app, std::function<Status()>& run);
/// `export`: a scene as binary glTF.
void add_export_command(CLI::App& app, std::function<Status()>& run);
/// `page`: an object or a scene as a web page.
void add_page_command(CLI::App& app, std::function<Status()>& run);
/// `tile`: plans, traces and assembles frames in tiles, for rendering on several machines.
void add_tile_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::compositor
