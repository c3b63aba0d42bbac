#include "capture/turns/joint_segmentation.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/foreground/graph_cut.hpp"
#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "capture/posed/silhouette_consistency.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace rs::capture {
namespace {

constexpr int kColourBits = 7;          // white objects before white differ by a few codes
constexpr double kSurroundings = 0.25;  // of the visible box's sides, on each side of it
constexpr int kRim_px = 2;              // of the masks, of mixed colours
constexpr float kOwnWeight = 0.05F;     // of a turn's own surroundings, which may be parts of the object
constexpr float kFewPixels = 10;        // of a colour that say little
constexpr float kMostColourScore = 3;
constexpr float kUnmaskedScore = -0.5F;  // of pixels that are not in the mask
constexpr double kLeastAdded = 0.005;    // mean share of a turn's masks

// Counts of colours in the photos of a turn.
struct TurnColours {
    ColourHistogram object{kColourBits}, surroundings{kColourBits}, background{kColourBits};
};

cv::Rect surroundings_of(const TurnToCorrect& turn) {
    const TurnSilhouette::Box& box = turn.visible;
    const int dx = static_cast<int>(kSurroundings * (box.right - box.left));
    const int dy = static_cast<int>(kSurroundings * (box.bottom - box.top));
    return cv::Rect(box.left - dx, box.top - dy, box.right - box.left + 2 * dx, box.bottom - box.top + 2 * dy) &
           cv::Rect(0, 0, turn.folder->width, turn.folder->height);
}

// Without the noise of single pixels.
Image<Rgba8> smoothed(ConstImageView<Rgba8> photo) {
    Image<Rgba8> smooth(photo.width(), photo.height());
    cv::GaussianBlur(mat_view(photo), writable_mat_view(smooth.view()), {3, 3}, 0);
    return smooth;
}

cv::Mat1b solid_mask(ConstImageView<Rgba8> foreground) {
    cv::Mat1b alpha;
    cv::extractChannel(mat_view(foreground), alpha, 3);
    cv::Mat1b mask;
    cv::threshold(alpha, mask, 127, 255, cv::THRESH_BINARY);
    return mask;
}

void count_colours(ConstImageView<Rgba8> photo, const cv::Mat1b& mask, const cv::Rect& box, TurnColours& colours) {
    cv::Mat1b inside, beside;
    cv::erode(mask, inside, cv::Mat(), cv::Point(-1, -1), kRim_px);
    cv::dilate(mask, beside, cv::Mat(), cv::Point(-1, -1), kRim_px);
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            if (inside(y, x) != 0) colours.object.add(photo(x, y));
            if (beside(y, x) != 0) continue;
            (box.contains({x, y}) ? colours.surroundings : colours.background).add(photo(x, y));
        }
    }
}

// Scores of colours for one turn, by its own background and all turns.
class ColourScores {
public:
    ColourScores(const std::vector<TurnColours>& turns, std::size_t own) {
        for (std::size_t t = 0; t < turns.size(); ++t) {
            object_.add(turns[t].object);
            other_.add(turns[t].surroundings, t == own ? kOwnWeight : 1);
        }
        other_.add(turns[own].background);
        object_.smooth();
        other_.smooth();
    }
    [[nodiscard]] float operator()(const Rgba8& colour) const {
        const float ratio = (object_(colour) + kFewPixels) / (other_(colour) + kFewPixels);
        return std::clamp(std::log(ratio), -kMostColourScore, kMostColourScore);
    }

private:
    ColourHistogram object_{kColourBits}, other_{kColourBits};
};

Result<TurnColours> colours_of(const TurnToCorrect& turn, Progress* progress) {
    TurnColours colours;
    std::mutex mutex;
    const cv::Rect box = surroundings_of(turn);
    RS_TRY(for_each_photo(*turn.folder, kSegmentBytesPerPixel, "collecting colours", progress,
                          [&](std::size_t i) -> Status {
                              RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(*turn.folder, i));
                              RS_ASSIGN_OR_RETURN(const Image<Rgba8> foreground, turn.foregrounds->get(i));
                              const Image<Rgba8> smooth = smoothed(photo);
                              const cv::Mat1b mask = solid_mask(foreground);
                              const std::lock_guard lock(mutex);
                              count_colours(smooth, mask, box, colours);
                              return {};
                          }));
    return colours;
}

class JointSegmenter : public Segmenter {
public:
    JointSegmenter(ColourScores colours, const TurnToCorrect& turn)
        : colours_(std::move(colours)), foregrounds_(*turn.foregrounds), box_(surroundings_of(turn)) {}
    [[nodiscard]] std::string name() const override { return "all turns"; }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> foreground, foregrounds_.get(photo.index));
        const cv::Mat1b mask = solid_mask(foreground);
        const Image<Rgba8> smooth = smoothed(photo.image);
        Image<float> score(smooth.width(), smooth.height(), -kCertainScore);
        for (int y = box_.y; y < box_.br().y; ++y) {
            for (int x = box_.x; x < box_.br().x; ++x) {
                score(x, y) = mask(y, x) != 0 ? kCertainScore : colours_(smooth(x, y)) + kUnmaskedScore;
            }
        }
        return Segmentation{graph_cut_coarse_to_fine(lab_image(photo.image), score, {})};
    }

private:
    ColourScores colours_;
    ForegroundCache foregrounds_;
    cv::Rect box_;
};

Result<double> added_share(const TurnToCorrect& turn, const Segmenter& segmenter, Progress* progress) {
    std::vector<double> shares(turn.folder->photos.size());
    RS_TRY(for_each_photo(*turn.folder, kSegmentBytesPerPixel, "comparing colours", progress,
                          [&](std::size_t i) -> Status {
                              RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(*turn.folder, i));
                              RS_ASSIGN_OR_RETURN(const Segmentation found, segmenter.segment({i, photo.view()}));
                              RS_ASSIGN_OR_RETURN(const Image<Rgba8> foreground, turn.foregrounds->get(i));
                              const double before = cv::countNonZero(solid_mask(foreground));
                              const double after = cv::countNonZero(mat_view(found.mask.view()));
                              shares[i] = (after - before) / std::max(1.0, before);
                              return {};
                          }));
    double sum = 0;
    for (const double share : shares) sum += share;
    return sum / static_cast<double>(shares.size());
}

}  // namespace

Result<std::vector<CorrectedTurn>> correct_masks(std::span<const TurnToCorrect> turns, Progress* progress) {
    std::vector<TurnColours> colours(turns.size());
    for (std::size_t t = 0; t < turns.size(); ++t) {
        RS_ASSIGN_OR_RETURN(colours[t], colours_of(turns[t], progress));
    }
    std::vector<CorrectedTurn> corrected;
    for (std::size_t t = 0; t < turns.size(); ++t) {
        const auto segmenter = std::make_shared<JointSegmenter>(ColourScores(colours, t), turns[t]);
        RS_ASSIGN_OR_RETURN(const double added, added_share(turns[t], *segmenter, progress));
        corrected.push_back({added >= kLeastAdded ? segmenter : nullptr, added});
    }
    return corrected;
}

}  // namespace rs::capture
