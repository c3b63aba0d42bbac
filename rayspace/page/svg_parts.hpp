#pragma once
// What plots are drawn from: numbers, texts and lines of SVG.

#include <cstddef>
#include <string>

namespace rs {

// "12.50" for 2 digits: a point whatever the locale, as SVG takes it; "0" where it is not finite.
std::string decimal(double value, int digits);
std::string two_decimals(double value);
// With as many digits as ticks that are `step` apart need.
std::string tick_label(double value, double step);

// `anchor` is start, middle or end; `more` are attributes, beginning with a space. The text is escaped.
std::string svg_text(double x, double y, const std::string& anchor, const std::string& text,
                     const std::string& more = "");
std::string svg_line(double x0, double y0, double x1, double y1, const std::string& style);

// Of the series with this number, as a variable that HtmlPage's style sets.
std::string series_colour(std::size_t series);

// The beginning of an image, up to and with its title.
std::string svg_head(int width_px, int height_px, const std::string& title);

// An image that stands by itself, on white: variables are replaced by their colours, for few programs but browsers
// know them.
std::string standalone_svg(std::string svg);

}  // namespace rs
