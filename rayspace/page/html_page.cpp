#include "rayspace/page/html_page.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/utf8.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <cstdint>

namespace rs {
namespace {

// Drawings use currentColor and these variables, so that they follow the page.
constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ground: #ffffff; --ink: #1c1e21; --faint: #6b7280; --rule: #d5d9df; --tile: #eceef1;
  --s0: #1f6fd1; --s1: #d1571f; --s2: #1c8a4c; --s3: #9440b8; --s4: #9a7500; --bad: #d62f2f; }
@media (prefers-color-scheme: dark) { :root { --ground: #15171a; --ink: #e4e6ea; --faint: #9aa1ac; --rule: #383d45;
  --tile: #24272c; --s0: #6aa9ff; --s1: #ff9662; --s2: #5fd394; --s3: #d493f2; --s4: #e2bf4a; --bad: #ff6b6b; } }
body { background: var(--ground); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; max-width: 1500px;
  margin: 2em auto; padding: 0 1.5em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.15em; margin: 2em 0 .4em; border-bottom: 1px solid var(--rule); }
table { border-collapse: collapse; margin: .6em 0; display: block; overflow-x: auto; }
th, td { padding: .2em 1em .2em 0; text-align: left; border-bottom: 1px solid var(--rule); }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; }
.images { display: flex; flex-wrap: wrap; gap: 10px; margin: .6em 0; }
.images.line { flex-wrap: nowrap; } .images.line figure { flex: 0 1 auto; min-width: 0; }
figure { margin: 0; } figure img { display: block; background: var(--tile); max-width: 100%; height: auto; }
figcaption { font-size: .85em; color: var(--faint); }
.drawing svg { max-width: 100%; height: auto; }
svg text { font: 12px system-ui, sans-serif; fill: var(--ink); }
details { margin: .6em 0; } summary { cursor: pointer; }
)";

// Bytes of the XML character at the start of `text`; 0 if there is none.
std::size_t xml_character_bytes(std::string_view text) {
    const auto [bytes, code] = first_utf8_character(text);
    const bool is_control = code < 0x20 && code != '\t' && code != '\n' && code != '\r';
    return is_control || code == 0xFFFE || code == 0xFFFF ? 0 : bytes;
}

bool is_number(const std::string& cell) {
    return !cell.empty() && ((cell[0] >= '0' && cell[0] <= '9') || cell[0] == '-' || cell[0] == '+');
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string safe;
    safe.reserve(text.size());
    while (!text.empty()) {
        const std::size_t taken = xml_character_bytes(text);
        if (taken == 0) {
            safe += "\xEF\xBF\xBD";
        } else if (text[0] == '&') {
            safe += "&amp;";
        } else if (text[0] == '<') {
            safe += "&lt;";
        } else if (text[0] == '>') {
            safe += "&gt;";
        } else if (text[0] == '"') {
            safe += "&quot;";
        } else if (text[0] == '\'') {
            safe += "&#39;";
        } else {
            safe += text.substr(0, taken);
        }
        text.remove_prefix(std::max<std::size_t>(taken, 1));
    }
    return safe;
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t n) {
            return n < bytes.size() ? std::to_integer<std::uint32_t>(bytes[n]) : 0U;
        };
        const std::uint32_t group = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
        for (std::size_t n = 0; n < 4; ++n) {
            text += i + n > bytes.size() ? '=' : kDigits[(group >> (18 - 6 * n)) & 63U];
        }
    }
    return text;
}

HtmlPage::HtmlPage(const std::string& title) : title_(escaped(title)) {}

void HtmlPage::heading(std::string_view text) {
    body_ += "<h2>" + escaped(text) + "</h2>\n";
}

void HtmlPage::paragraph(std::string_view text) {
    body_ += "<p>" + escaped(text) + "</p>\n";
}

void HtmlPage::list(const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    body_ += "<ul>\n";
    for (const std::string& line : lines) body_ += "<li>" + escaped(line) + "</li>\n";
    body_ += "</ul>\n";
}

void HtmlPage::table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
    std::vector<const char*> column_class(header.size(), rows.empty() ? "" : " class=\"number\"");
    for (const std::vector<std::string>& row : rows) {
        RS_CHECK(row.size() == header.size());
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (!is_number(row[i])) column_class[i] = "";
        }
    }
    const auto add_row = [&](const char* tag, const std::vector<std::string>& cells) {
        body_ += "<tr>";
        for (std::size_t i = 0; i < cells.size(); ++i) {
            body_ += std::string("<") + tag + column_class[i] + ">" + escaped(cells[i]) + "</" + tag + ">";
        }
        body_ += "</tr>\n";
    };
    body_ += "<table>\n";
    add_row("th", header);
    for (const std::vector<std::string>& row : rows) add_row("td", row);
    body_ += "</table>\n";
}

Status HtmlPage::images(std::span<const CaptionedImage> row, int longest_side_px, ImageLayout layout) {
    std::string markup = layout == ImageLayout::kLine ? "<div class=\"images line\">\n" : "<div class=\"images\">\n";
    for (const CaptionedImage& captioned : row) {
        const Image<Rgba8> small = downscale(captioned.image, longest_side_px);
        RS_ASSIGN_OR_RETURN(const auto png, encode_png(small, captioned.caption));
        const std::string caption = escaped(captioned.caption);
        markup += "<figure><img alt=\"" + caption + "\" width=\"" + std::to_string(small.width()) + "\" height=\"" +
                  std::to_string(small.height()) + "\" src=\"data:image/png;base64," + base64(png) +
                  "\"/><figcaption>" + caption + "</figcaption></figure>\n";
    }
    body_ += markup + "</div>\n";
    return {};
}

void HtmlPage::drawing(const std::string& svg) {
    body_ += "<div class=\"drawing\">" + svg + "</div>\n";
}

void HtmlPage::begin_details(std::string_view summary) {
    RS_CHECK(!in_details_);
    in_details_ = true;
    body_ += "<details><summary>" + escaped(summary) + "</summary>\n";
}

void HtmlPage::end_details() {
    RS_CHECK(in_details_);
    in_details_ = false;
    body_ += "</details>\n";
}

std::string HtmlPage::text() const {
    RS_CHECK(!in_details_);
    // Well-formed XML too, so that any XML reader can check a page.
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
           title_ + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" + title_ + "</h1>\n" + body_ +
           "</body>\n</html>\n";
}

}  // namespace rs
