#include "engine/model/report/report.hpp"

#include <array>
#include <cstdio>

namespace rs::engine::model {
namespace {

// Work is green, a block's own losses red to yellow, waiting for other blocks grey and blue.
constexpr std::array<const char*, kActivities> kColours = {"#2a7f3f", "#eeeeee", "#c9d4e6", "#8aa4cf", "#6f86b5",
                                                           "#d9822b", "#c94f4f", "#8f3f6f", "#e0b23c", "#d66a3c",
                                                           "#e8cf7a", "#5f7d8c", "#b7c7b0"};

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f", value);
    return text;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

std::string label(double x, double y, const std::string& text, const char* more = "") {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + more + ">" + escaped(text) + "</text>\n";
}

std::string box(double x, double y, double width, double height, const char* colour, const std::string& tip) {
    return "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(width) + "\" height=\"" +
           number(height) + "\" fill=\"" + colour + "\"><title>" + escaped(tip) + "</title></rect>\n";
}

}  // namespace

std::string report_chart_svg(const BoardReport& report, const std::string& title) {
    constexpr double kLeft = 190;
    constexpr double kBar = 600;
    constexpr double kRow = 22;
    constexpr double kTop = 56;
    const double legend_top = kTop + kRow * double(report.rendering.blocks.size()) + 20;
    constexpr std::size_t kLegendRows = (kActivities + 3) / 4;
    const double height = legend_top + 18.0 * kLegendRows + 12;
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"830\" height=\"" + number(height) +
        "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    svg += label(12, 22, title, "font-size=\"15\"");
    svg += label(12, 42,
                 "Shares of each block's clock cycles while rendering; limited by " + report.rendering.limiting_block +
                     "; " + number(report.pixels_per_second / 1e6) + " Mpixel/s");
    double y = kTop;
    for (const BlockShare& block : report.rendering.blocks) {
        const bool limits = block.name == report.rendering.limiting_block;
        svg += label(12, y + 14, block.name, limits ? "font-weight=\"bold\"" : "");
        double x = kLeft;
        for (std::size_t a = 0; a < kActivities; ++a) {
            const auto activity = static_cast<Activity>(a);
            const double width = kBar * block.share(activity);
            if (width <= 0) continue;
            svg += box(x, y + 2, width, kRow - 5, kColours[a],
                       block.name + ": " + std::string(activity_name(activity)) + " " +
                           number(100 * block.share(activity)) + " %");
            x += width;
        }
        y += kRow;
    }
    for (std::size_t a = 0; a < kActivities; ++a) {
        const double x = 12 + 200 * double(a % 4);
        const std::size_t legend_row = a / 4;
        const double row = legend_top + 18 * double(legend_row);
        svg += box(x, row - 10, 12, 12, kColours[a], "");
        svg += label(x + 18, row, std::string(activity_name(static_cast<Activity>(a))));
    }
    return svg + "</svg>\n";
}

}  // namespace rs::engine::model
