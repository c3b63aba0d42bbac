#include "capture/photos/matte/enclosed_parts.hpp"

#include "capture/opencv/connected_parts.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/light_share.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/base/check.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {
namespace {

// Edges are looked for in pictures of at most this side: there they are a pixel or two wide.
constexpr int kSide_px = 1024;

constexpr float kSurely = 1;     // what speaks so for the object is taken for it
constexpr int kEdgeWall_px = 2;  // edges are made wider by so much, and so closed where they vanish for four pixels
constexpr int kGap_px = 9;

constexpr double kGoodPart = 0.3;  // objects have sides that look plain
constexpr double kSeen = 0.5;      // of what is left must be reached; less is noise
constexpr double kDust = 0.002;    // of the picture
// Of what surely is the object: a plain part that is smaller is a spot, not a hole; and so much must be enclosed.
// Measured on a white car 0.48 to 0.90, on a shoe of suede up to 0.15.
constexpr double kSpot = 0.01;
constexpr double kMuchOfObject = 0.3;

cv::Mat3f smoothed(const cv::Mat3f& light, cv::Size size) {
    cv::Mat3f result;
    cv::resize(light, result, size, 0, 0, cv::INTER_AREA);
    return smoothed_light(result);
}

LinearRgb light_of(const cv::Vec3f& light) {
    return {light[0], light[1], light[2]};
}

// Parts of a picture without edges; 255 or 0. A part at the picture's border that differs from the plate there is in
// none.
struct OpenParts {
    cv::Mat1b reached;   // from the picture's border
    cv::Mat1b enclosed;  // of the others those of which a good part differs from the plate, ...
    cv::Mat1b spots;     // ... small ones that look plain, ...
    cv::Mat1b plain;     // ... and the rest
};

OpenParts parts_of(const cv::Mat1b& open, const cv::Mat1b& differs, double spot_px) {
    const ConnectedParts all(open, 4);
    struct Tally {
        int differs = 0, at_border = 0, differs_there = 0;  // px
    };
    auto tallies = all.tallied<Tally>([&](int x, int y, Tally& tally) { tally.differs += differs(y, x) != 0 ? 1 : 0; });
    all.for_each_pixel_at_border([&](int x, int y, int label) {
        ++tallies[label].at_border;
        tallies[label].differs_there += differs(y, x) != 0 ? 1 : 0;
    });
    const cv::Mat1b nothing(open.size(), std::uint8_t{0});
    OpenParts parts{nothing.clone(), nothing.clone(), nothing.clone(), nothing.clone()};
    // Most of the border shows the backdrop, even where this picture is exposed otherwise.
    const auto around = std::ranges::max_element(tallies, {}, &Tally::at_border);
    PerPart<cv::Mat1b*> of_part(all.count());
    for (int label = 1; label < all.count(); ++label) {
        const Tally& tally = tallies[label];
        cv::Mat1b*& of = of_part[label];
        if (tally.at_border > 0) {
            if (&tally == &*around || 2 * tally.differs_there <= tally.at_border) of = &parts.reached;
        } else if (tally.differs >= kGoodPart * all.area(label)) {
            of = &parts.enclosed;
        } else {
            of = all.area(label) <= spot_px ? &parts.spots : &parts.plain;
        }
    }
    all.for_each_pixel([&](int x, int y, int label) {
        if (cv::Mat1b* part = of_part[label]) (*part)(y, x) = 255;
    });
    return parts;
}

Image<std::uint8_t> in_size_of(ConstImageView<Rgba8> photo, const cv::Mat1b& mask) {
    Image<std::uint8_t> result(photo.width(), photo.height());
    cv::Mat1b whole(result.height(), result.width(), result.data());
    cv::resize(mask, whole, whole.size(), 0, 0, cv::INTER_NEAREST);
    return result;
}

}  // namespace

Image<std::uint8_t> find_object_by_edges(const SeenPhoto& photo, const CleanPlateView& plate,
                                         const MaskOptions& options) {
    RS_CHECK(photo.width() == plate.behind.width() && photo.height() == plate.behind.height());
    if (photo.width() == 0 || photo.height() == 0) return {};
    const double scale = std::min(1.0, static_cast<double>(kSide_px) / std::max(photo.width(), photo.height()));
    const cv::Size size(std::max(1, cvRound(photo.width() * scale)), std::max(1, cvRound(photo.height() * scale)));
    const cv::Mat3f light = smoothed(linear_mat(photo.picture), size),
                    behind = smoothed(light_mat(plate.behind.light), size);
    cv::Mat1b object = [&] {
        const Image<float> preference = object_preference(photo, plate, options);
        cv::Mat1b strong(photo.height(), photo.width());
        for (int y = 0; y < strong.rows; ++y) {
            for (int x = 0; x < strong.cols; ++x) strong(y, x) = preference(x, y) >= kSurely ? 255 : 0;
        }
        return strong;
    }();
    cv::resize(object, object, size, 0, 0, cv::INTER_NEAREST);

    cv::Mat1b walls;
    cv::bitwise_or(edges_of_share(log_light_share(light, behind)), object, walls);
    cv::dilate(walls, walls, cv::Mat(), {-1, -1}, kEdgeWall_px);
    cv::Mat1b open, differs(size);
    cv::bitwise_not(walls, open);
    for (int y = 0; y < differs.rows; ++y) {
        for (int x = 0; x < differs.cols; ++x) {
            const float off = delta_e(lab_from_linear(light_of(light(y, x))), lab_from_linear(light_of(behind(y, x))));
            differs(y, x) = off > options.plain_delta_e ? 255 : 0;
        }
    }
    const OpenParts parts = parts_of(open, differs, kSpot * cv::countNonZero(object));
    const int object_px = cv::countNonZero(object), enclosed_px = cv::countNonZero(parts.enclosed);
    const bool much = enclosed_px > kMuchOfObject * object_px && enclosed_px > kDust * size.area();
    if (!much || cv::countNonZero(parts.reached) < kSeen * (size.area() - object_px - enclosed_px)) return {};
    cv::Mat1b enclosed, hidden, beside;
    cv::bitwise_or(parts.enclosed, parts.spots, enclosed);
    cv::dilate(enclosed, enclosed, cv::Mat(), {-1, -1}, kEdgeWall_px - 1);
    cv::bitwise_or(enclosed, object, enclosed);
    // What lies between two parts of the object, as a door's gap, is a part of it, and a narrow slit is closed with it.
    cv::morphologyEx(enclosed, hidden, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {kGap_px, kGap_px}));
    cv::bitwise_or(parts.reached, parts.plain, beside);
    cv::dilate(beside, beside, cv::Mat(), {-1, -1}, kEdgeWall_px + 1);
    hidden.setTo(0, beside);
    CleanPlateView told = plate;
    told.hidden = in_size_of(photo.picture, hidden);
    told.seen = in_size_of(photo.picture, parts.reached);
    return find_object(photo, told, options);
}

}  // namespace rs::capture
