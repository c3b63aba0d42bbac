#include "rayspace/page/plots.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/page/svg_parts.hpp"

#include <algorithm>
#include <cmath>

namespace rs {
namespace {

constexpr double kLine_px = 18;
constexpr double kMargin_px = 34;

// Shortens a title to the plot's width, at a UTF-8 character boundary.
std::string shorten(const std::string& title) {
    std::size_t most = 58;
    if (title.size() <= most) return title;
    while (most > 0 && (static_cast<unsigned char>(title[most]) & 0xC0U) == 0x80) --most;
    return title.substr(0, most) + "\xE2\x80\xA6";
}

struct PolarFrame {
    double x = 0, y = 0, radius_px = 0;  // the pole, and the distance of `most` from it
    double most = 1;
    [[nodiscard]] double x_px(double angle_rad, double radius) const {
        return x + std::sin(angle_rad) * radius / most * radius_px;
    }
    [[nodiscard]] double y_px(double angle_rad, double radius) const {
        return y + std::cos(angle_rad) * radius / most * radius_px;
    }
};

std::string rings_and_spokes(const PolarFrame& frame, const AxisTicks& ticks) {
    std::string svg;
    const std::string rule = "stroke:var(--rule);fill:none";
    for (int n = 1; n < ticks.count(); ++n) {
        const double value = n * ticks.step;
        svg += "<circle cx=\"" + two_decimals(frame.x) + "\" cy=\"" + two_decimals(frame.y) + "\" r=\"" +
               two_decimals(value / frame.most * frame.radius_px) + "\" style=\"" + rule + "\"/>\n";
    }
    for (int spoke = -150; spoke <= 180; spoke += 30) {
        const double angle = radians(spoke);
        svg += svg_line(frame.x, frame.y, frame.x_px(angle, frame.most), frame.y_px(angle, frame.most), rule);
        const double beyond = frame.most * (1 + 16 / frame.radius_px);
        svg += svg_text(frame.x_px(angle, beyond), frame.y_px(angle, beyond) + 4, "middle",
                        std::to_string(std::abs(spoke)) + "\xC2\xB0", " style=\"fill:var(--faint);font-size:11px\"");
    }
    // White background, since curves may cross the labels.
    for (int n = 1; n < ticks.count(); ++n) {
        const double value = n * ticks.step;
        svg += svg_text(frame.x_px(radians(165), value), frame.y_px(radians(165), value) + 4, "middle",
                        tick_label(value, ticks.step),
                        " style=\"fill:var(--faint);font-size:11px;stroke:#fff;stroke-width:3;paint-order:stroke\"");
    }
    return svg;
}

}  // namespace

std::string draw_standalone_svg(const PolarPlot& plot) {
    double most = 0;
    for (const PolarCurve& curve : plot.curves) {
        RS_CHECK(curve.angle_rad.size() == curve.radius.size());
        for (const double radius : curve.radius) most = std::max(most, radius);
    }
    const AxisTicks ticks = axis_ticks(0, most > 0 ? most : 1);
    const double head_px = kLine_px * static_cast<double>(plot.notes.size() + plot.curves.size() + 1) + 14;
    PolarFrame frame;
    frame.radius_px = plot.side_px / 2.0 - kMargin_px;
    frame.x = plot.side_px / 2.0;
    frame.y = head_px + plot.side_px / 2.0;
    frame.most = ticks.high;
    std::string svg = svg_head(plot.side_px, static_cast<int>(std::ceil(head_px)) + plot.side_px, plot.title);
    double y = kLine_px + 4;
    svg += svg_text(16, y, "start", shorten(plot.title), " style=\"font-weight:600\"");
    for (const std::string& note : plot.notes) svg += svg_text(16, y += kLine_px, "start", note);
    for (std::size_t n = 0; n < plot.curves.size(); ++n) {
        y += kLine_px;
        svg += svg_line(16, y - 4, 44, y - 4, "stroke:" + series_colour(n) + ";stroke-width:3");
        svg += svg_text(52, y, "start", plot.curves[n].name + ", " + plot.unit);
    }
    svg += rings_and_spokes(frame, ticks);
    for (std::size_t n = 0; n < plot.curves.size(); ++n) {
        const PolarCurve& curve = plot.curves[n];
        std::string path;
        for (std::size_t i = 0; i < curve.radius.size(); ++i) {
            path += (i == 0 ? "M" : "L") + two_decimals(frame.x_px(curve.angle_rad[i], curve.radius[i])) + " " +
                    two_decimals(frame.y_px(curve.angle_rad[i], curve.radius[i]));
        }
        svg += "<path d=\"" + path + "\" style=\"fill:none;stroke:" + series_colour(n) + ";stroke-width:1.8\"/>\n";
    }
    return standalone_svg(svg + "</svg>\n");
}

}  // namespace rs
