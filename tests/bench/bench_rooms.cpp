// Streaming benchmark: a walk in real time through six rooms of eight objects each, of which two rooms fit into memory.
// Measures frame times, and the objects that are missing in the visitor's room.
//
//     bench_rooms [--size WxH] [--speed UNITS_PER_S] [--views N] [--side PX]
//
// Draws without a window. Prints a table of two walks: with all objects in memory, and with a budget of two rooms.
// Nothing else should run on the machine.

#include "compositor/gl/context.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/frame_times.hpp"
#include "compositor/viewer/showroom.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/compositor/six_rooms.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/sphere_object.hpp"
#include "tests/support/temporary_folder.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>

#include <unistd.h>

namespace rs::compositor {
namespace {

struct Arguments {
    std::string size = "1280x720";
    double speed = 2;
    int views = 48;
    int side = 256;
};

constexpr double kFrames_per_s = 30;

// Textured ball with a shape map and coded images.
RaySpaceObject make_object(const Arguments& arguments) {
    test::RingObjectOptions options;
    options.views = arguments.views;
    options.width = arguments.side;
    options.height = arguments.side;
    options.fl_px = 1.6 * arguments.side;
    options.camera_height = 0.3;
    const test::Sphere sphere;
    RaySpaceObject object = test::sphere_object(options, sphere);
    std::vector<Image<Rgba8>> images;
    for (const RigView& view : test::ring_rig(options).views) {
        images.push_back(test::sphere_image(sphere, view.camera));
    }
    for (PlanarImage& image : object.images) image = {};
    object.coded = std::make_shared<codec::CodedImages>(test::code_images(object, images, {}));
    return object;
}

std::int64_t resident_bytes() {
    std::ifstream file("/proc/self/statm");
    std::int64_t all = 0;
    std::int64_t resident = 0;
    file >> all >> resident;
    return resident * sysconf(_SC_PAGESIZE);
}

double mebibytes(std::int64_t bytes) {
    return static_cast<double>(bytes) / (1 << 20);
}

// Memory of one object: when loaded, and while it is read.
struct ObjectBytes {
    std::int64_t object = 0;
    std::int64_t reading = 0;
};
Result<ObjectBytes> measure_object(const std::filesystem::path& file) {
    const auto engine = std::make_shared<engine::RenderSession>();
    const std::unique_ptr<ObjectSource> source = make_file_source(engine, false);
    RS_ASSIGN_OR_RETURN(const std::int64_t most, source->most_bytes(file));
    RS_ASSIGN_OR_RETURN(const ViewableObject object, source->read(file, most, [](float) {}));
    return ObjectBytes{object.memory_bytes(), most};
}

// Missing objects in the visitor's room. Rooms that are visible through doors do not count: the budget allows only
// placeholders there.
class MissingInRoom {
public:
    void add_frame(const Camera& camera, const FrameStatistics& statistics) {
        const auto now = std::chrono::steady_clock::now();
        const double seconds =
            last_ == std::chrono::steady_clock::time_point() ? 0 : std::chrono::duration<double>(now - last_).count();
        last_ = now;
        missing_s_.resize(statistics.nodes.size());
        const std::size_t first = test::room_at(camera.centre().z) * test::kObjectsInRoom;
        for (std::size_t i = first; i < first + test::kObjectsInRoom; ++i) {
            if (statistics.nodes[i].missing) missing_s_[i] += seconds;
        }
    }
    // Number of objects that were missing, and the longest time in seconds.
    [[nodiscard]] std::pair<std::size_t, double> result() const {
        std::pair<std::size_t, double> result;
        for (const double seconds : missing_s_) {
            result.first += seconds > 0 ? 1 : 0;
            result.second = std::max(result.second, seconds);
        }
        return result;
    }

private:
    std::vector<double> missing_s_;  // [node]
    std::chrono::steady_clock::time_point last_;
};

Status walk(const char* name, const Scene& scene, const ShowroomOptions& options, const Arguments& arguments) {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(arguments.size));
    const std::int64_t resident_before = resident_bytes();
    std::int64_t resident_most = 0;
    Showroom showroom(scene, options);
    RS_ASSIGN_OR_RETURN(FrameCompositor compositor,
                        FrameCompositor::create(scene, showroom.engine(), showroom.nodes(),
                                                {.width = size.width, .height = size.height, .time_parts = true}));
    const double length = test::kRooms * test::kRoomSide;
    const auto frames = static_cast<int>(length / arguments.speed * kFrames_per_s);
    const std::vector<Camera> cameras = test::walk_through(frames, size.width, size.height);
    FrameTimes times;
    MissingInRoom missing_objects;
    // Starts when the first room is loaded and has faded in.
    RS_TRY(showroom.wait_for_all(cameras.front().centre()));
    for (int n = 0; n < 15; ++n) {
        FrameTimes before;
        RS_TRY(before.draw(showroom, compositor, cameras.front(), 1 / kFrames_per_s));
    }
    const CacheStatistics at_start = showroom.statistics();
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const std::chrono::duration<double> due(static_cast<double>(i) / kFrames_per_s);
        std::this_thread::sleep_until(begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(due));
        RS_TRY(times.draw(showroom, compositor, cameras[i], 1 / kFrames_per_s));
        resident_most = std::max(resident_most, resident_bytes());
        missing_objects.add_frame(cameras[i], compositor.statistics());
    }
    const CacheStatistics store = showroom.statistics();
    const auto [missing, missing_s] = missing_objects.result();
    std::printf("%-12s %6zu %7.1f %7.1f %6.2f %9zu %9.0f %6d %6d %8.0f %9.1f %9.1f %9.1f\n", name, times.frames(),
                times.median_ms(), times.longest_ms(), times.longest_ms() / times.median_ms(), missing, 1e3 * missing_s,
                store.loads - at_start.loads, store.evictions, 1e3 * store.longest_load_s,
                mebibytes(std::min(store.budget_bytes, std::int64_t{1} << 40)), mebibytes(store.peak_bytes),
                mebibytes(resident_most - resident_before));
    std::fflush(stdout);
    if (store.peak_bytes > store.budget_bytes) return Error{"the budget was exceeded"};
    return {};
}

Status run(const Arguments& arguments) {
    test::TemporaryFolder folder;
    const std::filesystem::path first = folder / "0-0.rso";
    RS_TRY(write_object(first, make_object(arguments)));
    const auto file_of = [&](int room, int number) {
        return folder / (std::to_string(room) + "-" + std::to_string(number) + ".rso");
    };
    for (int room = 0; room < test::kRooms; ++room) {
        for (int n = 0; n < test::kObjectsInRoom; ++n) {
            if (room + n > 0) std::filesystem::copy_file(first, file_of(room, n));
        }
    }
    const Scene scene = test::six_rooms(file_of);
    RS_ASSIGN_OR_RETURN(const ObjectBytes bytes, measure_object(first));
    RS_ASSIGN_OR_RETURN(gl::Context context, gl::Context::create_surfaceless());
    std::printf(
        "%s; %d rooms of %d objects: %d views of %dx%d, %.1f MiB each, %.1f MiB while they are read; file %.0f KiB\n",
        context.device_name().c_str(), test::kRooms, test::kObjectsInRoom, arguments.views, arguments.side,
        arguments.side, mebibytes(bytes.object), mebibytes(bytes.reading),
        static_cast<double>(std::filesystem::file_size(first)) / 1024);
    std::printf("%-12s %6s %7s %7s %6s %9s %9s %6s %6s %8s %9s %9s %9s\n", "walk", "frames", "median", "longest",
                "ratio", "missing", "longest", "loads", "evict.", "longest", "budget", "peak", "resident");
    std::printf("%-12s %6s %7s %7s %6s %9s %9s %6s %6s %8s %9s %9s %9s\n", "", "", "ms", "ms", "", "times", "ms", "",
                "", "load ms", "MiB", "MiB", "+MiB");
    RS_TRY(walk("all loaded", scene, {.memory_bytes = 49 * bytes.object + bytes.reading, .waits = true}, arguments));
    return walk("two rooms", scene, {.memory_bytes = 2 * test::kObjectsInRoom * bytes.object + bytes.reading},
                arguments);
}

}  // namespace
}  // namespace rs::compositor

int main(int argc, char** argv) {
    CLI::App app("Walks through six rooms whose objects are read on the way.", "bench_rooms");
    rs::compositor::Arguments arguments;
    app.add_option("--size", arguments.size, "frame size, WxH")->capture_default_str();
    app.add_option("--speed", arguments.speed, "walking speed, units per second; a room is 6 units long")
        ->capture_default_str();
    app.add_option("--views", arguments.views, "captured images per object")->capture_default_str();
    app.add_option("--side", arguments.side, "width and height of a captured image, px")->capture_default_str();
    std::function<rs::Status()> run;
    app.callback([&] { run = [&] { return rs::compositor::run(arguments); }; });
    return rs::tool_main(app, argc, argv, run);
}
