#include "capture/photos/annotated_photo.hpp"

#include "capture/photos/intake/opencv_image.hpp"
#include "rayspace/page/page_pictures.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

constexpr int kShift = 4;  // OpenCV draws with 4 fractional bits here

cv::Point fixed(const glm::dvec2& p, double scale) {
    // OpenCV's pixel centres are at integers.
    const auto coordinate = [&](double value) {
        return static_cast<int>(std::lround(std::clamp((value * scale - 0.5), -1e4, 1e4) * (1 << kShift)));
    };
    return {coordinate(p.x), coordinate(p.y)};
}

// Green to red over 0.5 .. 2 px.
cv::Scalar residual_colour(double residual_px) {
    const double t = std::clamp((residual_px - 0.5) / 1.5, 0.0, 1.0);
    return {60 + 195 * t, 230 - 200 * t, 60, 255};
}

// Of the point that a still camera would have seen at `p`, in view `view` as it is.
glm::dvec2 in_photo(const Calibration& calibration, int view, const glm::dvec2& p) {
    if (calibration.places.empty()) return p;
    const Lens& lens = calibration.model.lens;
    return calibration.places[static_cast<std::size_t>(view)].seen(p, {lens.width / 2.0, lens.height / 2.0});
}

void draw_axis(cv::Mat& picture, const ImportReport& report, int view, double scale) {
    const cv::Scalar white(255, 255, 255, 255), black(0, 0, 0, 255);
    std::vector<glm::dvec2> line;
    if (report.calibration.calibration) {
        const Calibration& calibration = *report.calibration.calibration;
        const TurntableModel& model = calibration.model;
        // Piece by piece, for a lens with distortion bends it.
        for (int i = -200; i <= 200; ++i) {
            if (const auto p = project(model.lens, model.pose, {0, 0.01 * i, 0})) {
                line.push_back(in_photo(calibration, view, *p));
            }
        }
    } else {
        line = {{report.nominal.axis_x_px, 0}, {report.nominal.axis_x_px, static_cast<double>(report.height)}};
    }
    for (const int thickness : {3, 1}) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            cv::line(picture, fixed(line[i - 1], scale), fixed(line[i], scale), thickness == 3 ? black : white,
                     thickness, cv::LINE_AA, kShift);
        }
    }
}

void draw_points(cv::Mat& picture, const TrackCalibration& tracks, int view, double scale) {
    const Bundle& bundle = tracks.bundle;
    const auto views = static_cast<int>(bundle.model.angles_rad.size());
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        const auto& seen = bundle.tracks[i].seen;
        const auto at = [&](int wanted) {
            return std::find_if(seen.begin(), seen.end(), [&](const Observation& o) { return o.view == wanted; });
        };
        const auto here = at(view);
        if (here == seen.end()) continue;
        const auto r = residual(bundle.model, bundle.points[i], *here);
        const glm::dvec2 at_here = in_photo(tracks.calibration, view, here->p);
        const cv::Scalar colour = residual_colour(r ? glm::length(*r) : 99);
        if (const auto before = at((view + views - 1) % views); before != seen.end()) {
            const glm::dvec2 at_before = in_photo(tracks.calibration, before->view, before->p);
            cv::line(picture, fixed(at_before, scale), fixed(at_here, scale), colour, 1, cv::LINE_AA, kShift);
        }
        cv::circle(picture, fixed(at_here, scale), 2 << kShift, colour, cv::FILLED, cv::LINE_AA, kShift);
    }
}

}  // namespace

Image<Rgba8> annotated_photo(ConstImageView<Rgba8> photo, const ImportReport& report, int view) {
    Image<Rgba8> small = scaled_down(photo, kAnnotatedSide_px);
    for (Rgba8& p : small.pixels()) p = over(p, {128, 128, 128, 255});
    const double scale = static_cast<double>(small.width()) / photo.width();
    cv::Mat picture(small.height(), small.width(), CV_8UC4, small.data());
    if (report.calibration.tracks) draw_points(picture, *report.calibration.tracks, view, scale);
    draw_axis(picture, report, view, scale);
    return small;
}

}  // namespace rs::capture
