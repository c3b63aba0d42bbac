#pragma once
// One self-contained HTML page, built from top to bottom: no scripts, no other files, images inside as PNG.
//
// Every text is escaped; the page follows the reader's light or dark setting.

#include "rayspace/base/result.hpp"
#include "rayspace/page/page_images.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rs {

// For HTML and SVG, between tags and inside quotes. Bytes that XML does not allow, and those that are not UTF-8 (names
// of files may hold anything), become U+FFFD.
std::string escaped(std::string_view text);

std::string base64(std::span<const std::byte> bytes);

enum class ImageLayout {
    kWrap,  // as many lines as it takes
    kLine,  // one line; images are shown smaller where the window is narrow
};

class HtmlPage {
public:
    explicit HtmlPage(const std::string& title);

    void heading(std::string_view text);
    void paragraph(std::string_view text);
    void list(const std::vector<std::string>& lines);
    // Each row has as many cells as `header`. Cells of a column whose every cell begins with a digit or a sign are set
    // to the right.
    void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);
    // The images are brought to at most longest_side_px.
    Status images(std::span<const CaptionedImage> row, int longest_side_px = 400,
                  ImageLayout layout = ImageLayout::kWrap);
    // Markup of this folder's drawings (line_plot.hpp, ring_plan.hpp), taken as it is.
    void drawing(const std::string& svg);

    // What is added in between is folded away until the reader opens it. Not nested.
    void begin_details(std::string_view summary);
    void end_details();

    [[nodiscard]] std::string text() const;

private:
    std::string title_;
    std::string body_;
    bool in_details_ = false;
};

}  // namespace rs
