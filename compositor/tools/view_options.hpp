#pragma once
// What was asked of rs-view, and the options that ask for it.

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
    std::string renderer = "raster";
    std::string probe;
    int passes = 0;
    double seconds = 0;
    double exposure_ev = 0;
    std::string shadows = "on";
    bool upright = false;
    bool streaming = false;
    bool wire_frame = false;
    bool quiet = false;
};

// `headless` is the flag, which means no more than that `output` must be there.
void add_view_options(CLI::App& app, ViewArguments& arguments, bool& headless);

}  // namespace rs::compositor
