#include "compositor/tools/tracing_options.hpp"

#include "compositor/traced/toon_file.hpp"
#include "rayspace/base/printable.hpp"

#include <charconv>
#include <chrono>
#include <string_view>
#include <system_error>
#include <vector>

namespace rs::compositor {
namespace {

// Parses MM or f/N.
Result<CameraLens> parse_lens(const std::string& text, const std::optional<double>& focus) {
    constexpr std::string_view kFNumber = "f/";
    constexpr double kMaxNumber = 1e6;
    const bool is_f_number = text.starts_with(kFNumber);
    const std::string_view digits = std::string_view(text).substr(is_f_number ? kFNumber.size() : 0);
    double number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{} || end != digits.data() + digits.size() || !(number > 0 && number <= kMaxNumber)) {
        return Error{"--lens " + printable(text) + ": must be the diameter in mm, as 25, or an f-number, as f/2.8"};
    }
    if (!focus) return Error{"--lens " + text + ": has no distance of focus; add --focus DISTANCE"};
    CameraLens lens;
    (is_f_number ? lens.f_number : lens.aperture_mm) = number;
    lens.focus = *focus;
    return lens;
}

}  // namespace

std::optional<TracedMethod> RendererOptions::method() const {
    for (const NamedMethod& named : kTracedMethods) {
        if (renderer == named.name) return named.method;
    }
    return std::nullopt;
}

void add_renderer_options(CLI::App& command, RendererOptions& options) {
    command
        .add_option("--renderer", options.renderer,
                    "raster (OpenGL), or traced: toon, whitted, radiosity, path (compositor/traced/README.md)")
        ->type_name("NAME")
        ->check(CLI::IsMember({"raster", "toon", "whitted", "radiosity", "path"}).description(""))
        ->capture_default_str();
    command
        .add_option("--exposure", options.exposure_ev,
                    "make lights brighter by EV stops, -40..40; for objects: --relight on|off (on if traced)")
        ->check(CLI::Range(-40.0, 40.0).description(""))
        ->type_name("EV")
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--relight",
            [&options](const std::string& value) {
                options.relighting = value == "on" ? Relighting::kOn : Relighting::kOff;
            },
            "scale objects by the scene's light over that of their capture (default: on if traced, but toon)")
        ->check(CLI::IsMember({"on", "off"}).description(""))
        ->type_name("on|off")
        ->group("");
    command.add_flag("--soft-shadows", options.soft_shadows, "whitted and toon: area lights cast soft shadows");
    command
        .add_option("--toon-style", options.toon_style,
                    "toon: tones, edges (traced/README.md); also --toon-lines LENGTH (0: none), --toon-objects")
        ->type_name("FILE.json");
    command.add_option("--toon-lines", options.toon_line_length, "toon: width of a line from its edge; 0: none")
        ->check(CLI::Range(0.0, 1e6).description(""))
        ->type_name("LENGTH")
        ->group("");
    command.add_flag("--toon-objects", options.toon_objects, "toon: objects are drawn in tones and with outlines, too")
        ->group("");
}

void add_lens_options(CLI::App& command, RendererOptions& options) {
    CLI::Option* lens = command
                            .add_option("--lens", options.lens,
                                        "traced: diameter of the lens in mm, or f-number on 36 mm film; blurs by depth")
                            ->type_name("MM|f/N");
    command.add_option("--focus", options.focus, "distance of sharp focus along the line of sight")
        ->check(CLI::Range(1e-6, 1e9).description(""))
        ->type_name("DISTANCE")
        ->needs(lens);
}

void add_lens_options_in_one_line(CLI::App& command, RendererOptions& options) {
    add_lens_options(command, options);
    command.get_option("--lens")->description(
        "traced: diameter of the lens in mm, or f-number on 36 mm film, sharp at --focus DISTANCE ahead");
    CLI::Option* focus = command.get_option("--focus")->group("");
    focus->remove_needs(command.get_option("--lens"));  // CLI11's message lacks the names of hidden options
}

void check_focus_option(const CLI::App& command) {
    if (command.count("--focus") == 0 || command.count("--lens") > 0) return;
    throw CLI::ValidationError("--focus needs --lens: the diameter of the lens or its f-number");
}

void require_traced_renderer(CLI::App& command, RendererOptions& options) {
    options.renderer = "path";
    command.get_option("--renderer")
        ->description("toon, whitted, radiosity or path (compositor/traced/README.md)")
        ->check(CLI::IsMember({"toon", "whitted", "radiosity", "path"}).description(""))
        ->capture_default_str();
}

void add_pass_options(CLI::App& command, PassOptions& options) {
    CLI::Option* passes =
        command.add_option("--passes", options.passes, "traced: rays per pixel of a frame (default: 64)")
            ->check(CLI::Range(1, 65536).description(""))
            ->type_name("N");
    command.add_option("--seconds", options.seconds, "traced: as many passes as fit into this time, per frame")
        ->check(CLI::Range(0.01, 86400.0).description(""))
        ->type_name("S")
        ->excludes(passes);
}

void check_renderer_options(const CLI::App& command, const RendererOptions& options) {
    const auto is_given = [&](const char* name) {
        const CLI::Option* const option = command.get_option_no_throw(name);
        return option != nullptr && option->count() > 0;
    };
    const std::optional<TracedMethod> method = options.method();
    for (const char* const name : {"--toon-lines", "--toon-style", "--toon-objects"}) {
        if (method != TracedMethod::kToon && is_given(name))
            throw CLI::ValidationError(std::string(name) + " needs --renderer toon");
    }
    if (method) return;
    for (const char* const name : {"--soft-shadows", "--lens", "--passes", "--seconds"}) {
        if (!is_given(name)) continue;
        throw CLI::ValidationError(std::string(name) +
                                   " needs a traced renderer; add --renderer path, or another that traces");
    }
}

Result<TracedOptions> traced_options(const RendererOptions& options) {
    TracedOptions traced;
    traced.method = options.method().value_or(TracedMethod::kRadiosity);
    traced.exposure_ev = options.exposure_ev;
    traced.soft_shadows = options.soft_shadows;
    traced.relighting = options.relighting;
    traced.line_radius = options.toon_line_length;
    traced.panorama = options.panorama;
    if (options.toon_style) {
        RS_ASSIGN_OR_RETURN(traced.toon, read_toon_style(*options.toon_style));
    }
    if (!options.lens) return traced;
    RS_ASSIGN_OR_RETURN(const CameraLens lens, parse_lens(*options.lens, options.focus));
    traced.lens = lens;
    return traced;
}

std::shared_ptr<const Image<Rgba8>> trace_frame(TracedRenderer& tracer, const PassOptions& limit, const Camera& camera,
                                                Progress& progress) {
    constexpr int kDefaultPasses = 64;
    tracer.begin_image(camera);
    if (limit.seconds) {
        const auto begin = std::chrono::steady_clock::now();
        const auto is_over = [&] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >= *limit.seconds;
        };
        do {
            tracer.add_pass();
        } while (!is_over());
    } else {
        const int passes = limit.passes.value_or(kDefaultPasses);
        progress.start("tracing", passes);
        for (int pass = 0; pass < passes; ++pass) {
            tracer.add_pass();
            progress.advance();
        }
        progress.finish();
    }
    return std::make_shared<const Image<Rgba8>>(tracer.image());
}

}  // namespace rs::compositor
