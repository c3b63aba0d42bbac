#include "capture/posed/silhouette_consistency.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/foreground/graph_cut.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/base/parallel.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace rs::capture {
namespace {

constexpr glm::dvec3 kUpAxis{0, 1, 0};  // of the voxels' frame: their sides are parallel to the world's axes

// Parameters of one round.
struct CutRound {
    HullCarving carving;
    float inside_score = 0;  // of pixels well within the hull's silhouette
};

constexpr float kMaskScore = 0.4F;  // of the given mask
constexpr float kMaxColourScore = 3;
constexpr float kColourWeight = 0.8F;    // of the logarithm of both densities' ratio
constexpr float kUnseenDensity = 3e-6F;  // of colours without samples

float colour_score(const Rgba8& colour, const ColourHistogram& object, const ColourHistogram& background) {
    const float ratio = (object(colour) + kUnseenDensity) / (background(colour) + kUnseenDensity);
    return std::clamp(kColourWeight * std::log(ratio), -kMaxColourScore, kMaxColourScore);
}

// Side of a projected voxel, px.
double voxel_px(const Camera& camera, const VisualHull& hull, const glm::dvec3& target) {
    const double depth = std::max(camera.project(target).z, 1e-9);
    return std::max({hull.step.x, hull.step.y, hull.step.z}) * camera.fl_x / depth;
}

// The voxels with a neighbour that is not in the hull: they have the same silhouettes.
VisualHull surface_of(VisualHull hull) {
    glm::dvec3 low = hull.voxels.front(), high = low;
    for (const glm::dvec3& p : hull.voxels) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::ivec3 size = glm::ivec3(glm::round((high - low) / hull.step)) + 3;  // with a rim of one voxel
    const std::ptrdiff_t row = size.x, slice = row * size.y;
    const auto index_of = [&](const glm::dvec3& p) {
        const glm::ivec3 at = glm::ivec3(glm::round((p - low) / hull.step)) + 1;
        return at.x + at.y * row + at.z * slice;
    };
    std::vector<bool> is_filled(static_cast<std::size_t>(slice * size.z));
    for (const glm::dvec3& p : hull.voxels) is_filled[static_cast<std::size_t>(index_of(p))] = true;
    std::erase_if(hull.voxels, [&](const glm::dvec3& p) {
        const std::ptrdiff_t i = index_of(p);
        const std::array<std::ptrdiff_t, 6> beside{i - 1, i + 1, i - row, i + row, i - slice, i + slice};
        return std::ranges::all_of(beside, [&](std::ptrdiff_t n) { return is_filled[static_cast<std::size_t>(n)]; });
    });
    return hull;
}

// Distance from the contour of a mask: positive inside. At the frame's border a mask continues.
cv::Mat1f contour_distance(const cv::Mat1b& mask) {
    cv::Mat1f inside, outside;
    cv::Mat1b complement;
    cv::bitwise_not(mask, complement);
    cv::distanceTransform(mask, inside, cv::DIST_L2, 3);
    cv::distanceTransform(complement, outside, cv::DIST_L2, 3);
    if (cv::countNonZero(complement) == 0) inside.setTo(static_cast<float>(mask.rows + mask.cols));
    if (cv::countNonZero(mask) == 0) outside.setTo(static_cast<float>(mask.rows + mask.cols));
    inside -= outside;
    return inside;
}

template <class Selects>
ColourHistogram histogram_of(ConstImageView<Rgba8> photo, Selects selects) {
    ColourHistogram histogram;
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            if (photo(x, y).a != 0 && selects(x, y)) histogram.add(photo(x, y));
        }
    }
    return histogram;
}

// A round's evidence in one view.
struct ViewEvidence {
    cv::Mat1f distance;  // from the contour of the projected hull
    double voxel_px = 0;
};

ViewEvidence evidence_in(const SilhouetteView& view, const VisualHull& hull, const glm::dvec3& target) {
    return {contour_distance(project_hull(view.hull.camera, hull)), voxel_px(view.hull.camera, hull, target)};
}

float margin_px(const ViewEvidence& evidence) {
    return static_cast<float>(1.5 * evidence.voxel_px + 2);
}

// Fills holes of a mask that the hull covers: parts of the object in the background's colour.
void fill_covered_holes(cv::Mat1b& mask, const cv::Mat1f& distance) {
    constexpr double kMinCovered = 0.8;  // share of the hole
    const ConnectedComponents holes = ConnectedComponents::of_complement(mask);
    const auto covered = holes.accumulate<int>([&](int x, int y, int& count) { count += distance(y, x) > 0 ? 1 : 0; });
    holes.for_each_pixel([&](int x, int y, int label) {
        if (!holes.touches_border(label) && covered[label] >= kMinCovered * holes.area(label)) mask(y, x) = 255;
    });
}

cv::Mat1b cut_view(const SilhouetteView& view, const ViewEvidence& evidence, const ColourHistogram& object,
                   const CutRound& round) {
    const float margin = margin_px(evidence);
    ColourHistogram background =
        histogram_of(view.photo, [&](int x, int y) { return evidence.distance(y, x) < -margin; });
    background.normalize();
    Image<float> score(view.photo.width(), view.photo.height());
    for (int y = 0; y < score.height(); ++y) {
        for (int x = 0; x < score.width(); ++x) {
            const float d = evidence.distance(y, x);
            if (d < -margin || view.photo(x, y).a == 0) {
                score(x, y) = -kCertainScore;
                continue;
            }
            const float place = round.inside_score * std::clamp(d / margin, -1.0F, 1.0F);
            const float mask = view.hull.mask(y, x) != 0 ? kMaskScore : -kMaskScore;
            const float sum = colour_score(view.photo(x, y), object, background) + place + mask;
            score(x, y) = std::clamp(sum, -0.99F * kCertainScore, 0.99F * kCertainScore);
        }
    }
    const Image<std::uint8_t> cut = graph_cut_coarse_to_fine(lab_image(view.photo), score, {});
    cv::Mat1b mask = mat_view(cut.view()).clone();
    fill_covered_holes(mask, evidence.distance);
    return mask;
}

// Masks of views without one: colours in the volume that most photos have in their frame which are rare beyond it.
Status seed_masks(std::vector<SilhouetteView>& views, const glm::dvec3& target) {
    constexpr float kRareRatio = 3;  // of the densities
    std::vector<HullView> frames;
    for (const SilhouetteView& view : views) {
        const cv::Mat1b all(view.photo.height(), view.photo.width(), std::uint8_t{255});
        frames.push_back({view.hull.camera, view.hull.mask.empty() ? all : view.hull.mask});
    }
    if (std::ranges::none_of(views, [](const SilhouetteView& view) { return view.hull.mask.empty(); })) return {};
    RS_ASSIGN_OR_RETURN(const VisualHull hull, carve_visual_hull(frames, target, kUpAxis, {64, 0.05, 0.9}));
    for_each_index(std::ssize(views), 0, [&](std::int64_t index) {
        SilhouetteView& view = views[static_cast<std::size_t>(index)];
        if (!view.hull.mask.empty()) return;
        const cv::Mat1b inside = project_hull(view.hull.camera, hull);
        ColourHistogram object = histogram_of(view.photo, [&](int x, int y) { return inside(y, x) != 0; });
        ColourHistogram background = histogram_of(view.photo, [&](int x, int y) { return inside(y, x) == 0; });
        object.normalize();
        background.normalize();
        cv::Mat1b& mask = view.hull.mask;
        mask = cv::Mat1b(inside.size(), std::uint8_t{0});
        for (int y = 0; y < mask.rows; ++y) {
            for (int x = 0; x < mask.cols; ++x) {
                const Rgba8& colour = view.photo(x, y);
                const bool is_rare = object(colour) > kRareRatio * (background(colour) + kUnseenDensity);
                if (inside(y, x) != 0 && colour.a != 0 && is_rare) mask(y, x) = 255;
            }
        }
        cv::medianBlur(mask, mask, 5);
    });
    return {};
}

double overlap_of(const cv::Mat1b& mask, const cv::Mat1f& distance) {
    cv::Mat1b hull;
    cv::compare(distance, 0, hull, cv::CMP_GT);
    const int either = cv::countNonZero(mask | hull);
    return either > 0 ? static_cast<double>(cv::countNonZero(mask & hull)) / either : 0;
}

}  // namespace

ColourHistogram::ColourHistogram(int bits) : bits_(bits), density_(std::size_t{1} << (3 * bits)) {}

void ColourHistogram::add(const ColourHistogram& other, float weight) {
    std::ranges::transform(density_, other.density_, density_.begin(),
                           [&](float a, float b) { return a + weight * b; });
}

void ColourHistogram::smooth() {
    const std::size_t levels = std::size_t{1} << bits_;
    std::vector<float> before;
    for (const std::size_t stride : {std::size_t{1}, levels, levels * levels}) {
        before = density_;
        for (std::size_t i = 0; i < density_.size(); ++i) {
            const std::size_t level = i / stride % levels;
            const float below = before[level > 0 ? i - stride : i];
            const float above = before[level + 1 < levels ? i + stride : i];
            density_[i] = 0.25F * below + 0.5F * before[i] + 0.25F * above;
        }
    }
}

void ColourHistogram::normalize() {
    smooth();
    const double sum = std::accumulate(density_.begin(), density_.end(), 0.0);
    if (sum > 0) {
        for (float& density : density_) density = static_cast<float>(density / sum);
    }
}

Result<ConsistentSilhouettes> make_consistent(std::vector<SilhouetteView> views, const glm::dvec3& target,
                                              Progress* progress) {
    constexpr std::array<CutRound, 3> kCutRounds{
        {{{128, 0.6, 0.6}, 0.3F}, {{128, 0.15, 0.6}, 0.8F}, {{160, 0.06, 0.6}, 0.8F}}};
    RS_TRY(seed_masks(views, target));
    std::vector<HullView> hulls;
    for (const SilhouetteView& view : views) hulls.push_back(view.hull);
    ConsistentSilhouettes found;
    const int count = static_cast<int>(views.size());
    for (std::size_t r = 0; r < kCutRounds.size(); ++r) {
        const CutRound& round = kCutRounds[r];
        RS_ASSIGN_OR_RETURN(VisualHull hull, carve_visual_hull(hulls, target, kUpAxis, round.carving));
        hull = surface_of(std::move(hull));
        std::vector<ViewEvidence> evidence(views.size());
        std::vector<ColourHistogram> objects(views.size());
        const std::string label = "consistent masks, round " + std::to_string(r + 1);
        RS_TRY(for_each_in_parallel(count, label + ", hull", progress, [&](int index) -> Status {
            const auto i = static_cast<std::size_t>(index);
            evidence[i] = evidence_in(views[i], hull, target);
            objects[i] = histogram_of(views[i].photo, [&](int x, int y) {
                return evidence[i].distance(y, x) > 0 && hulls[i].mask(y, x) != 0;
            });
            return {};
        }));
        found.object = ColourHistogram();
        for (const ColourHistogram& object : objects) found.object.add(object);
        found.object.normalize();
        std::vector<double> overlaps(views.size());
        RS_TRY(for_each_in_parallel(count, label, progress, [&](int index) -> Status {
            const auto i = static_cast<std::size_t>(index);
            hulls[i].mask = cut_view(views[i], evidence[i], found.object, round);
            overlaps[i] = overlap_of(hulls[i].mask, evidence[i].distance);
            return {};
        }));
        found.overlap = std::accumulate(overlaps.begin(), overlaps.end(), 0.0) / count;
    }
    for (HullView& hull : hulls) found.masks.push_back(std::move(hull.mask));
    return found;
}

Image<std::uint8_t> refine_silhouette(ConstImageView<Rgba8> photo, const cv::Mat1b& mask, const ColourHistogram& object,
                                      int band_px) {
    const cv::Mat1f distance = contour_distance(mask);
    const auto band = static_cast<float>(band_px);
    ColourHistogram background = histogram_of(photo, [&](int x, int y) { return distance(y, x) < -band; });
    background.normalize();
    Image<float> score(photo.width(), photo.height());
    for (int y = 0; y < score.height(); ++y) {
        for (int x = 0; x < score.width(); ++x) {
            const float d = distance(y, x);
            const float sum = colour_score(photo(x, y), object, background) + d / band;
            score(x, y) = d > band    ? kCertainScore
                          : d < -band ? -kCertainScore
                                      : std::clamp(sum, -0.99F * kCertainScore, 0.99F * kCertainScore);
        }
    }
    return graph_cut_coarse_to_fine(lab_image(photo), score, {});
}

}  // namespace rs::capture
