#include "rayspace/page/line_plot.hpp"

#include "rayspace/base/check.hpp"
#include "rayspace/page/html_page.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace rs {
namespace {

constexpr int kColours = 5;
constexpr double kPoint_px = 2.5;

// The legend stands beside the curves: a line of its colour and a name each.
constexpr double kLegendText_px = 42;     // from the curves to the name
constexpr double kLegendLetter_px = 7.5;  // broad enough for the mean letter of 13 px
constexpr double kLeastLegend_px = 130;

std::string decimal(double value, int digits) {
    std::array<char, 64> text{};
    if (!std::isfinite(value) || std::abs(value) > 1e15) return "0";
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits);
    return error == std::errc{} ? std::string(text.data(), end) : "0";
}

std::string tick_label(double value, double step) {
    const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
    // A hair off zero is zero, not "-0".
    return decimal(std::abs(value) < step * 1e-6 ? 0.0 : value, digits);
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
    return "<text x=\"" + two_decimals(x) + "\" y=\"" + two_decimals(y) + "\" text-anchor=\"" + anchor + "\"" + more +
           ">" + escaped(text) + "</text>\n";
}

std::string line(double x0, double y0, double x1, double y1, const std::string& style) {
    return "<line x1=\"" + two_decimals(x0) + "\" y1=\"" + two_decimals(y0) + "\" x2=\"" + two_decimals(x1) +
           "\" y2=\"" + two_decimals(y1) + "\" style=\"" + style + "\"/>\n";
}

std::string colour_of(std::size_t series) {
    return "var(--s" + std::to_string(series % kColours) + ")";
}

std::string axes(const LinePlot& plot, const PlotFrame& frame) {
    std::string svg;
    for (int n = 0; n < frame.x.count(); ++n) {
        const double value = frame.x.low + n * frame.x.step;
        const double x = frame.x_px(value);
        svg += line(x, frame.top, x, frame.bottom, "stroke:var(--rule)");
        svg += text_at(x, frame.bottom + 16, "middle", tick_label(value, frame.x.step));
    }
    for (int n = 0; n < frame.y.count(); ++n) {
        const double value = frame.y.low + n * frame.y.step;
        const double y = frame.y_px(value);
        svg += line(frame.left, y, frame.right, y, "stroke:var(--rule)");
        svg += text_at(frame.left - 6, y + 4, "end", tick_label(value, frame.y.step));
    }
    svg += line(frame.left, frame.bottom, frame.right, frame.bottom, "stroke:var(--faint)");
    svg += line(frame.left, frame.top, frame.left, frame.bottom, "stroke:var(--faint)");
    svg += text_at((frame.left + frame.right) / 2, plot.height_px - 6, "middle", plot.x_label);
    const double middle = (frame.top + frame.bottom) / 2;
    svg += text_at(14, middle, "middle", plot.y_label, " transform=\"rotate(-90 14 " + two_decimals(middle) + ")\"");
    svg += text_at(frame.left, 18, "start", plot.title, " style=\"font-weight:600\"");
    return svg;
}

std::string curve(const PlotSeries& series, const PlotFrame& frame, const std::string& colour) {
    std::string path;
    std::string points;
    bool pen_down = false;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) {
            pen_down = false;
            continue;
        }
        const std::string x = two_decimals(frame.x_px(series.x[i]));
        const std::string y = two_decimals(frame.y_px(series.y[i]));
        path += (pen_down ? "L" : "M") + x + " " + y;
        points += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"" + two_decimals(kPoint_px) +
                  "\" style=\"fill:" + colour + "\"/>\n";
        pen_down = true;
    }
    if (path.empty()) return "";
    return "<path d=\"" + path + "\" style=\"fill:none;stroke:" + colour + ";stroke-width:1.5\"/>\n" + points;
}

}  // namespace

std::string standalone_svg_of(const LinePlot& plot) {
    std::string svg = svg_of(plot);
    svg.insert(
        svg.find('>') + 1,
        "<style>svg{background:#fff;font:13px sans-serif;--ink:#1c1e21;--faint:#6b7280;--rule:#d5d9df;--s0:#1f6fd1;"
        "--s1:#d1571f;--s2:#1c8a4c;--s3:#9440b8;--s4:#9a7500}</style>");
    return svg;
}

std::string two_decimals(double value) {
    return decimal(value, 2);
}

int AxisTicks::count() const {
    return static_cast<int>(std::lround((high - low) / step)) + 1;
}

AxisTicks axis_ticks(double least, double most) {
    if (!std::isfinite(least) || !std::isfinite(most)) return {0, 1, 1};
    if (least >= most) {
        const double around = least == 0 ? 1 : std::abs(least) * 0.05;
        most = least + around;
        least -= around;
    }
    // At most 8 steps are wanted; rounding the ends outwards may add two.
    const double rough = (most - least) / 8;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= rough * (1 - 1e-9)) {
            step = factor * power;
            break;
        }
    }
    return {std::floor(least / step + 1e-9) * step, std::ceil(most / step - 1e-9) * step, step};
}

PlotFrame plot_frame(const LinePlot& plot) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    double x_least = kInfinite, x_most = -kInfinite, y_least = kInfinite, y_most = -kInfinite;
    for (const PlotSeries& series : plot.series) {
        RS_CHECK(series.x.size() == series.y.size());
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
            x_least = std::min(x_least, series.x[i]);
            x_most = std::max(x_most, series.x[i]);
            y_least = std::min(y_least, series.y[i]);
            y_most = std::max(y_most, series.y[i]);
        }
    }
    std::size_t longest = 0;
    for (const PlotSeries& series : plot.series) longest = std::max(longest, series.name.size());
    const double legend_px =
        std::max(kLeastLegend_px, kLegendText_px + kLegendLetter_px * static_cast<double>(longest));
    PlotFrame frame;
    frame.x = axis_ticks(x_least, x_most);
    frame.y = axis_ticks(y_least, y_most);
    frame.left = 64;
    frame.top = 30;
    frame.right = plot.width_px - legend_px;
    frame.bottom = plot.height_px - 46.0;
    return frame;
}

std::string svg_of(const LinePlot& plot) {
    const PlotFrame frame = plot_frame(plot);
    const std::string width = std::to_string(plot.width_px);
    const std::string height = std::to_string(plot.height_px);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"" + width + "\" height=\"" +
                      height + "\" viewBox=\"0 0 " + width + " " + height + "\">\n<title>" + escaped(plot.title) +
                      "</title>\n";
    svg += axes(plot, frame);
    for (std::size_t n = 0; n < plot.series.size(); ++n) {
        const std::string colour = colour_of(n);
        svg += curve(plot.series[n], frame, colour);
        const double y = frame.top + 10 + 20 * static_cast<double>(n);
        svg += line(frame.right + 14, y, frame.right + 36, y, "stroke:" + colour + ";stroke-width:3");
        svg += text_at(frame.right + kLegendText_px, y + 4, "start", plot.series[n].name);
    }
    return svg + "</svg>";
}

}  // namespace rs
