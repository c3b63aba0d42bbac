// EULUMDAT reader: one item per line, identified by the line number. Source: A. Stockmar, "EULUMDAT file format", 1990,
// as published with the International Lighting Data Format: lines 1..26 header, lamp sets, ten direct ratios, angles,
// intensities.

#include "rayspace/light/luminaire.hpp"
#include "rayspace/light/photometric_text.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace rs {
namespace {

constexpr std::size_t kLinesOfHead = 26;
constexpr std::size_t kLinesOfSet = 6;
constexpr std::size_t kRatios = 10;
constexpr int kMaxSets = 20;

class Lines {
public:
    Lines(std::string_view text, std::string name) : name_(std::move(name)), lines_(split_lines(text)) {}

    // Line numbers start at 1.
    Result<double> number(std::size_t line, const std::string& what) const {
        if (line > lines_.size()) {
            return Error{name_ + ": ends before line " + std::to_string(line) + ", " + what +
                         "; check that it is complete"};
        }
        std::string word = utf8_text(lines_[line - 1]);
        std::replace(word.begin(), word.end(), ',', '.');
        double value = 0;
        if (!parse_number(word, value))
            return error(line, "'" + word.substr(0, 40) + "' where " + what + " should stand");
        return value;
    }
    Result<int> whole(std::size_t line, const std::string& what, int least, int most) const {
        RS_ASSIGN_OR_RETURN(const double value, number(line, what));
        if (value != std::floor(value) || value < least || value > most) {
            return error(line, out_of_range(what, value, least, most).message);
        }
        return static_cast<int>(value);
    }
    [[nodiscard]] std::string text(std::size_t line) const {
        return line <= lines_.size() ? utf8_text(lines_[line - 1]) : std::string();
    }
    [[nodiscard]] Error error(std::size_t line, const std::string& problem) const {
        return Error{name_ + ": line " + std::to_string(line) + ": " + problem};
    }

private:
    std::string name_;
    std::vector<std::string_view> lines_;
};

enum Symmetry { kNone = 0, kAboutAxis = 1, kPlane0 = 2, kPlane90 = 3, kBothPlanes = 4 };

// Indices of the listed planes whose intensities are in the file.
std::vector<int> stored_planes(int symmetry, int planes) {
    int first = 0, count = planes;
    if (symmetry == kAboutAxis) count = 1;
    if (symmetry == kPlane0) count = planes / 2 + 1;
    if (symmetry == kPlane90) first = 3 * planes / 4, count = planes / 2 + 1;
    if (symmetry == kBothPlanes) count = planes / 4 + 1;
    std::vector<int> stored;
    for (int i = 0; i < count; ++i) stored.push_back((first + i) % planes);
    return stored;
}

LuminousOpening opening_of(double length_m, double width_m, double height_m) {
    LuminousOpening opening{OpeningShape::kRectangle, width_m, length_m, height_m};
    if (width_m == 0) {
        opening.across_m = length_m;
        opening.shape = height_m > 0 ? OpeningShape::kCylinder : OpeningShape::kDisc;
        if (length_m == 0 && height_m == 0) opening.shape = OpeningShape::kPoint;
    } else if (height_m > 0) {
        opening.shape = OpeningShape::kBox;
    }
    return opening;
}

}  // namespace

Result<Luminaire> parse_eulumdat(std::string_view text, const std::string& name) {
    const Lines lines(text, name);
    Luminaire luminaire;
    luminaire.format = "EULUMDAT";
    for (const auto& [line, keyword] : {std::pair{1, "MANUFAC"}, std::pair{9, "LUMINAIRE"}, std::pair{10, "LUMCAT"},
                                        std::pair{8, "TEST"}, std::pair{12, "ISSUEDATE"}}) {
        luminaire.keywords.emplace_back(keyword, lines.text(static_cast<std::size_t>(line)));
    }
    constexpr int kMost = static_cast<int>(PhotometricWeb::kMaxAngles);
    RS_ASSIGN_OR_RETURN(const int symmetry, lines.whole(3, "the symmetry (Isym)", kNone, kBothPlanes));
    RS_ASSIGN_OR_RETURN(const int planes, lines.whole(4, "the number of C planes (Mc)", 1, kMost));
    RS_ASSIGN_OR_RETURN(const int rows, lines.whole(6, "the number of intensities in a plane (Ng)", 2, kMost));
    const int divisor = symmetry == kPlane0 ? 2 : symmetry >= kPlane90 ? 4 : 1;
    if (planes % divisor != 0) {
        return lines.error(4, std::to_string(planes) +
                                  " C planes cannot be mirrored as line 3 says; their number "
                                  "must be a multiple of " +
                                  std::to_string(divisor));
    }
    RS_ASSIGN_OR_RETURN(const int sets, lines.whole(26, "the number of lamp sets", 1, kMaxSets));
    // Lamp sets are alternatives; the first is used.
    RS_ASSIGN_OR_RETURN(const double lamps, lines.number(kLinesOfHead + 1, "the number of lamps"));
    RS_ASSIGN_OR_RETURN(const double lumens, lines.number(kLinesOfHead + 3, "the lamps' luminous flux"));
    if (!(lumens > 0)) return lines.error(kLinesOfHead + 3, "the lamps' luminous flux must be above 0");
    const Result<double> watts = lines.number(kLinesOfHead + 6, "the watts");
    RS_ASSIGN_OR_RETURN(const double conversion, lines.number(24, "the conversion factor"));
    if (!(conversion > 0)) return lines.error(24, "the conversion factor must be above 0");
    luminaire.lamps = static_cast<int>(std::clamp(std::abs(lamps), 0.0, 1e6));
    luminaire.lumens_per_lamp = lamps < 0 ? -1 : lumens / std::max(luminaire.lamps, 1);  // < 0: absolute photometry
    luminaire.multiplier = lumens / 1000 * conversion;  // intensities are in cd per 1000 lm
    luminaire.input_w = watts ? *watts : 0;
    double size_m[3] = {};
    for (std::size_t i = 0; i < 2; ++i) {
        RS_ASSIGN_OR_RETURN(const double size,
                            lines.number(16 + i, i == 0 ? "the opening's length" : "the opening's width"));
        size_m[i] = std::abs(size) / 1000;
    }
    for (std::size_t line = 18; line <= 21; ++line) {
        RS_ASSIGN_OR_RETURN(const double height, lines.number(line, "the opening's height"));
        size_m[2] = std::max(size_m[2], std::abs(height) / 1000);
    }
    luminaire.opening = opening_of(size_m[0], size_m[1], size_m[2]);

    const std::size_t c_line = kLinesOfHead + kLinesOfSet * static_cast<std::size_t>(sets) + kRatios + 1;
    const std::size_t g_line = c_line + static_cast<std::size_t>(planes);
    std::size_t line = g_line + static_cast<std::size_t>(rows);
    PhotometricTable table;
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        RS_ASSIGN_OR_RETURN(const double angle, lines.number(g_line + row, "a G angle"));
        table.vertical_deg.push_back(angle);
    }
    const std::vector<int> stored = stored_planes(symmetry, planes);
    if (stored.size() * table.vertical_deg.size() > PhotometricWeb::kMaxValues) {
        return lines.error(4, "more intensities than " + std::to_string(PhotometricWeb::kMaxValues));
    }
    std::vector<std::vector<double>> columns;
    for (const int plane : stored) {
        RS_ASSIGN_OR_RETURN(const double angle, lines.number(c_line + static_cast<std::size_t>(plane), "a C angle"));
        // Symmetric about the plane 90-270: 270..90 through 0 equals 270..90 in reverse order.
        double at = symmetry == kPlane90 ? 180 - angle : angle;
        if (at < 0) at += 360;
        table.horizontal_deg.push_back(symmetry == kAboutAxis ? 0 : at);
        columns.emplace_back();
        for (int row = 0; row < rows; ++row) {
            RS_ASSIGN_OR_RETURN(const double value, lines.number(line++, "an intensity"));
            columns.back().push_back(value * luminaire.multiplier);
        }
    }
    if (symmetry == kPlane90) {
        std::reverse(columns.begin(), columns.end());
        std::reverse(table.horizontal_deg.begin(), table.horizontal_deg.end());
    }
    for (const auto& column : columns) table.candela.insert(table.candela.end(), column.begin(), column.end());
    Result<PhotometricWeb> web = PhotometricWeb::create(table);
    if (!web) return Error{name + ": " + web.error().message};
    luminaire.web = std::move(*web);
    return luminaire;
}

}  // namespace rs
