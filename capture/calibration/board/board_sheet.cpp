#include "capture/calibration/board/board_sheet.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <optional>
#include <span>
#include <sstream>

namespace rs::capture {
namespace {

constexpr double kPoints_per_mm = 72.0 / 25.4;
constexpr double kPaperEdge_mm = 8;  // unprintable margin of most printers
constexpr double kSmallPrint_mm = 2.4;
constexpr double kSmallPrintLine_mm = 2 * kSmallPrint_mm;  // with the gap above it

struct Paper {
    const char* name;
    double width_mm, height_mm;
};
constexpr std::array<Paper, 8> kPapers{{{"a5", 148, 210},
                                        {"a4", 210, 297},
                                        {"letter", 215.9, 279.4},
                                        {"legal", 215.9, 355.6},
                                        {"tabloid", 279.4, 431.8},
                                        {"a3", 297, 420},
                                        {"a2", 420, 594},
                                        {"a1", 594, 841}}};

std::ostringstream plain_text() {
    std::ostringstream text;
    text.imbue(std::locale::classic());  // decimal points, not commas
    text << std::fixed;
    text.precision(4);
    return text;
}

std::string trimmed(double number) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << number;
    return text.str();
}

double board_width_mm(const BoardDesign& design) {
    return design.squares_x * design.square_mm;
}
double board_height_mm(const BoardDesign& design) {
    return design.squares_y * design.square_mm;
}

std::string small_print(const BoardDesign& design) {
    return "Rayspace calibration board: " + to_string(design) + ". Print at 100 %; a square is " +
           trimmed(design.square_mm) + " mm wide.";
}

// Printable size of a sheet for the board, without the caption.
glm::dvec2 printable_size_mm(double width_mm, double height_mm) {
    return {width_mm - 2 * kPaperEdge_mm, height_mm - 2 * kPaperEdge_mm - kSmallPrintLine_mm};
}

bool fits(const BoardDesign& design, double width_mm, double height_mm) {
    const glm::dvec2 room = printable_size_mm(width_mm, height_mm);
    return board_width_mm(design) <= room.x && board_height_mm(design) <= room.y;
}

// Sheet size in the orientation that fits the board, portrait preferred; nothing if neither does.
std::optional<glm::dvec2> oriented_paper_mm(const BoardDesign& design, const Paper& paper) {
    if (fits(design, paper.width_mm, paper.height_mm)) return glm::dvec2(paper.width_mm, paper.height_mm);
    if (fits(design, paper.height_mm, paper.width_mm)) return glm::dvec2(paper.height_mm, paper.width_mm);
    return std::nullopt;
}

std::string too_small_paper_message(const BoardDesign& design, const Paper& paper) {
    double square_mm = 0;
    glm::ivec2 squares(0);
    for (const bool sideways : {false, true}) {
        const glm::dvec2 room = sideways ? printable_size_mm(paper.height_mm, paper.width_mm)
                                         : printable_size_mm(paper.width_mm, paper.height_mm);
        square_mm = std::max(square_mm, std::min(room.x / design.squares_x, room.y / design.squares_y));
        const glm::ivec2 here(std::min<int>(design.squares_x, static_cast<int>(room.x / design.square_mm)),
                              std::min<int>(design.squares_y, static_cast<int>(room.y / design.square_mm)));
        if (here.x * here.y > squares.x * squares.y) squares = here;
    }
    std::string message = "board: " + trimmed(board_width_mm(design)) + " x " + trimmed(board_height_mm(design)) +
                          " mm do not fit on " + paper.name + "; what fits is squares of at most " +
                          trimmed(std::floor(square_mm * 10) / 10) + " mm";
    if (squares.x >= 3 && squares.y >= 3) {
        message += ", or " + std::to_string(squares.x) + "x" + std::to_string(squares.y) + " squares of " +
                   trimmed(design.square_mm) + " mm";
    }
    const auto larger = std::find_if(kPapers.begin(), kPapers.end(),
                                     [&](const Paper& p) { return oriented_paper_mm(design, p).has_value(); });
    if (larger != kPapers.end()) message += ", or --paper " + std::string(larger->name);
    return message;
}

// A PDF of one page: header, objects, cross-reference table of their offsets, trailer.
std::string pdf_file(double width_mm, double height_mm, const std::string& content) {
    std::ostringstream page = plain_text();
    page << "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " << width_mm * kPoints_per_mm << " "
         << height_mm * kPoints_per_mm << "] /Contents 4 0 R /Resources << /Font << /F1 5 0 R >> >> >>";
    const std::array<std::string, 6> objects{
        // PrintScaling /None prevents viewers from shrinking the page.
        "<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>",
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        page.str(),
        "<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content + "endstream",
        "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>",
        "<< /Title (Rayspace calibration board) >>"};
    std::string file = "%PDF-1.4\n";
    std::string table = "0000000000 65535 f \n";
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const std::string offset = std::to_string(file.size());
        table += std::string(10 - offset.size(), '0') + offset + " 00000 n \n";
        file += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
    }
    const std::string count = std::to_string(objects.size() + 1);
    const std::string table_at = std::to_string(file.size());
    return file + "xref\n0 " + count + "\n" + table + "trailer\n<< /Size " + count +
           " /Root 1 0 R /Info 6 0 R >>\nstartxref\n" + table_at + "\n%%EOF\n";
}

Status write_text(const std::filesystem::path& path, const std::string& text) {
    RS_ASSIGN_OR_RETURN(StagedFile file, StagedFile::create(path));
    RS_TRY(file.write(std::as_bytes(std::span(text))));
    return file.commit();
}

}  // namespace

std::vector<std::string> paper_names() {
    std::vector<std::string> names;
    for (const Paper& paper : kPapers) names.emplace_back(paper.name);
    return names;
}

Result<std::string> board_pdf(const BoardDesign& design, const std::string& paper_name) {
    RS_TRY(check_board_design(design));
    const auto paper =
        std::find_if(kPapers.begin(), kPapers.end(), [&](const Paper& p) { return paper_name == p.name; });
    if (paper == kPapers.end()) {
        std::string names;
        for (const std::string& name : paper_names()) names += (names.empty() ? "" : ", ") + name;
        return Error{"board: no paper '" + paper_name + "'; give one of " + names};
    }
    const auto sheet = oriented_paper_mm(design, *paper);
    if (!sheet) return Error{too_small_paper_message(design, *paper)};
    const double left = 0.5 * (sheet->x - board_width_mm(design));
    const double top = 0.5 * (sheet->y - board_height_mm(design) - kSmallPrintLine_mm);
    std::ostringstream content = plain_text();
    content << "q\n"
            << kPoints_per_mm << " 0 0 " << -kPoints_per_mm << " " << left * kPoints_per_mm << " "
            << (sheet->y - top) * kPoints_per_mm << " cm\n0 g\n";  // from here in millimetres, y down
    // All rectangles are one path, filled at once, so that no hairline shows where two touch.
    for (const InkRectangle& r : ink_rectangles(design)) {
        content << r.x_mm << " " << r.y_mm << " " << r.width_mm << " " << r.height_mm << " re\n";
    }
    content << "f\nQ\nBT\n/F1 " << kSmallPrint_mm * kPoints_per_mm << " Tf\n"
            << std::max(kPaperEdge_mm, left) * kPoints_per_mm << " "
            << (sheet->y - top - board_height_mm(design) - kSmallPrintLine_mm) * kPoints_per_mm << " Td\n("
            << small_print(design) << ") Tj\nET\n";
    return pdf_file(sheet->x, sheet->y, content.str());
}

Result<std::string> board_svg(const BoardDesign& design) {
    RS_TRY(check_board_design(design));
    const double border = design.square_mm;
    const double width = board_width_mm(design) + 2 * border;
    const double height = board_height_mm(design) + 2 * border;
    std::ostringstream svg = plain_text();
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "mm\" height=\"" << height
        << "mm\" viewBox=\"" << -border << " " << -border << " " << width << " " << height << "\">\n<rect x=\""
        << -border << "\" y=\"" << -border << "\" width=\"" << width << "\" height=\"" << height
        << "\" fill=\"#fff\"/>\n<path d=\"";
    for (const InkRectangle& r : ink_rectangles(design)) {
        svg << "M" << r.x_mm << " " << r.y_mm << "h" << r.width_mm << "v" << r.height_mm << "h" << -r.width_mm << "z\n";
    }
    svg << "\"/>\n<text x=\"0\" y=\"" << board_height_mm(design) + kSmallPrintLine_mm
        << "\" font-family=\"sans-serif\" font-size=\"" << kSmallPrint_mm << "\">" << small_print(design)
        << "</text>\n</svg>\n";
    return svg.str();
}

Result<Image<Rgba8>> board_image(const BoardDesign& design, double dpi) {
    RS_TRY(check_board_design(design));
    const double px_per_mm = dpi / 25.4;
    const double border = design.square_mm;
    const double width_px = std::round((board_width_mm(design) + 2 * border) * px_per_mm);
    const double height_px = std::round((board_height_mm(design) + 2 * border) * px_per_mm);
    if (!(width_px >= 1 && height_px >= 1 && std::max(width_px, height_px) <= kMaxImageSide_px)) {
        return Error{"board: " + trimmed(width_px) + " x " + trimmed(height_px) + " pixels; at most " +
                     std::to_string(kMaxImageSide_px) + " a side, give another dpi"};
    }
    const int width = static_cast<int>(width_px);
    const int height = static_cast<int>(height_px);
    cv::Mat1f ink(height, width, 0.0F);
    for (const InkRectangle& r : ink_rectangles(design)) {
        const double x0 = (r.x_mm + border) * px_per_mm, x1 = x0 + r.width_mm * px_per_mm;
        const double y0 = (r.y_mm + border) * px_per_mm, y1 = y0 + r.height_mm * px_per_mm;
        for (int y = static_cast<int>(y0); y < std::min<double>(height, y1); ++y) {
            const double covered_y = std::min(y1, y + 1.0) - std::max(y0, double(y));
            for (int x = static_cast<int>(x0); x < std::min<double>(width, x1); ++x) {
                const double covered_x = std::min(x1, x + 1.0) - std::max(x0, double(x));
                ink(y, x) += static_cast<float>(covered_x * covered_y);
            }
        }
    }
    try {
        const double base_y =
            (border + board_height_mm(design) + std::min(kSmallPrintLine_mm, 0.8 * border)) * px_per_mm;
        const std::string text = small_print(design);
        const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 1, 1, nullptr);
        const double scale =
            std::min(kSmallPrint_mm * px_per_mm / size.height, (width - border * px_per_mm) / std::max(1, size.width));
        cv::putText(ink, text, {static_cast<int>(0.5 * border * px_per_mm), static_cast<int>(base_y)},
                    cv::FONT_HERSHEY_SIMPLEX, scale, cv::Scalar(1), 1, cv::LINE_8);
    } catch (const cv::Exception& e) {
        return Error{"board: the caption could not be drawn: " + std::string(e.what())};
    }
    Image<Rgba8> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::uint8_t grey = srgb8_from_linear(std::clamp(1 - ink(y, x), 0.0F, 1.0F));
            image(x, y) = {grey, grey, grey, 255};
        }
    }
    return image;
}

Status write_board(const std::filesystem::path& path, const SheetOptions& options) {
    const std::string ending = path.extension().string();
    if (ending == ".png") {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, board_image(options.design, options.dpi));
        return write_png(path, image.view());
    }
    if (ending != ".pdf" && ending != ".svg") {
        return Error{path.string() + ": unknown extension; a board is written as .pdf, .svg or .png"};
    }
    RS_ASSIGN_OR_RETURN(const std::string text,
                        ending == ".pdf" ? board_pdf(options.design, options.paper) : board_svg(options.design));
    return write_text(path, text);
}

}  // namespace rs::capture
