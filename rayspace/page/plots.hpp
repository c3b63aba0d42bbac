#pragma once
// Plots as SVG: named series over common axes with ticks, grid and legend (line_plot.cpp), and curves over angles
// (polar_plot.cpp).

#include <string>
#include <vector>

namespace rs {

/// A series of a line plot.
struct PlotSeries {
    std::string name;
    std::vector<double> x;
    std::vector<double> y;  // same size as x; points that are not finite interrupt the line
};

struct LinePlot {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<PlotSeries> series;
    int width_px = 900;
    int height_px = 340;
};

/// Ticks of an axis: `low` and `high` are multiples of `step`, which is 1, 2 or 5 times a power of ten, and enclose
/// least..most; 3 to 11 ticks. If least >= most the axis has one step to each side.
struct AxisTicks {
    double low = 0;
    double high = 1;
    double step = 1;
    [[nodiscard]] int count() const;  // ticks, both ends included
};
AxisTicks axis_ticks(double least, double most);

/// Mapping of a plot's values to SVG pixels.
struct PlotFrame {
    AxisTicks x, y;
    double left = 0, top = 0, right = 0, bottom = 0;  // px
    [[nodiscard]] double x_px(double value) const { return left + (value - x.low) / (x.high - x.low) * (right - left); }
    [[nodiscard]] double y_px(double value) const {
        return bottom - (value - y.low) / (y.high - y.low) * (bottom - top);
    }
};
PlotFrame plot_frame(const LinePlot& plot);

/// Draws a plot. Colours are the variables --s0 .. --s4 of HtmlPage's style, in turn. Text is escaped.
std::string draw_svg(const LinePlot& plot);

/// Draws a plot as a standalone SVG file with colours, on white.
std::string draw_standalone_svg(const LinePlot& plot);

/// A curve of a polar plot.
struct PolarCurve {
    std::string name;
    std::vector<double> angle_rad;  // from the bottom, positive to the right
    std::vector<double> radius;     // same size as angle_rad, >= 0 and finite
};

/// Polar plot of named curves over angles, 0 at the bottom, as in photometric diagrams of hanging luminaires.
struct PolarPlot {
    std::string title;
    std::string unit;                // unit of the radius, such as "cd"
    std::vector<std::string> notes;  // lines under the title
    std::vector<PolarCurve> curves;  // 5 colours, then they repeat
    int side_px = 560;
};

/// Draws the plot in black on white, with rings at round numbers and spokes every 30 degrees. Text is escaped.
std::string draw_standalone_svg(const PolarPlot& plot);

}  // namespace rs
