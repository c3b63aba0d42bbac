#pragma once
// A polar plot as a standalone SVG file: named curves over angles, 0 at the bottom, as in photometric diagrams of
// hanging luminaires.

#include <string>
#include <vector>

namespace rs {

struct PolarCurve {
    std::string name;
    std::vector<double> angle_rad;  // from the bottom, positive to the right
    std::vector<double> radius;     // same size as angle_rad, >= 0 and finite
};

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
