#include "compositor/playback/sequence_player.hpp"
#include "compositor/tools/requested_scene.hpp"
#include "compositor/tools/requested_tracing.hpp"
#include "compositor/tools/sequence_run.hpp"
#include "compositor/window/visit.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

// Until it is closed, or another sequence is requested.
Status visit_sequence(const ViewArguments& arguments, PixelSize size, const std::shared_ptr<const Sequence>& sequence,
                      std::string& next) {
    auto window = Window::create({.title = sequence->name, .width = size.width, .height = size.height});
    if (!window) return Error{window.error().message + "; give -o to write an image or a video"};
    VisitOptions options;
    options.sequence = sequence;
    options.weather = sequence->weather;
    if (!arguments.weather.empty()) {
        Result<Weather> weather = parse_weather(arguments.weather);
        if (!weather) return weather.error();
        weather->seed = arguments.seed;
        weather->visibility = arguments.visibility;
        options.weather = *weather;
    }
    const Scene scene = options.weather ? in_weather(sequence->scene, *options.weather) : sequence->scene;
    options.samples = arguments.samples;
    options.wire_frame = arguments.wire_frame;
    options.exposure_ev = arguments.exposure_ev;
    options.object_samples = arguments.object_samples;
    options.shadows = arguments.shadows == "on";
    const Result<TracedOptions> tracing = requested_tracing(arguments);
    if (!tracing) return tracing.error();
    options.tracing = *tracing;
    options.traced = requested_method(arguments).has_value();
    options.warn = print_warnings;
    options.open = [&next](const std::string& folder) { next = folder; };
    const Camera first = camera_of(*sequence, 0, size.width, size.height);
    Viewpoint begin;
    begin.world_from_camera = first.world_from_camera;
    begin.field_of_view_rad = 2 * std::atan(0.5 * std::min(first.width, first.height) / first.fl_y);
    options.viewpoints = {begin};
    auto showroom = std::make_unique<Showroom>(scene, ShowroomOptions{.memory_bytes = arguments.memory_mib << 20});
    return visit(std::move(*window), scene, std::move(showroom), options);
}

}  // namespace

Status run_sequence_window(const ViewArguments& arguments) {
    const Result<PixelSize> size = parse_size(arguments.size);
    if (!size) return size.error();
    std::shared_ptr<const Sequence> shown;
    std::string next = arguments.sequences.front();
    while (!next.empty()) {
        Result<Sequence> sequence = read_sequence(std::exchange(next, {}));
        if (sequence) {
            print_warnings(sequence->scene.warnings);
            shown = std::make_shared<const Sequence>(std::move(*sequence));
        } else if (shown) {
            print_warnings({sequence.error().message});  // what was shown before is shown on
        } else {
            return sequence.error();
        }
        if (Status status = visit_sequence(arguments, *size, shown, next); !status) return status;
    }
    return {};
}

}  // namespace rs::compositor
