#include "capture/posed/consistent_segmenter.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/posed/silhouette_consistency.hpp"
#include "capture/posed/undistortion.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::capture {
namespace {

constexpr double kMinOverlap = 0.7;  // of masks and projected hull, mean of the views

cv::Size size_of(const Camera& camera) {
    return {camera.width, camera.height};
}

// Pinhole image of a photo, and of its mask, in reduced size.
SilhouetteView reduced_view(const PosedCamera& posed, ConstImageView<Rgba8> photo, const cv::Mat1b& mask) {
    PosedCamera reduced = posed;
    reduced.camera = hull_camera(posed.camera);
    const auto pinhole = [&](const cv::Mat& image) {
        Image<Rgba8> small(reduced.camera.width, reduced.camera.height);
        cv::resize(image, writable_mat_view(small.view()), size_of(reduced.camera), 0, 0, cv::INTER_AREA);
        return undistorted(reduced, reduced.camera, std::move(small));
    };
    SilhouetteView view{{reduced.camera, {}}, pinhole(mat_view(photo))};
    if (mask.empty()) return view;
    cv::Mat colours;
    cv::cvtColor(mask, colours, cv::COLOR_GRAY2RGBA);
    const Image<Rgba8> grey = pinhole(colours);
    view.hull.mask.create(grey.height(), grey.width());
    for (int y = 0; y < grey.height(); ++y) {
        for (int x = 0; x < grey.width(); ++x) view.hull.mask(y, x) = grey(x, y).g >= 128 ? 255 : 0;
    }
    return view;
}

Result<SilhouetteView> read_view(const PhotosToSegment& group, std::size_t i) {
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(*group.folder, i));
    Segmentation segmentation;
    if (group.initial) {
        RS_ASSIGN_OR_RETURN(segmentation, group.initial->segment({i, photo.view()}));
    }
    const cv::Mat1b mask = segmentation.mask.empty() ? cv::Mat1b() : mat_view(segmentation.mask.view());
    return reduced_view(group.cameras[i], photo.view(), mask);
}

// Enlarges and refines masks of reduced pinhole images.
class ConsistentSegmenter : public Segmenter {
public:
    ConsistentSegmenter(std::vector<PosedCamera> cameras, std::vector<cv::Mat1b> masks, const ColourHistogram& object)
        : cameras_(std::move(cameras)), masks_(std::move(masks)), object_(object) {}
    [[nodiscard]] std::string name() const override { return "all views"; }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override {
        const PosedCamera& posed = cameras_[photo.index];
        const Camera reduced = hull_camera(posed.camera);
        const cv::Mat1b mask = distorted_mask(posed, reduced, masks_[photo.index]);
        const int band_px = 2 + static_cast<int>(std::lround(1.5 * posed.camera.width / reduced.width));
        return Segmentation{refine_silhouette(photo.image, mask, object_, band_px)};
    }

private:
    std::vector<PosedCamera> cameras_;
    std::vector<cv::Mat1b> masks_;
    ColourHistogram object_;
};

double changed_share(const cv::Mat1b& before, const cv::Mat1b& after) {
    const int count = cv::countNonZero(before);
    return count > 0 ? static_cast<double>(cv::countNonZero(before ^ after)) / count : 0;
}

}  // namespace

Result<ConsistentSegmenters> make_consistent_segmenters(std::span<const PhotosToSegment> groups,
                                                        const TargetFinder& find_target, Progress* progress) {
    std::vector<SilhouetteView> views;
    for (const PhotosToSegment& group : groups) {
        const std::size_t first = views.size();
        views.resize(first + group.cameras.size());
        RS_TRY(for_each_photo(*group.folder, kSegmentBytesPerPixel, "reading photos", progress,
                              [&](std::size_t i) -> Status {
                                  RS_ASSIGN_OR_RETURN(views[first + i], read_view(group, i));
                                  return {};
                              }));
    }
    std::vector<HullView> hulls;
    for (const SilhouetteView& view : views) {
        hulls.push_back(view.hull);
        cv::Mat1b& mask = hulls.back().mask;
        if (mask.empty() || cv::countNonZero(mask) == 0) mask = cv::Mat1b(size_of(view.hull.camera), std::uint8_t{255});
    }
    RS_ASSIGN_OR_RETURN(const glm::dvec3 target, find_target(hulls));
    std::vector<cv::Mat1b> initial;
    for (std::size_t i = 0; i < views.size(); ++i) {
        views[i].hull.camera = hulls[i].camera;
        initial.push_back(views[i].hull.mask);
    }
    RS_ASSIGN_OR_RETURN(ConsistentSilhouettes found, make_consistent(std::move(views), target, progress));
    if (!(found.overlap >= kMinOverlap)) return Error{"the views do not agree about the object"};
    ConsistentSegmenters result;
    std::size_t view = 0;
    for (const PhotosToSegment& group : groups) {
        std::vector<cv::Mat1b> masks;
        for (std::size_t i = 0; i < group.cameras.size(); ++i, ++view) {
            if (!initial[view].empty()) {
                result.changed += changed_share(initial[view], found.masks[view]) / static_cast<double>(initial.size());
            }
            masks.push_back(std::move(found.masks[view]));
        }
        result.segmenters.push_back(
            std::make_shared<ConsistentSegmenter>(group.cameras, std::move(masks), found.object));
    }
    return result;
}

}  // namespace rs::capture
