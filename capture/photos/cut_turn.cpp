#include "capture/photos/cut_turn.hpp"

#include "capture/photos/bounded_work.hpp"
#include "capture/photos/cut_out.hpp"
#include "capture/photos/survey.hpp"
#include "rayspace/picture_io.hpp"

#include <algorithm>
#include <cstdio>
#include <mutex>

namespace rs::capture {
namespace {

constexpr int kTurningSide_px = 512;

// Of the picture. Somewhere around the object the backdrop must be seen; where it is not, it was mistaken.
constexpr double kFullCoverage = 0.95;

double coverage(const Image<Rgba8>& cut) {
    const auto solid =
        std::count_if(cut.pixels().begin(), cut.pixels().end(), [](const Rgba8& p) { return p.a >= 128; });
    return static_cast<double>(solid) / static_cast<double>(cut.pixels().size());
}

Status check_coverage(double covered, BackdropKind kind, const std::string& photo) {
    if (covered == 0) {
        return Error{photo + ": shows no object before the " + to_string(kind) +
                     " backdrop; give another --backdrop, or take the picture out"};
    }
    if (covered >= kFullCoverage && kind != BackdropKind::kAlpha) {
        return Error{photo + ": the object fills the whole picture; nothing is left of the " + to_string(kind) +
                     " backdrop: give another --backdrop, or take the picture out"};
    }
    return {};
}

bool reaches_border(const TurnOutline::Box& box, const PhotoFolder& folder) {
    return box.left == 0 || box.top == 0 || box.right == folder.width || box.bottom == folder.height;
}

}  // namespace

std::string cut_picture_name(std::size_t view) {
    char name[32];
    std::snprintf(name, sizeof name, "images/%04zu.png", view);
    return name;
}

Result<CutTurn> cut_turn(const PhotoFolder& folder, const Backdrop& backdrop, const std::filesystem::path& output,
                         Progress* progress) {
    const ObjectCutter cutter(backdrop, folder.width, folder.height);
    CutTurn turn{TurnOutline(folder.width, folder.height), std::vector<Image<Rgba8>>(folder.photos.size())};
    std::mutex mutex;
    const auto cut_photo = [&](std::size_t i) -> Status {
        const std::string name = folder.photos[i].string();
        const Result<Image<Rgba8>> photo = read_picture(folder.photos[i]);
        if (!photo) return photo.error();
        if (photo->width() != folder.width || photo->height() != folder.height) {
            return Error{name + ": changed while it was imported; import again"};
        }
        const Image<Rgba8> cut = cutter.cut(*photo);
        const double covered = coverage(cut);
        if (Status status = check_coverage(covered, backdrop.kind, name); !status) return status;
        if (Status status = write_png(output / cut_picture_name(i), cut); !status) return status;
        turn.small[i] = reduced(cut, kTurningSide_px);
        TurnOutline outline(folder.width, folder.height);
        outline.add(cut);
        const std::lock_guard lock(mutex);
        turn.outline.merge(outline);
        turn.min_coverage = std::min(turn.min_coverage, covered);
        turn.max_coverage = std::max(turn.max_coverage, covered);
        turn.at_border += reaches_border(outline.visible(), folder) ? 1 : 0;
        return {};
    };
    if (Status status = for_each_photo(folder, kCutBytesPerPixel, "cutting the object out", progress, cut_photo);
        !status) {
        return status.error();
    }
    return turn;
}

}  // namespace rs::capture
