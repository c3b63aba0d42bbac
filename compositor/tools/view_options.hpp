#pragma once
// What rs-view is to do, and the options that request it.

#include "compositor/scene/weather.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace rs::compositor {

struct ViewArguments {
    std::string scene;
    std::vector<std::string> objects;
    std::string output;
    std::string eye;
    std::string at;
    std::string size = "1280x720";
    double fov_deg = 0;
    double frames_per_second = 30;
    int orbit = 0;
    int samples = FrameOptions{}.samples;
    std::string viewpoint;
    std::string stats;
    std::string path;
    std::string executor = "core";
    std::string object_depth = "plane";
    int object_samples = FrameOptions{}.object_samples;
    std::int64_t memory_mib = usual_memory_budget() >> 20;
    std::string lights;
    std::string save_lights;
    std::string renderer = "raster";
    std::string probe;
    std::string plan;
    std::string tile;
    std::string tiles;
    int passes = 0;
    double seconds = 0;
    double exposure_ev = 0;
    bool soft_shadows = false;
    double toon_lines = -1;  // radius; < 0: as the scene is large
    std::string lens;
    double focus = 0;  // of the lens, and of quilts; 0: not given
    std::string walls;
    std::string wall_names;
    std::string heads;
    std::string stereo;
    double eye_distance_m = -1;  // as in the walls' file
    std::string quilt;
    std::string tile_size = "420x560";  // of a quilt
    double cone_deg = 40;
    bool size_given = false;  // by the command line
    std::string shadows = "on";
    bool upright = false;
    bool streaming = false;
    bool wire_frame = false;
    bool quiet = false;

    // Sequences.
    std::vector<std::string> sequences;
    std::string weather;
    std::uint32_t seed = 1;
    double visibility = Weather{}.visibility;
    std::size_t frame = 0;  // of an image
    std::string convert;
    bool frames_per_second_given = false;
};

// Throws CLI::ValidationError where options do not go together.
void check_sequence_options(const ViewArguments& arguments);

// `headless` is the flag, which means no more than that `output` must be there.
void add_view_options(CLI::App& app, ViewArguments& arguments, bool& headless);

}  // namespace rs::compositor
