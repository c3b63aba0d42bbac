// Error of the tracing renderers against a converged path-traced image, after a given time or number of passes.
//
//     bench_light SCENE --eye X,Y,Z --at X,Y,Z [--fov DEG] [--size WxH] [--lights L.json] [--exposure EV]
//                 [--reference PASSES] [--seconds S] [--passes N]
//
// The reference is traced first, with different random numbers. Then each renderer runs for S seconds and, if --passes
// is given, for N passes. "mean" is relative to the reference's mean luminance; "error" is the RMS luminance difference
// relative to that mean; "dB" is the PSNR of the 8-bit images (radiosity: filtered); "cpu" is the CPU time of all
// threads. On a loaded machine, choose S by the CPU time.

#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/light/directions.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/lit_scene.hpp"
#include "tests/bench/stopwatch.hpp"

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

namespace rs::compositor {
namespace {

struct Arguments {
    LitSceneArguments lit{"480x300"};
    double seconds = 15;
    int reference = 1024;
    int passes = 0;
};

struct RenderedImages {
    Image<RgbaF> radiance;
    Image<Rgba8> shown;
};

double luminance_of(const RgbaF& p) {
    return p.a > 0 ? static_cast<double>(luminance({p.r, p.g, p.b})) : 0;
}

struct Taken {
    double wall_s = 0;
    double cpu_s = 0;
};

void print_row(const char* name, const TracedRenderer& renderer, const Taken& taken, const RenderedImages& reference) {
    const Image<RgbaF> radiance = renderer.radiance();
    double sum = 0, reference_sum = 0, squares = 0;
    for (int y = 0; y < radiance.height(); ++y) {
        for (int x = 0; x < radiance.width(); ++x) {
            const double a = luminance_of(radiance(x, y)), b = luminance_of(reference.radiance(x, y));
            sum += a;
            reference_sum += b;
            squares += (a - b) * (a - b);
        }
    }
    const double pixels = static_cast<double>(radiance.width()) * radiance.height();
    double difference = 0;
    const Image<Rgba8> shown = renderer.image();
    for (int y = 0; y < shown.height(); ++y) {
        for (int x = 0; x < shown.width(); ++x) {
            const Rgba8 a = shown(x, y), b = reference.shown(x, y);
            for (const int d : {a.r - b.r, a.g - b.g, a.b - b.b}) difference += static_cast<double>(d) * d;
        }
    }
    std::printf("%-10s %7.2f s %8.2f s cpu %6d passes  mean %6.4f  error %6.2f %%  %5.2f dB\n", name, taken.wall_s,
                taken.cpu_s, renderer.passes(), sum / reference_sum,
                100 * std::sqrt(squares / pixels) / (reference_sum / pixels),
                10 * std::log10(255.0 * 255.0 * 3 * pixels / std::max(difference, 1e-9)));
}

Status run(const Arguments& arguments) {
    const Result<LitScene> lit = read_lit_scene(arguments.lit);
    if (!lit) return lit.error();
    const Camera& camera = lit->camera;
    auto renderer = TracedRenderer::create(lit->scene, {}, {.exposure_ev = arguments.lit.exposure_ev});
    if (!renderer) return renderer.error();
    // A minimal offset decorrelates its noise from that of the others.
    Camera aside = camera;
    aside.world_from_camera[3].x += 1e-7;
    ProgressBar progress(false);
    progress.start("reference", arguments.reference);
    renderer->begin_image(aside);
    while (renderer->passes() < arguments.reference) {
        renderer->add_pass();
        progress.advance();
    }
    progress.finish();
    const RenderedImages reference{renderer->radiance(), renderer->image()};

    const auto trace = [&](const NamedMethod& named, double seconds, int passes) {
        renderer->set_method(named.method);
        renderer->begin_image(camera);
        const bench::Stopwatch watch;
        Taken taken;
        do {
            renderer->add_pass();
            taken = {watch.wall_s(), watch.cpu_s()};
        } while (passes > 0 ? renderer->passes() < passes : taken.wall_s < seconds);
        print_row(named.name, *renderer, taken, reference);
        std::fflush(stdout);
    };
    for (const NamedMethod& named : kTracedMethods) trace(named, arguments.seconds, 0);
    if (arguments.passes > 0) {
        for (const NamedMethod& named : kTracedMethods) trace(named, 0, arguments.passes);
    }
    return {};
}

}  // namespace
}  // namespace rs::compositor

int main(int argc, char** argv) {
    using namespace rs::compositor;
    CLI::App app("Error of tracing renderers against a converged image", "bench_light");
    Arguments arguments;
    arguments.lit.add_to(app);
    app.add_option("--reference", arguments.reference, "passes of the reference")->capture_default_str();
    app.add_option("--seconds", arguments.seconds, "seconds per renderer")->capture_default_str();
    app.add_option("--passes", arguments.passes, "measure each renderer after N passes, too");
    std::function<rs::Status()> action;
    app.callback([&] { action = [&] { return run(arguments); }; });
    return rs::tool_main(app, argc, argv, action);
}
