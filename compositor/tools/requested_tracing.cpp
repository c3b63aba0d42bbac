#include "compositor/tools/requested_tracing.hpp"

#include "rayspace/base/printable.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

namespace rs::compositor {
namespace {

// MM, or f/N.
Result<CameraLens> parse_lens(const std::string& text, double focus) {
    constexpr std::string_view kFNumber = "f/";
    constexpr double kMost = 1e6;
    const bool is_f_number = text.starts_with(kFNumber);
    const std::string_view digits = std::string_view(text).substr(is_f_number ? kFNumber.size() : 0);
    double number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{} || end != digits.data() + digits.size() || !(number > 0 && number <= kMost)) {
        return Error{"--lens " + printable(text) + ": must be the opening in mm, as 25, or an f-number, as f/2.8"};
    }
    if (!(focus > 0)) return Error{"--lens " + text + ": nothing would be sharp; add --focus DISTANCE"};
    CameraLens lens;
    (is_f_number ? lens.f_number : lens.aperture_mm) = number;
    lens.focus = focus;
    return lens;
}

}  // namespace

std::optional<TracedMethod> requested_method(const ViewArguments& arguments) {
    for (const NamedMethod& named : kTracedMethods) {
        if (arguments.renderer == named.name) return named.method;
    }
    return std::nullopt;
}

Result<TracedOptions> requested_tracing(const ViewArguments& arguments) {
    TracedOptions options;
    options.method = requested_method(arguments).value_or(TracedMethod::kPath);
    options.exposure_ev = arguments.exposure_ev;
    options.soft_shadows = arguments.soft_shadows;
    if (arguments.toon_lines >= 0) options.line_radius = arguments.toon_lines;
    if (arguments.lens.empty()) return options;
    const Result<CameraLens> lens = parse_lens(arguments.lens, arguments.focus);
    if (!lens) return lens.error();
    options.lens = *lens;
    return options;
}

}  // namespace rs::compositor
