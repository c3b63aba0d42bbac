// How far the cut-outs of a turn are from the true alpha, and how long cutting takes.
//
//     bench_matte PHOTOS TRUTH [--every N] [--pictures DIR]
//     bench_matte --cut-outs SET TRUTH [--every N] [--pictures DIR]
//
// The first form cuts the photographs itself, with the stages of `rs-capture import` up to the cut-out; the second
// measures a set that was imported with `--calibration nominal`, whose pictures stand where the photographs' do. TRUTH
// holds as many pictures, in the same order, white where the object is: what `rs-capture synth --as-photos` writes to
// truth/alpha. Of N views only one is cut. Prints CSV per view and the means over all views:
//   all     mean absolute error of alpha over the whole picture, 0..1
//   band    the same over the pixels within 2.5 px of the true alpha's 0.5 contour
//   signed  mean error in that band: below 0 where the cut-out is too thin, above 0 where it is too fat
// DIR gets the plate, and per view the cut-out over magenta, and beside it the error: red where alpha is too small,
// blue too large.

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/intake/photograph.hpp"
#include "capture/photos/intake/survey.hpp"
#include "capture/photos/matte/cut_out.hpp"
#include "rayspace/pictures/picture_io.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::string pictures_in;
    std::string truth;
    std::string pictures_out;
    bool cut_outs = false;
    std::size_t every = 1;
};

struct Wrong {
    double all = 0;
    double band = 0;
    double band_signed = 0;
};

// As masks are read on import: grey is alpha, and so is white on transparent.
double true_alpha(const Rgba8& p) {
    return p.g / 255.0 * p.a / 255.0;
}

// Distance of the centre of every pixel to the contour, which runs half a pixel before the first one of the other side.
cv::Mat1f contour_distance(ConstImageView<Rgba8> truth) {
    cv::Mat1b inside(truth.height(), truth.width());
    for (int y = 0; y < inside.rows; ++y) {
        for (int x = 0; x < inside.cols; ++x) inside(y, x) = true_alpha(truth(x, y)) >= 0.5 ? 255 : 0;
    }
    cv::Mat1b outside;
    cv::bitwise_not(inside, outside);
    cv::Mat1f depth_inside;
    cv::Mat1f depth_outside;
    cv::distanceTransform(inside, depth_inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::distanceTransform(outside, depth_outside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::Mat1f distance;
    cv::addWeighted(depth_inside, 1, depth_outside, 1, -0.5, distance);
    return distance;
}

Wrong compare(ConstImageView<Rgba8> cut, ConstImageView<Rgba8> truth) {
    constexpr float kBand_px = 2.5F;
    const cv::Mat1f distance = contour_distance(truth);
    Wrong sum;
    double in_band = 0;
    for (int y = 0; y < cut.height(); ++y) {
        for (int x = 0; x < cut.width(); ++x) {
            const double wrong = cut(x, y).a / 255.0 - true_alpha(truth(x, y));
            sum.all += std::abs(wrong);
            if (distance(y, x) > kBand_px) continue;
            sum.band += std::abs(wrong);
            sum.band_signed += wrong;
            in_band += 1;
        }
    }
    sum.all /= static_cast<double>(cut.width()) * cut.height();
    sum.band /= std::max(1.0, in_band);
    sum.band_signed /= std::max(1.0, in_band);
    return sum;
}

Image<Rgba8> shown(ConstImageView<Rgba8> cut, ConstImageView<Rgba8> truth) {
    Image<Rgba8> picture(2 * cut.width(), cut.height());
    for (int y = 0; y < cut.height(); ++y) {
        for (int x = 0; x < cut.width(); ++x) {
            const Rgba8& p = cut(x, y);
            const double alpha = p.a / 255.0;
            const auto over = [&](int own, int behind) {
                return static_cast<std::uint8_t>(std::lround(alpha * own + (1 - alpha) * behind));
            };
            picture(x, y) = {over(p.r, 255), over(p.g, 0), over(p.b, 255), 255};
            const double wrong = alpha - true_alpha(truth(x, y));
            const auto grey = static_cast<std::uint8_t>(255 - (p.r + p.g + p.b) / 12);
            const auto faded = static_cast<std::uint8_t>(grey * (1 - std::abs(wrong)));
            picture(cut.width() + x, y) = {wrong < 0 ? grey : faded, faded, wrong > 0 ? grey : faded, 255};
        }
    }
    return picture;
}

// The plate, and beside it where it is known; what is never covered is greyed.
Image<Rgba8> shown_plate(const Backdrop& backdrop) {
    const int width = backdrop.plate.width();
    Image<Rgba8> picture(2 * width, backdrop.plate.height());
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < width; ++x) {
            Rgba8 p = backdrop.plate(x, y);
            picture(x, y) = p;
            if (!backdrop.untouched.empty() && backdrop.untouched(x, y) != 0) {
                const auto grey = static_cast<std::uint8_t>((p.r + p.g + p.b) / 6 + 100);
                p = {grey, grey, grey, 255};
            }
            picture(width + x, y) = backdrop.known(x, y) != 0 ? p : Rgba8{255, 0, 255, 255};
        }
    }
    return picture;
}

// Cuts one photograph after the other, so that the time per picture means something.
class Cutter {
public:
    static Result<Cutter> create(const PhotoFolder& folder, const std::string& pictures_out) {
        const Result<Survey> survey = survey_photos(folder, nullptr);
        if (!survey) return survey.error();
        const bench::Stopwatch watch;
        const Result<Backdrop> backdrop = find_backdrop(*survey, {}, folder.photos.front().parent_path().string());
        if (!backdrop) return backdrop.error();
        std::printf("# backdrop %s, found in %.2f s\n", to_string(backdrop->kind).c_str(), watch.wall_s());
        if (!pictures_out.empty()) {
            if (Status status = write_png(fs::path(pictures_out) / "plate.png", shown_plate(*backdrop)); !status)
                return status.error();
        }
        return Cutter(ObjectCutter(*backdrop, folder.width, folder.height));
    }
    Image<Rgba8> cut(ConstImageView<Rgba8> photo) {
        const bench::Stopwatch watch;
        Image<Rgba8> result = cutter_.cut(photo);
        seconds_ += watch.wall_s();
        return result;
    }
    [[nodiscard]] double seconds() const { return seconds_; }

private:
    explicit Cutter(ObjectCutter cutter) : cutter_(std::move(cutter)) {}
    ObjectCutter cutter_;
    double seconds_ = 0;
};

Status run(const Arguments& arguments) {
    const Result<PhotoFolder> folder =
        open_photo_folder(fs::path(arguments.pictures_in) / (arguments.cut_outs ? "images" : ""));
    if (!folder) return folder.error();
    const Result<PhotoFolder> truth_folder = open_photo_folder(arguments.truth);
    if (!truth_folder) return truth_folder.error();
    if (truth_folder->photos.size() != folder->photos.size() || truth_folder->width != folder->width ||
        truth_folder->height != folder->height) {
        return Error{arguments.truth + ": has not as many pictures as " + arguments.pictures_in +
                     ", or of another size; a calibrated set is rectified, import with --calibration nominal"};
    }
    if (!arguments.pictures_out.empty()) fs::create_directories(arguments.pictures_out);
    std::optional<Cutter> cutter;
    if (!arguments.cut_outs) {
        Result<Cutter> created = Cutter::create(*folder, arguments.pictures_out);
        if (!created) return created.error();
        cutter = std::move(*created);
    }
    std::printf("view,all,band,signed\n");
    Wrong sum;
    double views = 0;
    for (std::size_t i = 0; i < folder->photos.size(); i += arguments.every) {
        Result<Image<Rgba8>> picture = read_photograph(*folder, i);
        if (!picture) return picture.error();
        const Result<Image<Rgba8>> truth = read_picture(truth_folder->photos[i]);
        if (!truth) return truth.error();
        const Image<Rgba8> cut = cutter ? cutter->cut(*picture) : std::move(*picture);
        const Wrong wrong = compare(cut, *truth);
        std::printf("%zu,%.5f,%.4f,%+.4f\n", i, wrong.all, wrong.band, wrong.band_signed);
        std::fflush(stdout);
        sum.all += wrong.all;
        sum.band += wrong.band;
        sum.band_signed += wrong.band_signed;
        views += 1;
        if (arguments.pictures_out.empty()) continue;
        const fs::path path = fs::path(arguments.pictures_out) / (std::to_string(i) + ".png");
        if (Status status = write_png(path, shown(cut, *truth)); !status) return status;
    }
    std::printf("mean,%.5f,%.4f,%+.4f\n", sum.all / views, sum.band / views, sum.band_signed / views);
    if (cutter) std::printf("# cut in %.2f s, %.2f s per view\n", cutter->seconds(), cutter->seconds() / views);
    return {};
}

}  // namespace
}  // namespace rs::capture

int main(int argc, char** argv) {
    rs::capture::Arguments arguments;
    CLI::App app("Error of cut-outs against true alpha.", "bench_matte");
    app.add_option("PHOTOS", arguments.pictures_in, "folder of photographs, or with --cut-outs a capture set")
        ->required();
    app.add_option("TRUTH", arguments.truth, "folder of pictures with the true alpha")->required();
    app.add_flag("--cut-outs", arguments.cut_outs, "PHOTOS is a capture set, cut out already");
    app.add_option("--every", arguments.every, "cut only every so many-th view")->check(CLI::PositiveNumber);
    app.add_option("--pictures", arguments.pictures_out, "folder for cut-outs and difference pictures");
    app.footer("Example:\n  bench_matte spot-36/photos spot-36/truth/alpha --pictures differences");
    std::function<rs::Status()> run = [&] { return rs::capture::run(arguments); };
    return rs::tool_main(app, argc, argv, run);
}
