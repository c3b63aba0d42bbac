// Accuracy of calibration board corners detected by detect_board and by OpenCV (cv::aruco::detectMarkers and
// interpolateCornersCharuco) in rendered photos with known corners.
//
//     bench_charuco [--views N]
//
// Prints CSV, a row per camera elevation: for each detector the corners per view, the RMS error of corners less than 2
// px off, the number of corners farther off, and the milliseconds per view.

#include "capture/calibration/board/aruco_dictionary.hpp"
#include "tests/bench/stopwatch.hpp"
#include "tests/capture/calibration/drawn_board.hpp"

#include <opencv2/aruco/charuco.hpp>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

namespace rs {
namespace {

capture::BoardCorners found_by_opencv(const Image<Rgba8>& image, const capture::BoardDesign& design) {
    cv::Mat1b grey(image.height(), image.width());
    for (int y = 0; y < grey.rows; ++y) {
        for (int x = 0; x < grey.cols; ++x) grey(y, x) = image(x, y).g;
    }
    const auto dictionary = cv::aruco::getPredefinedDictionary(capture::find_dictionary(design.dictionary)->number);
    const auto side = static_cast<float>(design.square_mm);
    const auto board = cv::aruco::CharucoBoard::create(design.squares_x, design.squares_y, side,
                                                       side * static_cast<float>(design.marker_share), dictionary);
    std::vector<std::vector<cv::Point2f>> markers;
    std::vector<int> marker_ids;
    cv::aruco::detectMarkers(grey, dictionary, markers, marker_ids);
    capture::BoardCorners seen;
    if (marker_ids.empty()) return seen;
    std::vector<cv::Point2f> corners;
    std::vector<int> ids;
    cv::aruco::interpolateCornersCharuco(markers, marker_ids, grey, board, corners, ids);
    // Pixel centres are at +0.5, as in detect_board.
    for (std::size_t i = 0; i < ids.size(); ++i) seen.corners.push_back({ids[i], {corners[i].x, corners[i].y}});
    return seen;
}

struct Sum {
    int corners = 0, far = 0;
    double squares = 0, seconds = 0;
};

void add(Sum& sum, const Image<Rgba8>& image, const capture::BoardTurn& turn, std::size_t view,
         const std::function<capture::BoardCorners(const Image<Rgba8>&)>& find) {
    constexpr double kFar_px = 2;
    const bench::Stopwatch watch;
    const capture::BoardCorners seen = find(image);
    sum.seconds += watch.wall_s();
    for (const capture::DetectedCorner& one : seen.corners) {
        const auto p =
            capture::project(turn.model.lens, turn.model.pose, test::corner_in_table(turn, {}, one.corner, view));
        const double off_px = p ? glm::length(*p - one.p) : kFar_px;
        if (off_px < kFar_px) {
            ++sum.corners;
            sum.squares += off_px * off_px;
        } else {
            ++sum.far;
        }
    }
}

void print(const Sum& sum, int views) {
    std::printf(",%.1f,%.3f,%d,%.0f", double(sum.corners) / views, std::sqrt(sum.squares / std::max(sum.corners, 1)),
                sum.far, 1e3 * sum.seconds / views);
}

}  // namespace
}  // namespace rs

int main(int argc, char** argv) {
    using namespace rs;
    const int views = argc == 3 && std::string(argv[1]) == "--views" ? std::atoi(argv[2]) : 8;
    if (views < 1 || (argc != 1 && argc != 3)) {
        std::fprintf(stderr, "usage: bench_charuco [--views N]\n");
        return 2;
    }
    std::puts("degrees,hidden_mm,corners,rms_px,far,ms,opencv_corners,opencv_rms_px,opencv_far,opencv_ms");
    for (const double hidden_mm : {0.0, 25.0}) {
        for (const double height_deg : {15.0, 20.0, 30.0, 45.0, 70.0}) {
            test::TurnOptions options;
            options.elevation_deg = height_deg;
            const capture::BoardTurn turn = test::small_turn(options, 2);
            Sum ours, theirs;
            for (int i = 0; i < views; ++i) {
                const auto view = static_cast<std::size_t>(i * options.views / views);
                const Image<Rgba8> image = test::drawn(turn, {}, view, hidden_mm);
                add(ours, image, turn, view, [](const Image<Rgba8>& shown) {
                    const auto seen = capture::detect_board(shown.view(), {});
                    return seen ? *seen : capture::BoardCorners{};
                });
                add(theirs, image, turn, view,
                    [](const Image<Rgba8>& shown) { return found_by_opencv(shown, capture::BoardDesign{}); });
            }
            std::printf("%.0f,%.0f", height_deg, hidden_mm);
            print(ours, views);
            print(theirs, views);
            std::puts("");
        }
    }
    return 0;
}
