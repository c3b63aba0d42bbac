#include "compositor/tools/window_run.hpp"

#include "compositor/tools/requested_scene.hpp"
#include "compositor/tools/requested_tracing.hpp"
#include "compositor/window/visit.hpp"
#include "compositor/window/wall_visit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {

Result<Window> open_window(const ViewArguments& arguments, PixelSize size) {
    return Window::create(
        {.title = arguments.scene.empty() ? "rs-view" : arguments.scene, .width = size.width, .height = size.height});
}

Status run_visit(Window window, const ViewArguments& arguments, const Scene& scene, std::unique_ptr<Showroom> showroom,
                 const std::string& executor, const Camera& first) {
    VisitOptions options;
    options.wire_frame = arguments.wire_frame;
    options.samples = arguments.samples;
    options.exposure_ev = arguments.exposure_ev;
    const Result<TracedOptions> tracing = requested_tracing(arguments);
    if (!tracing) return tracing.error();
    options.tracing = *tracing;
    options.traced = requested_method(arguments).has_value();
    if (!arguments.lights.empty()) options.lights = arguments.lights;
    options.shadows = arguments.shadows == "on";
    options.executor = executor;
    options.object_depth = requested_depth(arguments);
    options.object_samples = arguments.object_samples;
    options.warn = print_warnings;
    Viewpoint begin;
    begin.world_from_camera = first.world_from_camera;
    begin.field_of_view_rad = 2 * std::atan(0.5 * std::min(first.width, first.height) / first.fl_y);
    options.viewpoints.push_back(begin);
    options.viewpoints.insert(options.viewpoints.end(), scene.viewpoints.begin(), scene.viewpoints.end());
    return visit(std::move(window), scene, std::move(showroom), options);
}

Status run_walls(const ViewArguments& arguments, const Scene& scene, const WallViews& views,
                 std::unique_ptr<Showroom> showroom) {
    if (requested_method(arguments)) return Error{"--renderer " + arguments.renderer + ": on walls it needs -o FOLDER"};
    const auto tracked = [&views, warned = false]() mutable {
        const std::optional<Head> head = newest_head(views);
        if (views.tracker->dropped() > 0 && !std::exchange(warned, true)) {
            print_warnings({views.tracker->place().text() + ": a datagram " + views.tracker->first_fault() +
                            "; it is dropped, as others like it will be"});
        }
        return head;
    };
    WallVisitOptions options{.display = views.display,
                             .heads = views.heads,
                             .place = views.places.front(),
                             .stereo = views.stereo,
                             .samples = arguments.samples,
                             .exposure_ev = arguments.exposure_ev,
                             .object_depth = requested_depth(arguments),
                             .object_samples = arguments.object_samples,
                             .warn = print_warnings};
    if (views.tracker) options.tracked = tracked;
    Status left = visit_walls(scene, std::move(showroom), options);
    if (views.tracker && views.tracker->dropped() > 1) {
        print_warnings({views.tracker->place().text() + ": of " + std::to_string(views.tracker->received()) +
                        " datagrams " + std::to_string(views.tracker->dropped()) + " were dropped"});
    }
    return left;
}

}  // namespace rs::compositor
