#include "capture/photos/rig/photo_calibration.hpp"

#include "capture/calibration/silhouettes/silhouettes.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/intake/bounded_work.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

constexpr int kSilhouetteSide_px = 640;

Result<BoardCalibration> from_board(const PhotoFolder& folder, const CalibrationRequest& request,
                                    const std::vector<std::string>& names, Progress* progress) {
    const auto load = [&](int i) { return read_photo(folder, static_cast<std::size_t>(i)); };
    RS_ASSIGN_OR_RETURN(const std::vector<BoardCorners> views,
                        detect_boards(static_cast<int>(folder.photos.size()), load, *request.board, progress));
    return calibrate_with_board(views, *request.board, folder.width, folder.height, request.known, names);
}

// Silhouettes with a longer side of at most kSilhouetteSide_px.
struct Silhouettes {
    std::vector<Image<std::uint8_t>> masks;
    int reduction = 1;  // of the photos' sides; a remainder at the right and at the bottom is cropped
};

Silhouettes silhouettes(const TurnImages& turn) {
    const Image<std::uint8_t>& first = turn.images.front().alpha;
    const int longer = std::max(first.width(), first.height());
    const int factor = (longer + kSilhouetteSide_px - 1) / kSilhouetteSide_px;
    Silhouettes result{{}, turn.reduction * factor};
    for (const CalibrationImage& image : turn.images) {
        Image<std::uint8_t> mask(std::max(1, first.width() / factor), std::max(1, first.height() / factor));
        for (int y = 0; y < mask.height(); ++y) {
            for (int x = 0; x < mask.width(); ++x) {
                int sum = 0, count = 0;
                for (int dy = 0; dy < factor && y * factor + dy < first.height(); ++dy) {
                    for (int dx = 0; dx < factor && x * factor + dx < first.width(); ++dx, ++count) {
                        sum += image.alpha(x * factor + dx, y * factor + dy);
                    }
                }
                mask(x, y) = static_cast<std::uint8_t>(sum / count);
            }
        }
        result.masks.push_back(std::move(mask));
    }
    return result;
}

// Number of steps of the turntable before each view. There is no step before a view that has the silhouette of the
// previous view: a photo that was taken or copied twice.
std::vector<int> steps_before(const std::vector<Image<std::uint8_t>>& masks) {
    constexpr double kRepeatRatio = 0.2;  // of the change of the silhouettes before and after
    std::vector<double> change;           // [view], to the next view
    for (std::size_t i = 0; i + 1 < masks.size(); ++i) {
        change.push_back(cv::norm(mat_view(masks[i]), mat_view(masks[i + 1]), cv::NORM_L1));
    }
    std::vector<int> steps(masks.size());
    std::iota(steps.begin(), steps.end(), 0);
    if (masks.size() < 4) return steps;
    for (std::size_t i = 1; i < masks.size(); ++i) {
        const double before = i >= 2 ? change[i - 2] : change[i];
        const double behind = i < change.size() ? change[i] : before;
        const bool repeats = change[i - 1] < kRepeatRatio * std::min(before, behind);
        steps[i] = steps[i - 1] + (repeats ? 0 : 1);
    }
    return steps;
}

// Calibrates with silhouettes. An unknown direction of rotation is guessed first. The silhouettes refute the guess if
// they fit only the other sense, or fit the guess only with a camera that looks up from below the turntable.
Result<Calibration> from_silhouettes(const TurnImages& turn, const CalibrationRequest& request) {
    const Silhouettes reduced = silhouettes(turn);
    // Size of the part of the photos that the silhouettes cover: its sides must be integer multiples of theirs.
    TurntableModel start = request.nominal();
    start.lens.width = reduced.reduction * reduced.masks.front().width();
    start.lens.height = reduced.reduction * reduced.masks.front().height();
    const KnownInputs& known = request.known;
    if (const std::vector<int> steps = steps_before(reduced.masks); steps.back() + 1 < static_cast<int>(steps.size())) {
        const double whole_rad = start.angles_rad[1] * static_cast<double>(steps.size());
        for (std::size_t i = 0; i < steps.size(); ++i) start.angles_rad[i] = whole_rad * steps[i] / (steps.back() + 1);
    }
    // The last photo of a turn may be missing, so the step that closes the turn is a guess.
    Result<Calibration> found = calibrate_with_silhouettes(reduced.masks, start, known);
    const bool is_guessed = !known.counter_clockwise && !known.step_rad && !known.angles_rad;
    if (is_guessed && (!found || is_seen_from_below(*found))) {
        for (double& angle : start.angles_rad) angle = -angle;
        constexpr double kAsGood = 1.5;
        Result<Calibration> other = calibrate_with_silhouettes(reduced.masks, start, known);
        if (other && (!found || (!is_seen_from_below(*other) && other->rms_px < kAsGood * found->rms_px))) {
            found = std::move(other);
            found->warnings.emplace_back(
                "the images seem to turn the other way, but the silhouettes fit this direction better");
        }
    }
    if (!found) return found;
    found->model.lens.width = turn.width;
    found->model.lens.height = turn.height;
    return found;
}

// Calibration from known values alone, nullopt if one is missing. Nothing is estimated, so all deviations are 0.
std::optional<Calibration> calibration_from_known(const CalibrationRequest& request, std::size_t views) {
    const KnownInputs& known = request.known;
    if (!known.f_px || !known.pose || !(known.angles_rad || known.step_rad)) return std::nullopt;
    Calibration calibration;
    calibration.method = CalibrationMethod::kGiven;
    calibration.model = apply_known(request.nominal(), known);
    calibration.step_rad = median_step(calibration.model.angles_rad);
    calibration.views.resize(views);
    ModelDeviations& held = calibration.deviations;
    held.f_px = held.cx = held.cy = held.k1 = held.k2 = held.axis_direction_rad = held.tilt_rad = held.roll_rad =
        held.axis_position_px = 0;
    held.angles_rad.assign(views, 0);
    return calibration;
}

}  // namespace

// Reads the foreground images, not the photos, so that no point of the background is tracked.
Result<TurnImages> read_turn_images(const PhotoFolder& folder, const ForegroundCache& foregrounds, Progress* progress) {
    TurnImages turn;
    turn.width = folder.width;
    turn.height = folder.height;
    const int longer = std::max(folder.width, folder.height);
    turn.reduction = (longer + kCalibrationSide_px - 1) / kCalibrationSide_px;
    turn.images.resize(folder.photos.size());
    for (const fs::path& photo : folder.photos) turn.names.push_back(photo.filename().string());
    const auto read = [&](std::size_t i) -> Status {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> cut, foregrounds.get(i));
        turn.images[i] = calibration_image(cut, turn.reduction);
        return {};
    };
    RS_TRY(for_each_photo(folder, kReadBytesPerPixel, "reading the foreground images", progress, read));
    return turn;
}

Result<PhotoCalibration> calibrate_photos(const PhotoFolder& folder, const ForegroundCache& foregrounds,
                                          const CalibrationRequest& request, Progress* progress) {
    PhotoCalibration result;
    const CalibrationChoice choice = request.choice;
    if (choice == CalibrationChoice::kNominal) return result;
    const std::size_t views = folder.photos.size();
    if (request.known.angles_rad && request.known.angles_rad->size() != views) {
        return Error{"the given rig has " + std::to_string(request.known.angles_rad->size()) + " views, the folder " +
                     std::to_string(views) + " photos; give a rig of these photos"};
    }
    RS_ASSIGN_OR_RETURN(TurnImages turn, read_turn_images(folder, foregrounds, progress));
    if (choice == CalibrationChoice::kBoard && !request.board) {
        return Error{
            "--calibration board: the board is not described; give --board default for "
            "the default of rs-capture board"};
    }
    if (request.board && (choice == CalibrationChoice::kAuto || choice == CalibrationChoice::kBoard)) {
        Result<BoardCalibration> board = from_board(folder, request, turn.names, progress);
        if (board) {
            result.calibration = board->calibration;
            result.board = std::move(*board);
            return result;
        }
        if (choice == CalibrationChoice::kBoard) return board.error();
        result.notes.push_back("no calibration from the board: " + board.error().message);
    }
    if (choice == CalibrationChoice::kAuto) {
        if (auto calibration = calibration_from_known(request, views)) {
            result.calibration = std::move(*calibration);
            return result;
        }
    }
    if (choice == CalibrationChoice::kAuto || choice == CalibrationChoice::kTracks) {
        Result<TrackCalibration> tracks = calibrate_with_tracks(turn, request.known, progress);
        if (tracks) {
            result.calibration = tracks->calibration;
            result.tracks = std::move(*tracks);
            return result;
        }
        if (choice == CalibrationChoice::kTracks) return tracks.error();
        result.notes.push_back("no calibration from points: " + tracks.error().message);
    }
    if (choice == CalibrationChoice::kAuto || choice == CalibrationChoice::kSilhouettes) {
        if (progress != nullptr) progress->start("fitting the silhouettes", 1);
        Result<Calibration> found = from_silhouettes(turn, request);
        if (progress != nullptr) progress->advance();
        if (found) {
            result.calibration = std::move(*found);
            return result;
        }
        if (choice == CalibrationChoice::kSilhouettes) return found.error();
        result.notes.push_back("no calibration from silhouettes: " + found.error().message);
    }
    return result;
}

}  // namespace rs::capture
