#include "compositor/tools/traced_run.hpp"

#include "compositor/tools/requested_scene.hpp"
#include "compositor/tools/requested_tracing.hpp"
#include "compositor/tools/view_tiles.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <chrono>
#include <utility>

namespace rs::compositor {

Result<std::unique_ptr<TracedRenderer>> requested_tracer(const ViewArguments& arguments, const Scene& scene,
                                                         Showroom& showroom) {
    if (!requested_method(arguments) || !arguments.tiles.empty()) return std::unique_ptr<TracedRenderer>();
    const Result<TracedOptions> options = requested_tracing(arguments);
    if (!options) return options.error();
    if (const Status status = showroom.wait_for_all({0, 0, 0}); !status) return status.error();
    auto tracer = TracedRenderer::create(scene, showroom.placed(), *options);
    if (!tracer) return Error{arguments.scene + ": " + tracer.error().message};
    print_warnings(tracer->warnings());
    return std::make_unique<TracedRenderer>(std::move(*tracer));
}

std::shared_ptr<const Image<Rgba8>> trace(TracedRenderer& tracer, const ViewArguments& arguments, const Camera& camera,
                                          Progress& progress) {
    constexpr int kUsualPasses = 64;
    const int passes = arguments.passes > 0 ? arguments.passes : arguments.seconds > 0 ? 0 : kUsualPasses;
    const auto begin = std::chrono::steady_clock::now();
    const auto late = [&] {
        const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
        return arguments.seconds > 0 && gone.count() >= arguments.seconds;
    };
    tracer.look(camera);
    if (passes > 0) progress.start("tracing", passes);
    do {
        tracer.add_pass();
        if (passes > 0) progress.advance();
    } while ((passes == 0 || tracer.passes() < passes) && !late());
    if (passes > 0) progress.finish();
    return std::make_shared<const Image<Rgba8>>(tracer.image());
}

Status run_tile(const ViewArguments& arguments, const Scene& scene, Showroom& showroom,
                const std::vector<Camera>& cameras) {
    const Result<TileRequest> tile = parse_tile(arguments.tile, cameras);
    if (!tile) return tile.error();
    const Result<std::unique_ptr<TracedRenderer>> tracer = requested_tracer(arguments, scene, showroom);
    if (!tracer) return tracer.error();
    (*tracer)->set_part(tile->place);
    ProgressBar progress(arguments.quiet);
    return write_tile(arguments, *tile, *trace(**tracer, arguments, cameras[tile->frame], progress));
}

Status run_probe(const ViewArguments& arguments) {
    constexpr int kUsualSamples = 256;
    const Result<Triple> place = parse_triple(arguments.probe, "--probe");
    if (!place) return place.error();
    const Result<Scene> scene = requested_scene(arguments);
    if (!scene) return scene.error();
    print_warnings(scene->warnings);
    const auto tracer = TracedRenderer::create(*scene, {}, {});
    if (!tracer) return Error{arguments.scene + ": " + tracer.error().message};
    print_warnings(tracer->warnings());
    ProgressBar progress(arguments.quiet);
    const int samples = arguments.passes > 0 ? arguments.passes : kUsualSamples;
    return write_exr(arguments.output, tracer->probe({place->x, place->y, place->z}, samples, progress));
}

}  // namespace rs::compositor
