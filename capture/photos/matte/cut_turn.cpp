#include "capture/photos/matte/cut_turn.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/photograph.hpp"
#include "capture/photos/intake/reduction.hpp"
#include "capture/photos/matte/cut_out.hpp"
#include "capture/photos/matte/still_at_border.hpp"
#include "rayspace/pictures/photograph_size.hpp"
#include "rayspace/pictures/picture_io.hpp"

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <utility>

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
                     " backdrop; give another --backdrop, or take the picture out (what is the same in all pictures "
                     "counts as backdrop: did the object turn?)"};
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

// The mask of a photograph; its grey becomes the photograph's alpha.
Status apply_mask(const std::filesystem::path& masks, const PhotoFolder& folder, std::size_t i, Image<Rgba8>& picture) {
    const std::filesystem::path& photo = folder.photos[i];
    std::filesystem::path found = masks / photo.filename();
    std::error_code failure;
    for (const char* ending : {"", ".png", ".PNG", ".jpg", ".JPG", ".jpeg", ".tif", ".tiff", ".webp", ".bmp"}) {
        if (*ending != 0) found = masks / (photo.stem().string() + ending);
        if (std::filesystem::exists(found, failure)) break;
    }
    if (!std::filesystem::exists(found, failure)) {
        return Error{masks.string() + ": has no mask for " + photo.filename().string() +
                     "; one picture per photograph is needed, of its name, white where the object is"};
    }
    Result<Image<Rgba8>> mask = read_picture(found, kMaxPhotographSide_px);
    if (!mask) return mask.error();
    if (mask->width() != folder.shown_width || mask->height() != folder.shown_height) {
        return Error{found.string() + ": is " + size_text(mask->width(), mask->height()) + ", the photograph " +
                     size_text(folder.shown_width, folder.shown_height) + "; masks have the photographs' size"};
    }
    for (Rgba8& m : mask->pixels()) {  // white on transparent is a mask too
        m = {0, 0, 0, static_cast<std::uint8_t>((std::max({m.r, m.g, m.b}) * m.a + 127) / 255)};
    }
    const Image<Rgba8> alpha = in_working_size(std::move(*mask), folder);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) picture(x, y).a = alpha(x, y).a;
    }
    return {};
}

}  // namespace

std::string cut_picture_name(std::size_t view) {
    char name[32];
    std::snprintf(name, sizeof name, "images/%04zu.png", view);
    return name;
}

Result<CutTurn> cut_turn(const PhotoFolder& folder, const CutSource& source, const CutPictures& cuts,
                         Progress* progress) {
    // A mask is an alpha that is given.
    const Backdrop& backdrop = source.backdrop;
    const BackdropKind kind = source.masks.empty() ? backdrop.kind : BackdropKind::kAlpha;
    const ObjectCutter cutter(source.masks.empty() ? backdrop : Backdrop{}, folder.width, folder.height);
    CutTurn turn{TurnOutline(folder.width, folder.height), std::vector<TurnOutline::Box>(folder.photos.size()),
                 std::vector<Image<Rgba8>>(folder.photos.size())};
    std::mutex mutex;
    int at_border = 0;  // views whose object reaches the picture's border
    const auto cut_photo = [&](std::size_t i) -> Status {
        const std::string name = folder.photos[i].string();
        Result<Image<Rgba8>> photo = read_photograph(folder, i);
        if (!photo) return photo.error();
        if (!source.masks.empty()) {
            if (Status status = apply_mask(source.masks, folder, i, *photo); !status) return status;
        }
        const Image<Rgba8> cut = cutter.cut(*photo);
        const double covered = coverage(cut);
        if (Status status = check_coverage(covered, kind, name); !status) return status;
        if (Status status = cuts.put(i, cut); !status) return status;
        turn.small[i] = reduced(cut, kTurningSide_px);
        TurnOutline outline(folder.width, folder.height);
        outline.add(cut);
        turn.boxes[i] = outline.visible();
        const std::lock_guard lock(mutex);
        turn.outline.merge(outline);
        turn.min_coverage = std::min(turn.min_coverage, covered);
        turn.max_coverage = std::max(turn.max_coverage, covered);
        at_border += reaches_border(outline.visible(), folder) ? 1 : 0;
        return {};
    };
    if (Status status = for_each_photo(folder, kCutBytesPerPixel, "cutting the object out", progress, cut_photo);
        !status) {
        return status.error();
    }
    if (at_border > 0) {
        turn.notes.push_back("the object reaches the picture's border in " + std::to_string(at_border) + " of " +
                             std::to_string(folder.photos.size()) + " pictures; it will look cut off there");
        if (is_still_at_border(turn.small)) {
            turn.notes.emplace_back(
                "most of what reaches the border never changes; if that is the room, photograph the object before a "
                "plain backdrop, farther from the border, or give --masks");
        }
    }
    return turn;
}

}  // namespace rs::capture
