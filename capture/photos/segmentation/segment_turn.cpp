#include "capture/photos/segmentation/segment_turn.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/reduction.hpp"
#include "capture/photos/segmentation/foreground_image.hpp"

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <utility>

namespace rs::capture {
namespace {

constexpr int kSmallSide_px = 512;
constexpr double kFullCoverage = 0.95;  // share of the image; some background must be visible

double coverage(const Image<Rgba8>& cut) {
    const auto solid =
        std::count_if(cut.pixels().begin(), cut.pixels().end(), [](const Rgba8& p) { return p.a >= 128; });
    return static_cast<double>(solid) / static_cast<double>(cut.pixels().size());
}

bool reaches_border(const Image<Rgba8>& foreground) {
    const int right = foreground.width() - 1, bottom = foreground.height() - 1;
    for (int y = 0; y <= bottom; ++y) {
        const bool is_whole_row = y == 0 || y == bottom;
        for (int x = 0; x <= right; x += is_whole_row ? 1 : std::max(1, right)) {
            if (foreground(x, y).a >= 128) return true;
        }
    }
    return false;
}

Status check_coverage(double covered, const std::string& photo, const Segmenter& segmenter, bool may_be_full) {
    const std::string remedy = ": give another --segmenter or --backdrop, masks by --masks, or take the photo out";
    if (covered == 0) return Error{photo + ": shows no object (segmenter: " + segmenter.name() + ")" + remedy};
    if (covered >= kFullCoverage && !may_be_full) {
        return Error{photo + ": the object covers the whole image (segmenter: " + segmenter.name() + ")" + remedy};
    }
    return {};
}

}  // namespace

std::string set_image_name(std::size_t view) {
    char name[32];
    std::snprintf(name, sizeof name, "images/%04zu.png", view);
    return name;
}

Result<SegmentedTurn> segment_turn(const PhotoFolder& folder, const Segmenter& segmenter,
                                   const ForegroundCache& foregrounds, Progress* progress,
                                   const ForegroundParameters& parameters) {
    SegmentedTurn turn{TurnSilhouette(folder.width, folder.height),
                       std::vector<TurnSilhouette::Box>(folder.photos.size()),
                       std::vector<double>(folder.photos.size()), std::vector<std::uint8_t>(folder.photos.size()),
                       std::vector<Image<Rgba8>>(folder.photos.size())};
    std::mutex mutex;
    const auto segment_photo = [&](std::size_t i) -> Status {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(folder, i));
        RS_ASSIGN_OR_RETURN(const Segmentation segmentation, segmenter.segment({i, photo.view()}));
        const Image<Rgba8> foreground = make_foreground_image(photo, segmentation, parameters);
        turn.coverage[i] = coverage(foreground);
        turn.at_border[i] = reaches_border(foreground) ? 1 : 0;
        if (Status status =
                check_coverage(turn.coverage[i], folder.photos[i].string(), segmenter, segmentation.is_alpha);
            !status) {
            return status;
        }
        RS_TRY(foregrounds.put(i, foreground));
        turn.small[i] = reduced(foreground, kSmallSide_px);
        TurnSilhouette silhouette(folder.width, folder.height);
        silhouette.add(foreground);
        turn.boxes[i] = silhouette.visible();
        const std::lock_guard lock(mutex);
        turn.silhouette.merge(silhouette);
        return {};
    };
    RS_TRY(for_each_photo(folder, kSegmentBytesPerPixel, "segmenting", progress, segment_photo));
    return turn;
}

}  // namespace rs::capture
