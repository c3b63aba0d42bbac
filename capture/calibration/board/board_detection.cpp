#include "capture/calibration/board/board_detection.hpp"

#include "capture/calibration/board/aruco_dictionary.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/image/linear_light.hpp"

#include <glm/glm.hpp>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace rs::capture {
namespace {

constexpr double kArm = 0.42;                 // arm length of the cross, in squares
constexpr double kMost = 0.2;                 // largest distance of the corner from its predicted position, in squares
constexpr double kCorrelation = 0.7;          // with an ideal chessboard
constexpr double kLeastSectorContrast = 0.4;  // of the two worst sectors, relative to the mean contrast
constexpr double kSmear_px = 3;
constexpr int kMostRefinements = 12;

struct Window {
    int half = 0;      // samples from the middle to the rim
    double pitch = 0;  // squares from sample to sample
    std::vector<float> grey;

    [[nodiscard]] float at(int x, int y) const {
        return grey[static_cast<std::size_t>((y + half) * (2 * half + 1) + x + half)];
    }
};

cv::Point2d apply_homography(const cv::Matx33d& h, double x, double y) {
    const cv::Vec3d p = h * cv::Vec3d(x, y, 1);
    return {p[0] / p[2], p[1] / p[2]};
}

// Samples the window around `centre` (in squares); false if it leaves the image.
bool sample_window(Window& window, const cv::Mat1f& grey, const cv::Matx33d& h, const glm::dvec2& centre) {
    const int n = 2 * window.half + 1;
    window.grey.resize(static_cast<std::size_t>(n * n));
    auto out = window.grey.begin();
    for (int y = -window.half; y <= window.half; ++y) {
        for (int x = -window.half; x <= window.half; ++x) {
            const cv::Point2d p = apply_homography(h, centre.x + x * window.pitch, centre.y + y * window.pitch);
            if (!(p.x >= 0 && p.y >= 0 && p.x < grey.cols - 1 && p.y < grey.rows - 1)) return false;
            const int x0 = static_cast<int>(p.x), y0 = static_cast<int>(p.y);
            const float fx = static_cast<float>(p.x - x0), fy = static_cast<float>(p.y - y0);
            const float* top = grey[y0] + x0;
            const float* bottom = grey[y0 + 1] + x0;
            *out++ = (1 - fy) * ((1 - fx) * top[0] + fx * top[1]) + fy * ((1 - fx) * bottom[0] + fx * bottom[1]);
        }
    }
    return true;
}

// True if the samples within `band` of the edges and those inside the black squares match a chessboard: as a whole, and
// in each of sixteen sectors, so that neither a missing square nor an object in front of part of an arm passes.
bool matches_chessboard(const Window& window, bool first_is_black, double band) {
    struct Sum {
        double n = 0, v = 0;
    };
    std::array<Sum, 16> sectors;
    double n = 0, sum = 0, sum2 = 0, sign_sum = 0, product = 0;
    for (int y = -window.half; y <= window.half; ++y) {
        for (int x = -window.half; x <= window.half; ++x) {
            if (x == 0 || y == 0) continue;
            const bool black = ((x > 0) == (y > 0)) == first_is_black;
            const int far = std::max(std::abs(x), std::abs(y));
            if (!black && std::min(std::abs(x), std::abs(y)) * window.pitch > band) continue;
            const double v = window.at(x, y);
            const double sign = black ? -1 : 1;
            n += 1, sum += v, sum2 += v * v, sign_sum += sign, product += sign * v;
            Sum& sector = sectors[static_cast<std::size_t>((x > 0 ? 1 : 0) + (y > 0 ? 2 : 0) +
                                                           (std::abs(x) > std::abs(y) ? 4 : 0) +
                                                           (2 * far > window.half ? 8 : 0))];
            sector.n += 1;
            sector.v += v;
        }
    }
    const double covariance = product / n - sum / n * (sign_sum / n);
    const double spread = (sum2 / n - sum / n * (sum / n)) * (1 - sign_sum / n * (sign_sum / n));
    if (!(spread > 1e-9 && covariance / std::sqrt(spread) > kCorrelation)) return false;
    double darkest_white = 1e9, lightest_black = -1e9, whites = 0, blacks = 0;
    for (std::size_t k = 0; k < sectors.size(); ++k) {
        const double mean = sectors[k].v / std::max(1.0, sectors[k].n);
        const bool on_diagonal = ((k & 1) != 0) == ((k & 2) != 0);
        if (on_diagonal == first_is_black) {
            lightest_black = std::max(lightest_black, mean);
            blacks += mean / 8;
        } else {
            darkest_white = std::min(darkest_white, mean);
            whites += mean / 8;
        }
    }
    return darkest_white - lightest_black > kLeastSectorContrast * (whites - blacks);
}

// Offset from the window's centre to the corner, in squares.
std::optional<glm::dvec2> corner_offset(const Window& window, double band) {
    double a = 0, b = 0, c = 0, u = 0, v = 0;
    for (int y = -window.half + 1; y < window.half; ++y) {
        for (int x = -window.half + 1; x < window.half; ++x) {
            const double px = x * window.pitch, py = y * window.pitch;
            if (std::min(std::abs(px), std::abs(py)) > band) continue;
            const double gx = window.at(x + 1, y) - window.at(x - 1, y);
            const double gy = window.at(x, y + 1) - window.at(x, y - 1);
            const double along = gx * px + gy * py;
            a += gx * gx, b += gx * gy, c += gy * gy;
            u += gx * along, v += gy * along;
        }
    }
    const double determinant = a * c - b * b;
    if (!(determinant > 1e-3 * a * c)) return std::nullopt;  // one edge only, or none
    return glm::dvec2((c * u - b * v) / determinant, (a * v - b * u) / determinant);
}

// Refines one chessboard corner to subpixel accuracy in a window rectified with the board. `grey` is a slightly
// smoothed image. `h` maps coordinates in squares, the corner near (0, 0), to OpenCV's pixels (centres at integers) and
// is accurate to about a square; `first_is_black` states whether the square at the lower right of the corner is black.
// `margin` is the marker-free width along the edges of a white square, in squares. Returns the refined corner in
// pixels; nothing if the surrounding squares do not match a chessboard or the window leaves the image.
//
// Principle of cv::cornerSubPix: each gradient is perpendicular to the line from the corner to its pixel. The window
// here is a cross along the four edges: long enough to average many gradients, and narrow enough to exclude the
// markers.
std::optional<glm::dvec2> refine_corner(const cv::Mat1f& grey, const cv::Matx33d& h, bool first_is_black,
                                        double margin) {
    // The shorter edge in the image limits the resolution of a square.
    const double side_x = cv::norm(apply_homography(h, 0.5, 0) - apply_homography(h, -0.5, 0));
    const double side_y = cv::norm(apply_homography(h, 0, 0.5) - apply_homography(h, 0, -0.5));
    const double longest = std::max(side_x, side_y);
    if (!(std::isfinite(longest) && std::min(side_x, side_y) > 2)) return std::nullopt;
    Window window;
    window.half = std::clamp(static_cast<int>(std::lround(kArm * longest)), 8, 24);
    window.pitch = kArm / window.half;
    // Smoothing and differences blur a marker's edge by kSmear_px; the band excludes that much if space permits.
    const cv::Matx22d to_px{h(0, 0) / h(2, 2), h(0, 1) / h(2, 2), h(1, 0) / h(2, 2), h(1, 1) / h(2, 2)};
    const double narrow_px = std::abs(cv::determinant(to_px)) / longest;  // smallest height of a square in pixels
    const double band = std::clamp(margin - kSmear_px / std::max(1.0, narrow_px), 0.45 * margin, margin);

    glm::dvec2 centre(0);
    for (int i = 0; i < kMostRefinements; ++i) {
        if (!sample_window(window, grey, h, centre)) return std::nullopt;
        const auto step = corner_offset(window, band);
        if (!step) return std::nullopt;
        centre += *step;
        if (!(glm::length(centre) < kMost)) return std::nullopt;
        if (glm::length(*step) * longest < 2e-3) break;
    }
    if (!sample_window(window, grey, h, centre) || !matches_chessboard(window, first_is_black, band))
        return std::nullopt;
    const cv::Point2d p = apply_homography(h, centre.x, centre.y);
    return glm::dvec2(p.x, p.y);
}

constexpr std::size_t kFewestNeighbours = 4;
constexpr double kSmoothing_px = 0.8;         // removes pixel staircases before gradients are computed
constexpr std::size_t kNearest = 16;          // matches used for a local homography
constexpr double kMarkerNeighbourhood = 2.0;  // squares
constexpr double kNeighbourhood = 3.2;
constexpr double kMarkerLimit_px = 2.5;  // marker corners are accurate to about a pixel
constexpr double kCornerLimit_px = 0.7;
constexpr double kDisagreement_px = 1.0;  // from the neighbours' homography; distortion over three squares is smaller
constexpr double kBoardDisagreement_px = 4;  // from the homography of the whole board, including lens distortion
constexpr int kMostRounds = 12;              // of growing from known corners to their neighbours

// Correspondence of a board point, in squares from the top left, and its image in OpenCV's pixels.
struct Match {
    cv::Point2d square;
    cv::Point2d pixel;
};

struct FoundMarker {
    int id = 0;
    std::array<cv::Point2d, 4> pixels;  // clockwise from the top left as printed
};

std::map<int, cv::Point> squares_of_markers(const BoardDesign& design) {
    std::map<int, cv::Point> squares;
    for (int y = 0; y < design.squares_y; ++y) {
        for (int x = 0; x < design.squares_x; ++x) {
            if (const int marker = marker_of_square(design, x, y); marker >= 0) squares[marker] = {x, y};
        }
    }
    return squares;
}

// Detects the board's markers in the image stretched by sx, sy.
std::vector<FoundMarker> markers_in(const cv::Mat1b& grey, const BoardDesign& design,
                                    const std::map<int, cv::Point>& squares, double sx, double sy) {
    cv::Mat1b stretched = grey;
    if (sx != 1 || sy != 1) cv::resize(grey, stretched, {}, sx, sy, cv::INTER_LINEAR);
    const cv::Ptr<cv::aruco::DetectorParameters> parameters = cv::aruco::DetectorParameters::create();
    parameters->adaptiveThreshWinSizeMin = 5;
    parameters->adaptiveThreshWinSizeMax = std::max(25, std::min(stretched.cols, stretched.rows) / 25);
    parameters->adaptiveThreshWinSizeStep = std::max(6, (parameters->adaptiveThreshWinSizeMax - 5) / 4);
    parameters->minMarkerPerimeterRate = 0.015;
    parameters->perspectiveRemovePixelPerCell = 6;
    parameters->cornerRefinementMethod =
        cv::aruco::CORNER_REFINE_NONE;  // marker corners are not refined, corners of squares are
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    const auto dictionary = cv::aruco::getPredefinedDictionary(find_dictionary(design.dictionary)->number);
    cv::aruco::detectMarkers(stretched, dictionary, corners, ids, parameters);
    std::map<int, int> times;
    for (const int id : ids) ++times[id];
    std::vector<FoundMarker> found;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (!squares.contains(ids[i]) || times[ids[i]] > 1) continue;  // not of this board, or a false detection
        FoundMarker marker{ids[i], {}};
        for (std::size_t k = 0; k < 4; ++k) {
            marker.pixels[k] = {(corners[i][k].x + 0.5) / sx - 0.5, (corners[i][k].y + 0.5) / sy - 0.5};
        }
        found.push_back(marker);
    }
    std::sort(found.begin(), found.end(), [](const FoundMarker& a, const FoundMarker& b) { return a.id < b.id; });
    return found;
}

std::vector<FoundMarker> find_markers(const cv::Mat1b& grey, const BoardDesign& design,
                                      const std::map<int, cv::Point>& squares) {
    constexpr std::array<std::pair<double, double>, 5> kStretches{{{1, 1}, {1, 2}, {2, 1}, {1, 3.5}, {3.5, 1}}};
    std::vector<FoundMarker> best;
    for (const auto& [sx, sy] : kStretches) {
        std::vector<FoundMarker> found = markers_in(grey, design, squares, sx, sy);
        if (found.size() > best.size()) best = std::move(found);
        if (best.size() * 3 >= squares.size()) break;  // enough for a start
    }
    return best;
}

std::vector<Match> matches_of(const std::vector<FoundMarker>& markers, const std::map<int, cv::Point>& squares,
                              double share) {
    const double rim = 0.5 * (1 - share);
    const std::array<cv::Point2d, 4> at{{{rim, rim}, {1 - rim, rim}, {1 - rim, 1 - rim}, {rim, 1 - rim}}};
    std::vector<Match> matches;
    for (const FoundMarker& marker : markers) {
        const cv::Point2d square = squares.at(marker.id);
        for (std::size_t k = 0; k < 4; ++k) matches.push_back({square + at[k], marker.pixels[k]});
    }
    return matches;
}

// Homography from squares, relative to `centre`, to pixels, fitted to the nearest matches. Returns nothing if there are
// too few within `reach`. With limit_px > 0, matches farther than limit_px from the RANSAC consensus are rejected; with
// 0 all are used.
std::optional<cv::Matx33d> homography_around(const cv::Point2d& centre, std::vector<Match> matches, std::size_t count,
                                             double reach, double limit_px) {
    std::erase_if(matches, [&](const Match& m) { return cv::norm(m.square - centre) > reach; });
    if (matches.size() < kFewestNeighbours) return std::nullopt;
    std::stable_sort(matches.begin(), matches.end(), [&](const Match& a, const Match& b) {
        return cv::norm(a.square - centre) < cv::norm(b.square - centre);
    });
    if (matches.size() > count) matches.resize(count);
    std::vector<cv::Point2d> from, to;
    for (const Match& m : matches) {
        from.push_back(m.square - centre);
        to.push_back(m.pixel);
    }
    // Collinear points leave the homography undetermined.
    cv::Matx22d spread = cv::Matx22d::zeros();
    cv::Point2d mean;
    for (const cv::Point2d& p : from) mean += p * (1.0 / static_cast<double>(from.size()));
    for (const cv::Point2d& p : from) {
        const cv::Vec2d d(p.x - mean.x, p.y - mean.y);
        spread += d * d.t();
    }
    if (cv::determinant(spread) < 0.02 * spread(0, 0) * spread(1, 1) || cv::determinant(spread) < 1e-3) {
        return std::nullopt;
    }
    // So do points that are collinear but for one.
    for (const cv::Point2d& p : from) {
        for (const cv::Point2d& q : from) {
            if (p == q) continue;
            const auto beside = std::count_if(
                from.begin(), from.end(), [&](const cv::Point2d& r) { return std::abs((q - p).cross(r - p)) > 1e-6; });
            if (beside < 2) return std::nullopt;
        }
    }
    // OpenCV's RANSAC uses a fixed seed: equal points give equal results.
    const cv::Mat h = cv::findHomography(from, to, limit_px > 0 && from.size() > 6 ? cv::RANSAC : 0, limit_px);
    if (h.empty() || !cv::checkRange(h)) return std::nullopt;
    return cv::Matx33d(h);
}

struct CornerSearch {
    const cv::Mat1f& smooth;
    const BoardDesign& design;
    std::map<int, glm::dvec2> found;  // OpenCV's pixels

    cv::Point2d square_of(int corner) const {
        const cv::Point square(corner % (design.squares_x - 1), corner / (design.squares_x - 1));
        return {square.x + 1.0, square.y + 1.0};
    }

    std::optional<glm::dvec2> refined(int corner, const cv::Matx33d& h) const {
        const int x = corner % (design.squares_x - 1), y = corner / (design.squares_x - 1);
        return refine_corner(smooth, h, square_is_black(x, y), 0.5 * (1 - design.marker_share));
    }

    // Refines all corners that are not found yet and have enough matches near them. Returns the number of new corners.
    int find_near(const std::vector<Match>& matches, std::size_t count, double reach, double limit_px) {
        std::map<int, glm::dvec2> fresh;
        for (int corner = 0; corner < corner_count(design); ++corner) {
            if (found.contains(corner) || !corner_is_printed(design, corner)) continue;
            const auto h = homography_around(square_of(corner), matches, count, reach, limit_px);
            const auto p = h ? refined(corner, *h) : std::nullopt;
            if (p) fresh[corner] = *p;
        }
        found.insert(fresh.begin(), fresh.end());
        return static_cast<int>(fresh.size());
    }

    std::vector<Match> as_matches() const {
        std::vector<Match> matches;
        for (const auto& [corner, p] : found) matches.push_back({square_of(corner), {p.x, p.y}});
        return matches;
    }

    // Homography of the neighbours, or of the whole board where the neighbours are collinear, as at one side of the
    // object.
    static std::optional<cv::Matx33d> homography_near(const cv::Point2d& square, const std::vector<Match>& others,
                                                      double limit_px, double& disagreement_px) {
        disagreement_px = kDisagreement_px;
        const auto near = homography_around(square, others, kNearest, kNeighbourhood, limit_px);
        if (near) return near;
        disagreement_px = kBoardDisagreement_px;
        return homography_around(square, others, others.size(), std::numeric_limits<double>::infinity(),
                                 limit_px > 0 ? kBoardDisagreement_px : 0);
    }

    // Distance of a match from its position predicted by the others, relative to the limit; 0 without a prediction.
    static double disagreement(const Match& match, std::vector<Match> others) {
        std::erase_if(others, [&](const Match& m) { return m.square == match.square; });
        double allowed_px = 0;
        const auto h = homography_near(match.square, others, kCornerLimit_px, allowed_px);
        if (!h) return 0;
        const cv::Point2d expected((*h)(0, 2) / (*h)(2, 2), (*h)(1, 2) / (*h)(2, 2));
        return cv::norm(match.pixel - expected) / allowed_px;
    }

    // Removes matches that disagree with their neighbours, the worst first because it may cause the disagreement of
    // others. The remaining corners are refined again with a homography of corners, which is more accurate than that of
    // markers.
    void reject_and_refine() {
        std::vector<Match> agreed = as_matches();
        while (!agreed.empty()) {
            std::vector<double> off(agreed.size());
            std::transform(agreed.begin(), agreed.end(), off.begin(),
                           [&](const Match& match) { return disagreement(match, agreed); });
            const auto worst = std::max_element(off.begin(), off.end());
            if (*worst < 1) break;
            agreed.erase(agreed.begin() + (worst - off.begin()));
        }
        std::map<int, glm::dvec2> kept;
        for (const Match& match : agreed) {
            const auto x = static_cast<int>(match.square.x) - 1, y = static_cast<int>(match.square.y) - 1;
            const int corner = y * (design.squares_x - 1) + x;
            double disagreement_px = 0;
            auto h = homography_near(match.square, agreed, 0, disagreement_px);
            if (h) {  // start from the previous position
                const cv::Point2d at((*h)(0, 2) / (*h)(2, 2), (*h)(1, 2) / (*h)(2, 2));
                *h = cv::Matx33d(1, 0, match.pixel.x - at.x, 0, 1, match.pixel.y - at.y, 0, 0, 1) * *h;
            }
            const auto p = h ? refined(corner, *h) : std::nullopt;
            if (p) kept[corner] = *p;
        }
        found = std::move(kept);
    }
};

BoardCorners corners_in(const cv::Mat1b& grey, const BoardDesign& design) {
    const std::map<int, cv::Point> squares = squares_of_markers(design);
    const std::vector<Match> markers = matches_of(find_markers(grey, design, squares), squares, design.marker_share);
    if (markers.empty()) return {};
    // Edges are located at half the linear intensity, not at half the sRGB code.
    cv::Mat1f smooth(grey.size());
    for (int y = 0; y < grey.rows; ++y) {
        for (int x = 0; x < grey.cols; ++x) smooth(y, x) = 255 * linear_from_srgb8(grey(y, x));
    }
    cv::GaussianBlur(smooth, smooth, {0, 0}, kSmoothing_px, kSmoothing_px, cv::BORDER_REPLICATE);
    CornerSearch search{smooth, design, {}};
    search.find_near(markers, kNearest, kMarkerNeighbourhood, kMarkerLimit_px);
    for (int pass = 0; pass < 2; ++pass) {  // the second pass finds corners that a poor neighbour spoiled in the first
        for (int round = 0; round < kMostRounds; ++round) {
            if (search.find_near(search.as_matches(), kNearest, kNeighbourhood, kCornerLimit_px) == 0) break;
        }
        search.reject_and_refine();
    }
    BoardCorners seen;
    for (const auto& [corner, p] : search.found) seen.corners.push_back({corner, p + glm::dvec2(0.5)});
    return seen;
}

}  // namespace

Result<BoardCorners> detect_board(ConstImageView<std::uint8_t> grey, const BoardDesign& design) {
    RS_TRY(check_board_design(design));
    if (grey.width() < 8 || grey.height() < 8) return BoardCorners{};
    try {
        return corners_in(mat_view(grey), design);
    } catch (const cv::Exception& e) {
        return Error{"the board cannot be detected: " + std::string(e.what()) +
                     "; check that the image can be shown by other programs"};
    }
}

Result<BoardCorners> detect_board(ConstImageView<Rgba8> image, const BoardDesign& design) {
    Image<std::uint8_t> grey(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        const Rgba8* from = image.row(y);
        for (int x = 0; x < image.width(); ++x) {
            grey(x, y) = static_cast<std::uint8_t>((299 * from[x].r + 587 * from[x].g + 114 * from[x].b + 500) / 1000);
        }
    }
    return detect_board(std::as_const(grey).view(), design);
}

Result<std::vector<BoardCorners>> detect_boards(int views, const std::function<Result<Image<Rgba8>>(int)>& load,
                                                const BoardDesign& design, Progress* progress) {
    std::vector<BoardCorners> seen(static_cast<std::size_t>(std::max(0, views)));
    RS_TRY(for_each_in_parallel(views, "detecting the board", progress, [&](int view) -> Status {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, load(view));
        Result<BoardCorners> found = detect_board(image.view(), design);
        if (!found) return Error{"view " + std::to_string(view) + ": " + found.error().message};
        seen[static_cast<std::size_t>(view)] = std::move(*found);
        return {};
    }));
    return seen;
}

}  // namespace rs::capture
