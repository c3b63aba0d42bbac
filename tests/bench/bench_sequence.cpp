// Frame times of sequences, and the work repeated per frame.
//
//     bench_sequence thousand                   1000 moving boxes over 150,000 static triangles
//     bench_sequence play FOLDER                a sequence's frames at 1280x720
//     bench_sequence play FOLDER --renderer whitted --size 640x360 --passes 1
//
// "cpu" is the CPU time per frame, summed over all threads: divided by the number of cores, a lower bound of the frame
// time on an idle machine.

#include "compositor/gl/context.hpp"
#include "compositor/playback/sequence_player.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rs::bench {
namespace {

using compositor::GeometryNode;
using compositor::Mesh;
using compositor::Scene;
using compositor::Sequence;
using compositor::SequencePlayer;

struct Options {
    std::string folder;
    std::string size = "1280x720";
    std::string renderer = "raster";
    std::string weather;
    int passes = 1;
    int frames = 50;
    int samples = 4;
    bool shadows = false;
    bool upright = false;
    bool parts = false;
};

// Terrain of 150,000 triangles.
std::shared_ptr<const Mesh> hills() {
    constexpr int kSide = 274;
    auto mesh = std::make_shared<Mesh>();
    for (int y = 0; y <= kSide; ++y) {
        for (int x = 0; x <= kSide; ++x) {
            compositor::MeshVertex vertex;
            const float u = static_cast<float>(x) / kSide * 200 - 100;
            const float v = static_cast<float>(y) / kSide * 200 - 100;
            vertex.position = {u, 2 * std::sin(0.13F * u) * std::cos(0.11F * v), v};
            vertex.normal = glm::normalize(glm::vec3(-0.26F * std::cos(0.13F * u) * std::cos(0.11F * v), 1,
                                                     0.22F * std::sin(0.13F * u) * std::sin(0.11F * v)));
            mesh->vertices.push_back(vertex);
        }
    }
    const auto at = [](int x, int y) { return static_cast<std::uint32_t>(y * (kSide + 1) + x); };
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            for (const std::uint32_t i :
                 {at(x, y), at(x, y + 1), at(x + 1, y + 1), at(x, y), at(x + 1, y + 1), at(x + 1, y)})
                mesh->indices.push_back(i);
        }
    }
    return mesh;
}

std::shared_ptr<const Sequence> thousand_boxes() {
    constexpr int kBoxes = 1000;
    auto sequence = std::make_shared<Sequence>();
    Scene& scene = sequence->scene;
    scene.shading = compositor::Shading::kPhong;
    GeometryNode ground;
    ground.mesh = hills();
    scene.geometry.push_back(ground);
    const auto box = std::make_shared<const Mesh>(compositor::box_mesh({2, 1.5, 1}));
    for (int i = 0; i < kBoxes; ++i) {
        GeometryNode node;
        node.mesh = box;
        node.moving = static_cast<std::uint32_t>(i);
        sequence->slots.push_back({{scene.geometry.size()}, glm::dvec3(0), {}});
        scene.geometry.push_back(node);
    }
    for (int f = 0; f < 12; ++f) {
        compositor::SequenceFrame frame;
        for (int i = 0; i < kBoxes; ++i) {
            compositor::InstancePose pose;
            pose.move = {3.0 * (i % 32) - 48 + 0.2 * f, 3, 3.0 * (i / 32) - 48};
            pose.turn_deg = {0, 7.0 * i + 3 * f, 0};
            frame.poses.push_back({static_cast<std::uint32_t>(i), false, pose});
        }
        frame.camera = compositor::SequenceCamera{{{0, 30, 75}, {0, 0, 0}}, radians(60)};
        sequence->frames.push_back(std::move(frame));
    }
    return sequence;
}

Result<compositor::PlayerOptions> player_options(const Options& options) {
    const Result<PixelSize> size = parse_size(options.size);
    if (!size) return size.error();
    compositor::PlayerOptions player;
    player.frame.width = size->width;
    player.frame.height = size->height;
    player.frame.samples = options.samples;
    player.frame.shadows = options.shadows;
    player.frame.upright_images = options.upright;
    player.frame.time_parts = options.parts;
    player.passes = options.passes;
    for (const compositor::NamedMethod& named : compositor::kTracedMethods) {
        if (options.renderer == named.name) player.tracing = compositor::TracedOptions{.method = named.method};
    }
    if (options.weather.empty()) return player;
    const auto weather = compositor::parse_weather(options.weather);
    if (!weather) return weather.error();
    player.weather = *weather;
    return player;
}

void print_times(const char* what, std::vector<double> wall_ms, std::vector<double> cpu_ms) {
    const double longest = *std::max_element(wall_ms.begin(), wall_ms.end());
    const double wall = median(wall_ms);
    std::printf("%-28s median %8.2f ms (%.1f frames/s), longest %8.2f ms, cpu %8.2f ms\n", what, wall, 1000 / wall,
                longest, median(cpu_ms));
}

// Times the frames from the second on; with `parts`, also their parts, waiting for each.
Status time_frames(SequencePlayer& player, int frames, const char* what, bool parts) {
    std::vector<double> wall_ms;
    std::vector<double> cpu_ms;
    std::vector<double> maps_ms;
    std::vector<double> geometry_ms;
    std::vector<double> objects_ms;
    std::vector<int> maps;
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(frames), player.frames());
    for (std::size_t i = 0; i < count; ++i) {
        const Stopwatch watch;
        const auto frame = player.frame(i);
        if (!frame) return frame.error();
        if (i == 0 && count > 1) continue;
        wall_ms.push_back(watch.wall_ms());
        cpu_ms.push_back(watch.cpu_ms());
        const compositor::FrameStatistics& statistics = player.compositor().statistics();
        maps_ms.push_back(1e3 * statistics.shadows_s);
        geometry_ms.push_back(1e3 * statistics.geometry_s);
        objects_ms.push_back(1e3 * (statistics.engine_wait_s + statistics.upload_s + statistics.composite_s));
        maps.push_back(statistics.shadow_maps_drawn);
    }
    print_times(what, wall_ms, cpu_ms);
    if (parts) {
        std::printf("  including %.2f ms for %d shadow maps, %.2f ms geometry, %.2f ms objects and blending\n",
                    median(maps_ms), median(maps), median(geometry_ms), median(objects_ms));
    }
    return {};
}

Status run_thousand(const Options& options) {
    auto context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    const auto sequence = thousand_boxes();
    std::printf("%zu static triangles, %zu instances\n", sequence->scene.geometry[0].mesh->indices.size() / 3,
                sequence->slots.size());
    const auto with = player_options(options);
    if (!with) return with.error();
    auto player = SequencePlayer::create(sequence, *with);
    if (!player) return player.error();
    if (const auto first = player->frame(0); !first) return first.error();
    const int uploads = player->compositor().uploads();
    const auto second = player->frame(1);
    if (!second) return second.error();
    auto fresh = SequencePlayer::create(sequence, *with);
    if (!fresh) return fresh.error();
    const auto again = fresh->frame(1);
    if (!again) return again.error();
    const bool same = std::equal(second->pixels().begin(), second->pixels().end(), again->pixels().begin());
    std::printf("second frame against a fresh load: %s\n", same ? "same bytes" : "DIFFERENT");
    if (Status status = time_frames(*player, 12, options.renderer.c_str(), options.parts); !status) return status;
    std::printf("meshes and images uploaded: %d before the first frame, %d after it\n", uploads,
                player->compositor().uploads() - uploads);
    std::vector<double> ms;
    for (std::size_t i = 0; i < 40; ++i) {
        const Stopwatch watch;
        const auto moved = slot_transforms(*sequence, i % 12);
        ms.push_back(watch.wall_ms());
    }
    std::printf("matrices of 1000 instances: median %.3f ms\n", median(ms));
    return {};
}

Status run_play(const Options& options) {
    auto context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    auto sequence = compositor::read_sequence(options.folder);
    if (!sequence) return sequence.error();
    const auto with = player_options(options);
    if (!with) return with.error();
    auto player = SequencePlayer::create(std::make_shared<const Sequence>(std::move(*sequence)), *with);
    if (!player) return player.error();
    return time_frames(*player, options.frames, (options.renderer + " " + options.size).c_str(), options.parts);
}

}  // namespace
}  // namespace rs::bench

int main(int argc, char** argv) {
    CLI::App app("Times the frames of sequences", "bench_sequence");
    app.require_subcommand(1);
    rs::bench::Options options;
    std::function<rs::Status()> run;
    CLI::App* thousand = app.add_subcommand("thousand", "1000 instances over 150,000 triangles");
    CLI::App* play = app.add_subcommand("play", "a sequence");
    play->add_option("FOLDER", options.folder, "folder of the sequence")->required();
    play->add_option("--frames", options.frames, "number of timed frames")->capture_default_str();
    play->add_option("--weather", options.weather, "weather, as for rs-view");
    for (CLI::App* command : {thousand, play}) {
        command->add_option("--size", options.size, "frame size, WxH")->capture_default_str();
        command->add_option("--renderer", options.renderer, "raster, or a tracing renderer")->capture_default_str();
        command->add_option("--passes", options.passes, "passes of a tracing renderer")->capture_default_str();
        command->add_option("--samples", options.samples, "samples per pixel of raster")->capture_default_str();
        command->add_flag("--shadows", options.shadows, "shadows in raster");
        command->add_flag("--parts", options.parts, "times of the parts of raster frames, waiting for each");
        command->add_flag("--upright", options.upright, "render objects with upright cameras, as in a window");
    }
    thousand->callback([&] { run = [&] { return rs::bench::run_thousand(options); }; });
    play->callback([&] { run = [&] { return rs::bench::run_play(options); }; });
    return rs::tool_main(app, argc, argv, run);
}
