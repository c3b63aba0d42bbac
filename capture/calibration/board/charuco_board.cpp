#include "capture/calibration/board/charuco_board.hpp"

#include "capture/calibration/board/aruco_dictionary.hpp"
#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace rs::capture {
namespace {

constexpr int kFewestSquares = 3;
constexpr int kMostSquares = 40;
constexpr int kFewestCorners = 8;

// Parses the whole text as a number, independent of the locale.
bool read_number(const std::string& text, double& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
}
bool read_number(const std::string& text, int& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size();
}

bool read_squares(const std::string& text, BoardDesign& design) {
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) {
        if (!read_number(text, design.squares_x)) return false;
        design.squares_y = design.squares_x;
        return true;
    }
    return read_number(text.substr(0, cross), design.squares_x) &&
           read_number(text.substr(cross + 1), design.squares_y);
}

std::string shortest(double number) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << number;
    return text.str();
}

std::string dictionary_names(int fewest_markers) {
    std::string names;
    for (const NamedDictionary& dictionary : kDictionaries) {
        if (dictionary.markers >= fewest_markers) names += (names.empty() ? "" : ", ") + std::string(dictionary.name);
    }
    return names;
}

int white_squares(const BoardDesign& design) {
    return design.squares_x * design.squares_y / 2;  // the top left is black
}

}  // namespace

Result<BoardDesign> parse_board_design(const std::string& text) {
    BoardDesign design;
    std::istringstream words(text == "default" ? "" : text);
    for (std::string word; std::getline(words, word, ',');) {
        const std::size_t equals = word.find('=');
        const std::string key = word.substr(0, equals);
        const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
        bool good = true;
        if (key == "squares") {
            good = read_squares(value, design);
        } else if (key == "square-mm") {
            good = read_number(value, design.square_mm);
        } else if (key == "marker") {
            good = read_number(value, design.marker_share);
        } else if (key == "dictionary") {
            design.dictionary = value;
        } else if (key == "blank-mm") {
            good = read_number(value, design.blank_mm);
        } else {
            return Error{"board: '" + word + "' is unknown; write " + to_string(BoardDesign{}) + " or a part of it"};
        }
        if (!good)
            return Error{"board: '" + word + "' has no valid number; write for example " + to_string(BoardDesign{})};
    }
    RS_TRY(check_board_design(design));
    return design;
}

std::string to_string(const BoardDesign& design) {
    return "squares=" + std::to_string(design.squares_x) + "x" + std::to_string(design.squares_y) +
           ",square-mm=" + shortest(design.square_mm) + ",marker=" + shortest(design.marker_share) +
           ",dictionary=" + design.dictionary + ",blank-mm=" + shortest(design.blank_mm);
}

Status check_board_design(const BoardDesign& design) {
    for (const int squares : {design.squares_x, design.squares_y}) {
        if (squares < kFewestSquares || squares > kMostSquares) {
            return Error{"board: " + std::to_string(squares) + " squares; give " + std::to_string(kFewestSquares) +
                         " to " + std::to_string(kMostSquares)};
        }
    }
    if (!(design.square_mm >= 1 && design.square_mm <= 500)) {
        return Error{"board: squares of " + shortest(design.square_mm) + " mm; give 1 to 500"};
    }
    if (!(design.marker_share >= 0.3 && design.marker_share <= 0.9)) {
        return Error{"board: markers of " + shortest(design.marker_share) + " squares; give 0.3 to 0.9"};
    }
    const NamedDictionary* dictionary = find_dictionary(design.dictionary);
    if (dictionary == nullptr) {
        return Error{"board: no dictionary '" + design.dictionary + "'; give one of " + dictionary_names(0)};
    }
    if (const int needed = white_squares(design); dictionary->markers < needed) {
        return Error{"board: " + std::to_string(needed) + " markers are needed and " + design.dictionary + " has " +
                     std::to_string(dictionary->markers) + "; give one of " + dictionary_names(needed)};
    }
    if (!(design.blank_mm >= 0 && std::isfinite(design.blank_mm))) {
        return Error{"board: a blank of " + shortest(design.blank_mm) + " mm; give 0 or more"};
    }
    int corners = 0;
    for (int i = 0; i < corner_count(design); ++i) corners += corner_is_printed(design, i) ? 1 : 0;
    if (corners < kFewestCorners && design.blank_mm > 0) {
        return Error{"board: a blank of " + shortest(design.blank_mm) + " mm leaves " + std::to_string(corners) +
                     " corners, too few; give a smaller blank or more squares"};
    }
    return {};
}

bool square_is_printed(const BoardDesign& design, int x, int y) {
    if (x < 0 || y < 0 || x >= design.squares_x || y >= design.squares_y) return false;
    // Point of the square nearest to the board's centre, in squares.
    const double left = x - 0.5 * design.squares_x;
    const double top = y - 0.5 * design.squares_y;
    const double near_x = std::clamp(0.0, left, left + 1);
    const double near_y = std::clamp(0.0, top, top + 1);
    return design.blank_mm <= 0 || std::hypot(near_x, near_y) * design.square_mm >= 0.5 * design.blank_mm;
}

bool square_is_black(int x, int y) {
    return (x + y) % 2 == 0;
}

int marker_of_square(const BoardDesign& design, int x, int y) {
    if (square_is_black(x, y) || !square_is_printed(design, x, y)) return -1;
    return (y * design.squares_x + x) / 2;  // number of white squares before it
}

int marker_cells_across(const BoardDesign& design) {
    const NamedDictionary* dictionary = find_dictionary(design.dictionary);
    RS_CHECK(dictionary != nullptr);
    return dictionary->across + 2;
}

std::vector<bool> black_marker_cells(const BoardDesign& design, int marker) {
    const NamedDictionary* named = find_dictionary(design.dictionary);
    RS_CHECK(named != nullptr && marker >= 0 && marker < named->markers);
    const cv::Ptr<cv::aruco::Dictionary> dictionary = cv::aruco::getPredefinedDictionary(named->number);
    const cv::Mat1b bits = cv::aruco::Dictionary::getBitsFromByteList(dictionary->bytesList.row(marker), named->across);
    const int n = named->across + 2;
    std::vector<bool> black(static_cast<std::size_t>(n * n), true);
    for (int y = 0; y < named->across; ++y) {
        for (int x = 0; x < named->across; ++x) black[static_cast<std::size_t>((y + 1) * n + x + 1)] = bits(y, x) == 0;
    }
    return black;
}

bool corner_is_printed(const BoardDesign& design, int corner) {
    const int x = corner % (design.squares_x - 1);
    const int y = corner / (design.squares_x - 1);
    return square_is_printed(design, x, y) && square_is_printed(design, x + 1, y) &&
           square_is_printed(design, x, y + 1) && square_is_printed(design, x + 1, y + 1);
}

glm::dvec2 corner_mm(const BoardDesign& design, int corner) {
    const int x = corner % (design.squares_x - 1);
    const int y = corner / (design.squares_x - 1);
    return design.square_mm * glm::dvec2(x + 1 - 0.5 * design.squares_x, y + 1 - 0.5 * design.squares_y);
}

std::vector<InkRectangle> ink_rectangles(const BoardDesign& design) {
    std::vector<InkRectangle> ink;
    const int n = marker_cells_across(design);
    const double cell_mm = design.square_mm * design.marker_share / n;
    const double rim_mm = design.square_mm * 0.5 * (1 - design.marker_share);
    for (int y = 0; y < design.squares_y; ++y) {
        for (int x = 0; x < design.squares_x; ++x) {
            if (!square_is_printed(design, x, y)) continue;
            const double left = x * design.square_mm;
            const double top = y * design.square_mm;
            if (square_is_black(x, y)) {
                ink.push_back({left, top, design.square_mm, design.square_mm});
                continue;
            }
            const std::vector<bool> black = black_marker_cells(design, marker_of_square(design, x, y));
            for (int row = 0; row < n; ++row) {
                for (int begin = 0; begin < n;) {  // runs of black cells
                    int end = begin;
                    while (end < n && black[static_cast<std::size_t>(row * n + end)]) ++end;
                    if (end > begin) {
                        ink.push_back({left + rim_mm + begin * cell_mm, top + rim_mm + row * cell_mm,
                                       (end - begin) * cell_mm, cell_mm});
                    }
                    begin = end + 1;
                }
            }
        }
    }
    return ink;
}

}  // namespace rs::capture
