#include "rayspace/page/plots.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/page/svg_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs {
namespace {

constexpr double kPoint_px = 2.5;

// The legend is beside the curves: a line of the curve's colour and its name.
constexpr double kLegendText_px = 42;     // from the curves to the name
constexpr double kLegendLetter_px = 7.5;  // upper estimate of the mean letter width at 13 px
constexpr double kLeastLegend_px = 130;

std::string axes(const LinePlot& plot, const PlotFrame& frame) {
    std::string svg;
    for (int n = 0; n < frame.x.count(); ++n) {
        const double value = frame.x.low + n * frame.x.step;
        const double x = frame.x_px(value);
        svg += svg_line(x, frame.top, x, frame.bottom, "stroke:var(--rule)");
        svg += svg_text(x, frame.bottom + 16, "middle", tick_label(value, frame.x.step));
    }
    for (int n = 0; n < frame.y.count(); ++n) {
        const double value = frame.y.low + n * frame.y.step;
        const double y = frame.y_px(value);
        svg += svg_line(frame.left, y, frame.right, y, "stroke:var(--rule)");
        svg += svg_text(frame.left - 6, y + 4, "end", tick_label(value, frame.y.step));
    }
    svg += svg_line(frame.left, frame.bottom, frame.right, frame.bottom, "stroke:var(--faint)");
    svg += svg_line(frame.left, frame.top, frame.left, frame.bottom, "stroke:var(--faint)");
    svg += svg_text((frame.left + frame.right) / 2, plot.height_px - 6, "middle", plot.x_label);
    const double middle = (frame.top + frame.bottom) / 2;
    svg += svg_text(14, middle, "middle", plot.y_label, " transform=\"rotate(-90 14 " + two_decimals(middle) + ")\"");
    svg += svg_text(frame.left, 18, "start", plot.title, " style=\"font-weight:600\"");
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

std::string draw_standalone_svg(const LinePlot& plot) {
    return standalone_svg(draw_svg(plot));
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
    // Aim at 8 steps at most; rounding the ends outwards may add two.
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

std::string draw_svg(const LinePlot& plot) {
    const PlotFrame frame = plot_frame(plot);
    std::string svg = svg_head(plot.width_px, plot.height_px, plot.title);
    svg += axes(plot, frame);
    for (std::size_t n = 0; n < plot.series.size(); ++n) {
        const std::string colour = series_colour(n);
        svg += curve(plot.series[n], frame, colour);
        const double y = frame.top + 10 + 20 * static_cast<double>(n);
        svg += svg_line(frame.right + 14, y, frame.right + 36, y, "stroke:" + colour + ";stroke-width:3");
        svg += svg_text(frame.right + kLegendText_px, y + 4, "start", plot.series[n].name);
    }
    return svg + "</svg>";
}

}  // namespace rs
