#pragma once
// A polar plot as an SVG image of its own: named curves over angles, 0 at the bottom, as the light of a luminaire
// that hangs is drawn.

#include <string>
#include <vector>

namespace rs {

struct PolarCurve {
    std::string name;
    std::vector<double> angle_rad;  // from the bottom, positive to the right
    std::vector<double> radius;     // as many, >= 0 and finite
};

struct PolarPlot {
    std::string title;
    std::string unit;                // of the radius: "cd"
    std::vector<std::string> notes;  // lines under the title
    std::vector<PolarCurve> curves;  // at most 5 colours, then they repeat
    int side_px = 560;
};

// Black on white, with rings at round numbers and spokes each 30 degrees. Texts are escaped.
std::string standalone_svg_of(const PolarPlot& plot);

}  // namespace rs
