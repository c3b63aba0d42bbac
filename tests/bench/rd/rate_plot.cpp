#include "tests/bench/rd/rate_plot.hpp"

#include "rayspace/page/html_page.hpp"
#include "rayspace/page/plots.hpp"
#include "rayspace/page/svg_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace rs::bench {
namespace {

constexpr int kColumns = 2;
constexpr double kPanelWidth_px = 440;
constexpr double kPanelHeight_px = 300;
constexpr double kLeft_px = 52;  // margins of the axes inside a panel
constexpr double kRight_px = 16;
constexpr double kTop_px = 30;
constexpr double kBottom_px = 44;
constexpr const char* kFullChroma = "-444";

struct CodecStyle {
    const char* codec;
    const char* shown;
    const char* colour;
    double width_px;
};

constexpr std::array<CodecStyle, 8> kStyles = {{
    {"dense", "Rayspace dense", "#d1261f", 2.6},
    {"board", "Rayspace board", "#e08a1e", 2.0},
    {"raw", "Rayspace, images stored raw", "#b0641a", 2.6},
    {"astc", "ASTC medium, 4x4 to 12x12", "#1c1e21", 1.6},
    {"jpeg", "JPEG", "#8a94a3", 1.6},
    {"webp", "WebP", "#1c8a4c", 1.6},
    {"x265-intra", "x265 intra (dashed: 4:4:4)", "#9440b8", 1.6},
    {"x265-inter", "x265 inter (dashed: 4:4:4)", "#1f6fd1", 1.6},
}};

std::string base_codec(const std::string& codec) {
    return codec.ends_with(kFullChroma) ? codec.substr(0, codec.size() - 4) : codec;
}

const CodecStyle* style_of(const std::string& codec) {
    const auto found = std::find_if(kStyles.begin(), kStyles.end(),
                                    [&](const CodecStyle& style) { return base_codec(codec) == style.codec; });
    return found == kStyles.end() ? nullptr : &*found;
}

// Points of a curve to draw.
std::vector<RateCurve::Point> shown_points(const SetResult& result, const ChosenCurve& curve) {
    const ChosenCurve* const base = find_curve(result.curves, base_codec(curve.codec));
    std::vector<RateCurve::Point> points;
    for (const RateCurve::Point& point : curve.curve.points()) {
        if (base != nullptr && base != &curve && point.psnr_db <= base->curve.most_db()) {
            const auto other = base->curve.bpp_at(point.psnr_db);
            if (!other || *other <= point.bpp) continue;
        }
        points.push_back(point);
    }
    return points;
}

std::string text(double x, double y, const char* anchor, const std::string& words, const std::string& more = "") {
    return "<text x=\"" + two_decimals(x) + "\" y=\"" + two_decimals(y) + "\" text-anchor=\"" + anchor + "\"" + more +
           ">" + escaped(words) + "</text>\n";
}

std::string line(double x0, double y0, double x1, double y1, const std::string& style) {
    return "<line x1=\"" + two_decimals(x0) + "\" y1=\"" + two_decimals(y0) + "\" x2=\"" + two_decimals(x1) +
           "\" y2=\"" + two_decimals(y1) + "\" style=\"" + style + "\"/>\n";
}

std::string number(double value) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%g", value);
    return digits.data();
}

class Panel {
public:
    Panel(const SetResult& result, double x, double y)
        : result_(result),
          left_(x + kLeft_px),
          right_(x + kPanelWidth_px - kRight_px),
          top_(y + kTop_px),
          bottom_(y + kPanelHeight_px - kBottom_px) {
        double least_db = std::numeric_limits<double>::infinity();
        double most_db = -least_db;
        least_bpp_ = least_db;
        most_bpp_ = 0;
        for (const ChosenCurve& curve : result.curves) {
            for (const RateCurve::Point& point : shown_points(result, curve)) {
                least_db = std::min(least_db, point.psnr_db);
                most_db = std::max(most_db, point.psnr_db);
                least_bpp_ = std::min(least_bpp_, point.bpp);
                most_bpp_ = std::max(most_bpp_, point.bpp);
            }
        }
        ticks_ = axis_ticks(least_db, most_db);
        // Margin on both sides, also for a single point.
        least_bpp_ *= 0.9;
        most_bpp_ *= 1.1;
    }

    [[nodiscard]] std::string svg() const {
        std::string svg = axes();
        for (const ChosenCurve& curve : result_.curves) svg += curve_svg(curve);
        return svg;
    }

private:
    [[nodiscard]] double x_px(double bpp) const {
        return left_ + std::log(bpp / least_bpp_) / std::log(most_bpp_ / least_bpp_) * (right_ - left_);
    }
    [[nodiscard]] double y_px(double db) const {
        return bottom_ - (db - ticks_.low) / (ticks_.high - ticks_.low) * (bottom_ - top_);
    }

    [[nodiscard]] std::string axes() const {
        std::string svg = text(left_, top_ - 10, "start", result_.set, " style=\"font-weight:600\"");
        for (const double bpp : log_ticks(least_bpp_, most_bpp_)) {
            svg += line(x_px(bpp), top_, x_px(bpp), bottom_, "stroke:#d5d9df");
            svg += text(x_px(bpp), bottom_ + 16, "middle", number(bpp));
        }
        for (int n = 0; n < ticks_.count(); ++n) {
            const double db = ticks_.low + n * ticks_.step;
            svg += line(left_, y_px(db), right_, y_px(db), "stroke:#d5d9df");
            svg += text(left_ - 6, y_px(db) + 4, "end", number(db));
        }
        svg += line(left_, bottom_, right_, bottom_, "stroke:#6b7280");
        svg += line(left_, top_, left_, bottom_, "stroke:#6b7280");
        svg += text((left_ + right_) / 2, bottom_ + 34, "middle", "bits per pixel of touched 8x8 blocks");
        const double middle = (top_ + bottom_) / 2;
        const double x = left_ - 36;
        return svg + text(x, middle, "middle", "PSNR, dB",
                          " transform=\"rotate(-90 " + two_decimals(x) + " " + two_decimals(middle) + ")\"");
    }

    [[nodiscard]] std::string curve_svg(const ChosenCurve& curve) const {
        const CodecStyle* const style = style_of(curve.codec);
        if (style == nullptr) return "";
        const std::string colour = style->colour;
        std::string path;
        std::string dots;
        for (const RateCurve::Point& point : shown_points(result_, curve)) {
            const std::string x = two_decimals(x_px(point.bpp));
            const std::string y = two_decimals(y_px(point.psnr_db));
            path += (path.empty() ? "M" : "L") + x + " " + y;
            dots += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"" + two_decimals(style->width_px) +
                    "\" style=\"fill:" + colour + "\"/>\n";
        }
        if (path.empty()) return "";
        const std::string dash = curve.codec.ends_with(kFullChroma) ? ";stroke-dasharray:5 3" : "";
        return "<path d=\"" + path + "\" style=\"fill:none;stroke:" + colour +
               ";stroke-width:" + two_decimals(style->width_px) + dash + "\"/>\n" + dots;
    }

    const SetResult& result_;
    double left_, right_, top_, bottom_;
    double least_bpp_ = 1, most_bpp_ = 1;
    AxisTicks ticks_;
};

std::string legend(const std::vector<SetResult>& results, double x, double y) {
    std::string svg;
    double row_y = y + kTop_px + 8;
    for (const CodecStyle& style : kStyles) {
        const bool drawn = std::any_of(results.begin(), results.end(), [&](const SetResult& result) {
            return find_curve(result.curves, style.codec) != nullptr;
        });
        if (!drawn) continue;
        svg += line(x + kLeft_px, row_y, x + kLeft_px + 28, row_y,
                    std::string("stroke:") + style.colour + ";stroke-width:" + two_decimals(style.width_px + 1));
        svg += text(x + kLeft_px + 38, row_y + 4, "start", style.shown);
        row_y += 24;
    }
    return svg;
}

}  // namespace

std::vector<double> log_ticks(double least, double most) {
    std::vector<double> ticks;
    for (int power = static_cast<int>(std::floor(std::log10(least))); power <= std::log10(most); ++power) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double tick = factor * std::pow(10.0, power);
            if (tick >= least && tick <= most) ticks.push_back(tick);
        }
    }
    return ticks;
}

std::string rate_plot_svg(const std::vector<SetResult>& results) {
    // The legend occupies one more panel.
    const auto rows = (static_cast<int>(results.size()) + 1 + kColumns - 1) / kColumns;
    const std::string width = std::to_string(static_cast<int>(kColumns * kPanelWidth_px));
    const std::string height = std::to_string(static_cast<int>(rows * kPanelHeight_px));
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"" + width + "\" height=\"" + height +
        "\" viewBox=\"0 0 " + width + " " + height +
        "\" style=\"background:#fff;font:13px sans-serif\">\n<title>Image coding: PSNR over rate</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    const auto place_x = [](std::size_t n) { return static_cast<double>(n % kColumns) * kPanelWidth_px; };
    const auto place_y = [](std::size_t n) { return static_cast<double>(n / kColumns) * kPanelHeight_px; };
    for (std::size_t n = 0; n < results.size(); ++n) svg += Panel(results[n], place_x(n), place_y(n)).svg();
    return svg + legend(results, place_x(results.size()), place_y(results.size())) + "</svg>\n";
}

}  // namespace rs::bench
