#pragma once
// A self-contained HTML page, built from top to bottom: no scripts, no external files, images embedded as PNG.
//
// All text is escaped; the page follows the reader's light or dark setting.

#include "rayspace/base/result.hpp"
#include "rayspace/page/page_images.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rs {

/// Escapes text for HTML and SVG, between tags and inside quotes. Bytes that XML does not allow or that are not UTF-8
/// (as in file names) become U+FFFD.
std::string escaped(std::string_view text);

std::string base64(std::span<const std::byte> bytes);

enum class ImageLayout {
    kWrap,  // as many lines as needed
    kLine,  // one line; images shrink in a narrow window
};

class HtmlPage {
public:
    explicit HtmlPage(const std::string& title);

    void heading(std::string_view text);
    void paragraph(std::string_view text);
    void list(const std::vector<std::string>& lines);
    /// Each row has as many cells as `header`. Columns whose cells all begin with a digit or a sign are right-aligned.
    void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);
    /// Adds images, reduced to at most longest_side_px.
    Status images(std::span<const CaptionedImage> row, int longest_side_px = 400,
                  ImageLayout layout = ImageLayout::kWrap);
    /// Adds SVG markup of a drawing (plots.hpp, build_report.hpp), unescaped.
    void drawing(const std::string& svg);

    /// Content added in between is collapsed until the reader opens it. Not nested.
    void begin_details(std::string_view summary);
    void end_details();

    [[nodiscard]] std::string text() const;

private:
    std::string title_;
    std::string body_;
    bool in_details_ = false;
};

}  // namespace rs
