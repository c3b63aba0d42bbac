#pragma once
// A line plot as inline SVG: named series over common axes, with ticks, grid and legend.

#include <string>
#include <vector>

namespace rs {

struct PlotSeries {
    std::string name;
    std::vector<double> x;
    std::vector<double> y;  // as many as x; a point that is not finite interrupts the line
};

struct LinePlot {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<PlotSeries> series;
    int width_px = 900;
    int height_px = 340;
};

// The line of numbers that an axis shows: `low` and `high` are multiples of `step`, which is 1, 2 or 5 times a power of
// ten, and hold all of least..most; 3 to 11 ticks. Where least >= most the axis is a step to each side.
struct AxisTicks {
    double low = 0;
    double high = 1;
    double step = 1;
    [[nodiscard]] int count() const;  // ticks, both ends included
};
AxisTicks axis_ticks(double least, double most);

// Where a plot draws its points, in SVG pixels.
struct PlotFrame {
    AxisTicks x, y;
    double left = 0, top = 0, right = 0, bottom = 0;  // px
    [[nodiscard]] double x_px(double value) const { return left + (value - x.low) / (x.high - x.low) * (right - left); }
    [[nodiscard]] double y_px(double value) const {
        return bottom - (value - y.low) / (y.high - y.low) * (bottom - top);
    }
};
PlotFrame plot_frame(const LinePlot& plot);

// Colours are the variables --s0 .. --s4 of HtmlPage's style, in turn. Texts are escaped.
std::string svg_of(const LinePlot& plot);

// The same as an image of its own: with its colours, on white.
std::string standalone_svg_of(const LinePlot& plot);

}  // namespace rs
