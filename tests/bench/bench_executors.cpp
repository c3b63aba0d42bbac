// Rates of executors beside the software core: nine views of objects a frame, upright or tilted, with depth and
// readback. The images are compared: executors that differ from the core end the measurement.
//
//     bench_executors vase.rso lamp.rso doll.rso --executor gpu --size 256
//
// "cpu" is the CPU time of all threads per frame, and "rate" the core's time over that of the executor.

#include "compositor/gpu/gpu_executor.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace rs::bench {
namespace {

constexpr int kViews = 9;

struct Options {
    std::vector<std::string> files;
    std::string executor = "gpu";
    int size = 256;
    int frames = 20;
    bool tilted = false;
};

struct Times {
    double wall_ms = 0;
    double cpu_ms = 0;
    std::vector<std::vector<engine::ExecutedView>> images;  // [frame]
};

// View n of a frame: the object fills the image.
Result<engine::ViewRegisters> view_of(const RaySpaceObject& object, const Options& options, int frame, int n) {
    constexpr double kDistance = 5;
    const double angle = 0.7 * n + 0.05 * frame;
    const glm::dvec3 eye(kDistance * std::sin(angle), options.tilted ? 0.5 : 0, kDistance * std::cos(angle));
    const Camera camera = look_at_camera(eye * object.units_per_radius, {0, 0, 0}, 2 * std::atan(1.05 / kDistance),
                                         options.size, options.size);
    return engine::prepare_view(object, camera);
}

Result<Times> measure(engine::Executor& executor, const std::vector<RaySpaceObject>& objects, const Options& options) {
    std::vector<int> slots;
    for (const RaySpaceObject& object : objects) {
        RS_ASSIGN_OR_RETURN(const std::optional<int> slot, executor.load(object));
        if (!slot) return Error{object.name + ": the executor has no memory for it; use fewer objects"};
        slots.push_back(*slot);
    }
    Times times;
    std::vector<double> wall, cpu;
    for (int frame = -2; frame < options.frames; ++frame) {  // two to warm up
        std::vector<engine::SlotView> views;
        for (int n = 0; n < kViews; ++n) {
            const std::size_t object = static_cast<std::size_t>(n) % objects.size();
            RS_ASSIGN_OR_RETURN(engine::ViewRegisters registers, view_of(objects[object], options, frame, n));
            views.push_back({slots[object], std::move(registers)});
        }
        const Stopwatch watch;
        RS_ASSIGN_OR_RETURN(std::vector<engine::ExecutedView> images, executor.render(views));
        if (frame < 0) continue;
        wall.push_back(watch.wall_ms());
        cpu.push_back(watch.cpu_ms());
        times.images.push_back(std::move(images));
    }
    times.wall_ms = median(wall);
    times.cpu_ms = median(cpu);
    return times;
}

Status compare(const Times& core, const Times& other) {
    for (std::size_t frame = 0; frame < core.images.size(); ++frame) {
        for (std::size_t n = 0; n < core.images[frame].size(); ++n) {
            if (core.images[frame][n].image == other.images[frame][n].image) continue;
            return Error{"frame " + std::to_string(frame) + ", view " + std::to_string(n) + " differs from the core's"};
        }
    }
    return {};
}

Status run(const Options& options) {
    std::vector<RaySpaceObject> objects;
    for (const std::string& file : options.files) {
        RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(file));
        object.coded.reset();  // decoded already
        objects.push_back(std::move(object));
    }
    const engine::ExecutorTable table = compositor::executors_with_gpu();
    RS_ASSIGN_OR_RETURN(const auto core, table.create("core"));
    RS_ASSIGN_OR_RETURN(const auto other, table.create(options.executor));
    RS_ASSIGN_OR_RETURN(const Times core_times, measure(*core, objects, options));
    RS_ASSIGN_OR_RETURN(const Times other_times, measure(*other, objects, options));
    RS_TRY(compare(core_times, other_times));
    std::printf("%d views of %dx%d a frame, medians of %d frames in ms\n", kViews, options.size, options.size,
                options.frames);
    std::printf("executor      frame     cpu    rate\n");
    std::printf("%-10s %8.2f %7.2f\n", "core", core_times.wall_ms, core_times.cpu_ms);
    std::printf("%-10s %8.2f %7.2f %7.2f\n", options.executor.c_str(), other_times.wall_ms, other_times.cpu_ms,
                core_times.wall_ms / other_times.wall_ms);
    return {};
}

}  // namespace
}  // namespace rs::bench

int main(int argc, char** argv) {
    rs::bench::Options options;
    CLI::App app("Rates of an executor beside the software core: nine views a frame.", "bench_executors");
    app.add_option("OBJECT", options.files, ".rso files, used in turn")->required();
    app.add_option("--executor", options.executor, "executor to measure")->capture_default_str();
    app.add_option("--size", options.size, "width and height of a view, px")
        ->capture_default_str()
        ->check(CLI::Range(1, 8192));
    app.add_option("--frames", options.frames, "frames")->capture_default_str()->check(CLI::Range(1, 10000));
    app.add_flag("--tilted", options.tilted, "views of tilted cameras");
    app.footer("Example:\n  bench_executors vase.rso lamp.rso doll.rso");
    std::function<rs::Status()> run = [&] { return rs::bench::run(options); };
    return rs::tool_main(app, argc, argv, run);
}
