#include "rayspace/page/svg_parts.hpp"

#include "rayspace/page/html_page.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace rs {
namespace {

constexpr int kColours = 5;

}  // namespace

std::string decimal(double value, int digits) {
    std::array<char, 64> text{};
    if (!std::isfinite(value) || std::abs(value) > 1e15) return "0";
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits);
    return error == std::errc{} ? std::string(text.data(), end) : "0";
}

std::string two_decimals(double value) {
    return decimal(value, 2);
}

std::string tick_label(double value, double step) {
    const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
    // Values close to zero become 0 instead of "-0".
    return decimal(std::abs(value) < step * 1e-6 ? 0.0 : value, digits);
}

std::string svg_text(double x, double y, const std::string& anchor, const std::string& text, const std::string& more) {
    return "<text x=\"" + two_decimals(x) + "\" y=\"" + two_decimals(y) + "\" text-anchor=\"" + anchor + "\"" + more +
           ">" + escaped(text) + "</text>\n";
}

std::string svg_line(double x0, double y0, double x1, double y1, const std::string& style) {
    return "<line x1=\"" + two_decimals(x0) + "\" y1=\"" + two_decimals(y0) + "\" x2=\"" + two_decimals(x1) +
           "\" y2=\"" + two_decimals(y1) + "\" style=\"" + style + "\"/>\n";
}

std::string series_colour(std::size_t series) {
    return "var(--s" + std::to_string(series % kColours) + ")";
}

std::string svg_head(int width_px, int height_px, const std::string& title) {
    const std::string width = std::to_string(width_px);
    const std::string height = std::to_string(height_px);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"" + width + "\" height=\"" + height +
           "\" viewBox=\"0 0 " + width + " " + height + "\">\n<title>" + escaped(title) + "</title>\n";
}

std::string standalone_svg(std::string svg) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kValues = {{{"var(--ink)", "#1c1e21"},
                                                                                       {"var(--faint)", "#6b7280"},
                                                                                       {"var(--rule)", "#d5d9df"},
                                                                                       {"var(--s0)", "#1f6fd1"},
                                                                                       {"var(--s1)", "#d1571f"},
                                                                                       {"var(--s2)", "#1c8a4c"},
                                                                                       {"var(--s3)", "#9440b8"},
                                                                                       {"var(--s4)", "#9a7500"}}};
    for (const auto& [variable, value] : kValues) {
        for (std::size_t at = svg.find(variable); at != std::string::npos; at = svg.find(variable, at)) {
            svg.replace(at, variable.size(), value);
        }
    }
    svg.insert(svg.find('>') + 1,
               "<style>text{font:13px sans-serif}</style><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>");
    return svg;
}

}  // namespace rs
