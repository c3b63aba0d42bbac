#pragma once
// SVG parts of plots: numbers, text and lines.

#include <cstddef>
#include <string>

namespace rs {

/// "12.50" for 2 digits: with a point in any locale, as SVG requires; "0" if the value is not finite.
std::string decimal(double value, int digits);
std::string two_decimals(double value);
/// Label with as many digits as needed for ticks that are `step` apart.
std::string tick_label(double value, double step);

/// Text element. `anchor` is start, middle or end; `more` contains attributes, beginning with a space. The text is
/// escaped.
std::string svg_text(double x, double y, const std::string& anchor, const std::string& text,
                     const std::string& more = "");
std::string svg_line(double x0, double y0, double x1, double y1, const std::string& style);

/// The colour of a series, as a variable of HtmlPage's style.
std::string series_colour(std::size_t series);

/// The beginning of an SVG file, up to and including its title.
std::string svg_head(int width_px, int height_px, const std::string& title);

/// Converts to a standalone file, on white: variables are replaced by their colours, since few programs except browsers
/// support them.
std::string standalone_svg(std::string svg);

}  // namespace rs
