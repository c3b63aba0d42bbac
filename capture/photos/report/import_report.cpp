#include "capture/photos/report/import_report.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/page/html_page.hpp"
#include "rayspace/page/page_images.hpp"
#include "rayspace/page/plots.hpp"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace rs::capture {
namespace {

constexpr int kShift = 4;  // fractional bits of the coordinates for OpenCV's drawing functions

cv::Point fixed(const glm::dvec2& p, double scale) {
    // OpenCV has pixel centres at integer coordinates.
    const auto coordinate = [&](double value) {
        return static_cast<int>(std::lround(std::clamp((value * scale - 0.5), -1e4, 1e4) * (1 << kShift)));
    };
    return {coordinate(p.x), coordinate(p.y)};
}

// Colour scale from green to red over 0.5 .. 2 px.
cv::Scalar residual_colour(double residual_px) {
    const double t = std::clamp((residual_px - 0.5) / 1.5, 0.0, 1.0);
    return {60 + 195 * t, 230 - 200 * t, 60, 255};
}

// Maps a point `p` in the image of the fixed camera to the photo of view `view`, which may be shifted and scaled.
glm::dvec2 in_photo(const Calibration& calibration, int view, const glm::dvec2& p) {
    if (calibration.places.empty()) return p;
    const Lens& lens = calibration.model.lens;
    return calibration.places[static_cast<std::size_t>(view)].seen(p, {lens.width / 2.0, lens.height / 2.0});
}

void draw_axis(cv::Mat& image, const ImportReport& report, int view, double scale) {
    const cv::Scalar white(255, 255, 255, 255), black(0, 0, 0, 255);
    std::vector<glm::dvec2> line;
    if (report.calibration.calibration) {
        const Calibration& calibration = *report.calibration.calibration;
        const TurntableModel& model = calibration.model;
        // The axis is a polyline, because lens distortion bends it.
        for (int i = -200; i <= 200; ++i) {
            if (const auto p = project(model.lens, model.pose, {0, 0.01 * i, 0})) {
                line.push_back(in_photo(calibration, view, *p));
            }
        }
    } else {
        line = {{report.nominal.axis_x_px, 0}, {report.nominal.axis_x_px, static_cast<double>(report.folder.height)}};
    }
    for (const int thickness : {3, 1}) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            cv::line(image, fixed(line[i - 1], scale), fixed(line[i], scale), thickness == 3 ? black : white, thickness,
                     cv::LINE_AA, kShift);
        }
    }
}

void draw_points(cv::Mat& image, const TrackCalibration& tracks, int view, double scale) {
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
            cv::line(image, fixed(at_before, scale), fixed(at_here, scale), colour, 1, cv::LINE_AA, kShift);
        }
        cv::circle(image, fixed(at_here, scale), 2 << kShift, colour, cv::FILLED, cv::LINE_AA, kShift);
    }
}

}  // namespace

std::string sizes_text(const PhotoFolder& folder) {
    std::string text = size_text(folder.shown_width, folder.shown_height) + " photos";
    if (folder.reduction > 1) text += " reduced to " + size_text(folder.width, folder.height);
    return text;
}

Image<Rgba8> annotated_photo(ConstImageView<Rgba8> photo, const ImportReport& report, int view) {
    Image<Rgba8> small = downscale(photo, kAnnotatedSide_px);
    for (Rgba8& p : small.pixels()) p = over(p, {128, 128, 128, 255});
    const double scale = static_cast<double>(small.width()) / photo.width();
    cv::Mat image = writable_mat_view(small);
    if (report.calibration.tracks) draw_points(image, *report.calibration.tracks, view, scale);
    draw_axis(image, report, view, scale);
    return small;
}

namespace {

constexpr int kAnnotated = 6;
constexpr int kMattes = 18;
constexpr Rgba8 kMagenta{255, 0, 255, 255};

std::string number(double value, int digits) {
    return std::isfinite(value) ? format_fixed(value, digits) : "unknown";
}

std::string deviation(double value, int digits) {
    return value == 0 ? "fixed" : number(value, digits);
}

std::string basis_of(CalibrationMethod method) {
    switch (method) {
        case CalibrationMethod::kBoard:
            return "the printed board on the turntable.";
        case CalibrationMethod::kGiven:
            return "given values; nothing was estimated.";
        case CalibrationMethod::kTracks:
            return "points of the object tracked around the turn.";
        case CalibrationMethod::kSilhouettes:
            return "the silhouettes of the object alone, which hardly determine the lens, nor the steps of round "
                   "bodies.";
        case CalibrationMethod::kNominal:
            return "assumptions: equal steps, a level camera, and a typical lens if none is known.";
    }
    return "";
}

void add_summary(HtmlPage& page, const ImportReport& report) {
    page.paragraph(std::to_string(report.views) + " views of " + sizes_text(report.folder) +
                   ". Calibration: " + to_string(report.method) + ". Based on " + basis_of(report.method));
    if (report.notes.empty()) {
        page.paragraph("No warnings.");
    } else {
        page.heading("Warnings and notes");
        page.list(report.notes);
    }
}

void add_estimates(HtmlPage& page, const Calibration& found) {
    const Lens& lens = found.model.lens;
    const CameraPose& pose = found.model.pose;
    const ModelDeviations& off = found.deviations;
    const double half_width = 0.5 * lens.width;
    page.heading("Estimates");
    std::vector<std::vector<std::string>> rows{
        {"focal length, px", number(lens.f_px, 1), deviation(off.f_px, 1)},
        {"field of view, degrees", number(degrees(2 * std::atan(half_width / lens.f_px)), 2),
         deviation(
             off.f_px == 0 ? 0 : degrees(2 * half_width * off.f_px / (lens.f_px * lens.f_px + half_width * half_width)),
             2)},
        {"principal point x, px", number(lens.cx, 1), deviation(off.cx, 1)},
        {"principal point y, px", number(lens.cy, 1), deviation(off.cy, 1)},
        {"radial distortion k1", number(lens.k1, 4), deviation(off.k1, 4)},
        {"radial distortion k2", number(lens.k2, 4), deviation(off.k2, 4)},
        {"camera above the turntable, degrees", number(degrees(pose.tilt_rad), 3), deviation(degrees(off.tilt_rad), 3)},
        {"roll, degrees", number(degrees(pose.roll_rad), 3), deviation(degrees(off.roll_rad), 3)},
        {"axis' direction, degrees", "", deviation(degrees(off.axis_direction_rad), 3)},
    };
    if (const auto column = axis_column(lens, pose, 0.5 * lens.height)) {
        rows.push_back({"axis' column at half height, px", number(*column, 2), deviation(off.axis_position_px, 2)});
    }
    rows.push_back({"median step, degrees", number(degrees(found.step_rad), 3), ""});
    page.table({"", "value", "standard deviation"}, rows);
    if (found.observations == 0) return;
    const std::string points = found.points > 0 ? std::to_string(found.points) + " points in " : "";
    const std::string held_out =
        found.held_out_rms_px ? ", " + number(*found.held_out_rms_px, 3) + " px for held-out observations" : "";
    page.paragraph(points + std::to_string(found.observations) + " observations; residuals " + number(found.rms_px, 3) +
                   " px RMS" + held_out + ".");
}

void add_plots(HtmlPage& page, const Calibration& found) {
    const std::vector<double>& angles = found.model.angles_rad;
    if (angles.size() < 2) return;
    const auto last = static_cast<double>(angles.size() - 1);
    // Deviations are relative to equal steps with the mean offset of all angles, so that a single wrong step appears as
    // a step in the plot.
    double mean = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        mean += degrees(angles[i] - static_cast<double>(i) * found.step_rad) / (last + 1);
    }
    PlotSeries value{"off equal steps", {}, {}}, above{"+2 deviations", {}, {}}, below{"-2 deviations", {}, {}};
    PlotSeries rms{"residual, px RMS", {}, {}}, count{"observations", {}, {}};
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const auto view = static_cast<double>(i);
        const double off = degrees(angles[i] - view * found.step_rad) - mean;
        const double doubt = i < found.deviations.angles_rad.size() ? 2 * degrees(found.deviations.angles_rad[i]) : 0;
        value.x.push_back(view);
        value.y.push_back(off);
        above.x.push_back(view);
        above.y.push_back(off + doubt);
        below.x.push_back(view);
        below.y.push_back(off - doubt);
        if (i >= found.views.size()) continue;
        rms.x.push_back(view);
        rms.y.push_back(found.views[i].rms_px);
        count.x.push_back(view);
        count.y.push_back(found.views[i].observations);
    }
    page.heading("Angles and residuals");
    page.drawing(draw_svg({"Angles against equal steps", "photo", "degrees", {value, above, below}}));
    if (found.observations == 0) return;
    page.drawing(draw_svg({"Residuals", "photo", "px", {rms}, 900, 220}));
    page.drawing(draw_svg({"Observations", "photo", "", {count}, 900, 220}));
}

Status add_photos(HtmlPage& page, const ImportReport& report) {
    std::vector<CaptionedImage> row;
    for (const int view : select_evenly(static_cast<int>(report.folder.photos.size()), kAnnotated)) {
        const auto i = static_cast<std::size_t>(view);
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(report.folder, i));
        row.push_back({annotated_photo(photo, report, view), source_name(report, i)});
    }
    page.heading("The axis and the points");
    page.paragraph(report.calibration.tracks
                       ? "White: the turntable's axis. Points: detected positions, with the motion from the previous "
                         "view; green where the residual is below a pixel, red from two pixels on."
                       : "White: the turntable's axis.");
    return page.images(row, kAnnotatedSide_px);
}

Status add_alpha_mattes(HtmlPage& page, const ImportReport& report) {
    std::vector<CaptionedImage> row;
    for (const int view : select_evenly(static_cast<int>(report.small_foregrounds.size()), kMattes)) {
        Image<Rgba8> matte = report.small_foregrounds[static_cast<std::size_t>(view)];
        for (Rgba8& p : matte.pixels()) p = over(p, kMagenta);
        row.push_back({std::move(matte), source_name(report, static_cast<std::size_t>(view))});
    }
    page.heading("Alpha mattes over magenta");
    return page.images(row, 260);
}

}  // namespace

Result<std::string> import_page(const std::filesystem::path& photos, const ImportReport& report) {
    HtmlPage page("Import of " + photos.string());
    add_summary(page, report);
    if (report.calibration.calibration) {
        add_estimates(page, *report.calibration.calibration);
        add_plots(page, *report.calibration.calibration);
    }
    RS_TRY(add_photos(page, report));
    RS_TRY(add_alpha_mattes(page, report));
    return page.text();
}

}  // namespace rs::capture
