#include "capture/photos/intake/video/video_frames.hpp"

#include "capture/photos/intake/exposure.hpp"
#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/intake/reduction.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/video_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

// Mean of downscaled frames in linear light.
class MeanFrame {
public:
    void add(ConstImageView<Rgba8> frame) {
        const Image<Rgba8> small = reduced(frame, kCopySide_px);
        if (mean_.empty()) mean_ = Image<LinearRgb>(small.width(), small.height());
        ++count_;
        const float weight = 1 / static_cast<float>(count_);
        for (std::size_t i = 0; i < mean_.pixels().size(); ++i) {
            const LinearRgb light = linear_rgb(small.pixels()[i]);
            LinearRgb& mean = mean_.pixels()[i];
            mean.r += weight * (light.r - mean.r);
            mean.g += weight * (light.g - mean.g);
            mean.b += weight * (light.b - mean.b);
        }
    }
    [[nodiscard]] const Image<LinearRgb>& image() const { return mean_; }

private:
    Image<LinearRgb> mean_;
    int count_ = 0;
};

struct VideoCopies {
    std::vector<FrameCopy> copies;
    Image<LinearRgb> mean;
    VideoInfo info;
    int damaged = 0;
};

Result<VideoCopies> copy_frames(const fs::path& video, Progress* progress) {
    RS_ASSIGN_OR_RETURN(VideoReader reader, VideoReader::open(video));
    VideoCopies result;
    result.info = reader.info();
    constexpr std::int64_t kUnknownLength = 300;
    const std::int64_t estimate = result.info.frame_estimate;
    if (progress != nullptr) progress->start("reading the video", estimate > 0 ? estimate : kUnknownLength);
    MeanFrame mean;
    Image<Rgba8> frame;
    for (;;) {
        RS_ASSIGN_OR_RETURN(const bool has_frame, reader.read(frame));
        if (!has_frame) break;
        if (result.copies.size() == static_cast<std::size_t>(kMaxVideoFrames)) {
            return Error{video.string() + ": has more than " + std::to_string(kMaxVideoFrames) +
                         " frames; cut it to one or two turns, e.g. with ffmpeg -ss START -t SECONDS"};
        }
        constexpr std::size_t kMeanStride = 8;
        if (result.copies.size() % kMeanStride == 0) mean.add(frame);
        result.copies.push_back(make_frame_copy(frame));
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
    result.mean = mean.image();
    result.damaged = reader.damaged_frames();
    return result;
}

// Matches the exposure of a frame to the mean of the video, estimated on static pixels.
class ExposureNormalizer {
public:
    ExposureNormalizer(const Image<LinearRgb>& mean, const Image<std::uint8_t>& moving)
        : mean_(mean), static_mask_(moving.width(), moving.height()) {
        std::size_t static_count = 0;
        for (std::size_t i = 0; i < moving.pixels().size(); ++i) {
            static_mask_.pixels()[i] = moving.pixels()[i] == 0 ? 255 : 0;
            static_count += moving.pixels()[i] == 0 ? 1U : 0U;
        }
        constexpr std::size_t kMinFraction = 20;  // one in 20 pixels
        is_possible_ = static_count * kMinFraction >= moving.pixels().size();
    }

    void apply(Image<Rgba8>& frame) {
        if (!is_possible_) return;
        constexpr float kNegligible = 0.01F;
        const LinearRgb gain = exposure_gain(reduced(frame, kCopySide_px), mean_, static_mask_);
        const float change = std::max({std::abs(gain.r - 1), std::abs(gain.g - 1), std::abs(gain.b - 1)});
        largest_change_ = std::max(largest_change_, change);
        if (change < kNegligible) return;
        const auto red = exposure_division_table(gain.r);
        const auto green = exposure_division_table(gain.g);
        const auto blue = exposure_division_table(gain.b);
        for (Rgba8& p : frame.pixels()) p = {red[p.r], green[p.g], blue[p.b], p.a};
    }
    [[nodiscard]] float largest_change() const { return largest_change_; }

private:
    const Image<LinearRgb>& mean_;
    Image<std::uint8_t> static_mask_;
    float largest_change_ = 0;
    bool is_possible_ = false;
};

std::string frame_name(std::size_t frame) {
    char name[32];
    std::snprintf(name, sizeof name, "frame-%05zu.png", frame + 1);
    return name;
}

Status write_selected(const fs::path& video, const fs::path& folder, const std::vector<std::size_t>& selected,
                      ExposureNormalizer& normalizer, Progress* progress) {
    RS_ASSIGN_OR_RETURN(VideoReader reader, VideoReader::open(video));
    if (progress != nullptr) progress->start("extracting frames", static_cast<std::int64_t>(selected.size()));
    Image<Rgba8> frame;
    std::size_t next = 0;
    for (std::size_t i = 0; next < selected.size(); ++i) {
        RS_ASSIGN_OR_RETURN(const bool has_frame, reader.read(frame));
        if (!has_frame) return Error{video.string() + ": changed while it was imported; import again"};
        if (i != selected[next]) continue;
        normalizer.apply(frame);
        const Image<Rgba8> upright = apply_orientation(std::move(frame), reader.info().orientation);
        RS_TRY(write_png(folder / frame_name(i), upright));
        frame = {};
        ++next;
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
    return {};
}

std::vector<std::string> make_notes(const std::string& name, const VideoCopies& video, float largest_change) {
    std::vector<std::string> notes;
    if (video.damaged > 0) {
        notes.push_back(name + ": " + std::to_string(video.damaged) + " damaged frames were skipped");
    }
    if (video.info.is_hdr) {
        notes.push_back(name + " is HDR, whose colours are not converted; record in SDR for true colours");
    }
    constexpr float kMinReportedChange = 0.02F;
    if (largest_change > kMinReportedChange) {
        notes.push_back(name + ": the exposure of frames was corrected by up to " +
                        std::to_string(std::lround(100 * largest_change)) + " %; lock it when recording");
    }
    return notes;
}

}  // namespace

Result<VideoFrames> write_video_frames(const fs::path& video, const fs::path& folder, const FrameRequest& request,
                                       Progress* progress) {
    Result<VideoCopies> copies = copy_frames(video, progress);
    if (!copies) return copies.error();
    const std::size_t frame_count = copies->copies.size();
    VideoFrames result;
    result.selection = select_frames(copies->copies, request, progress);
    copies->copies.clear();
    if (std::ranges::count(result.selection.moving.pixels(), 0) == std::ssize(result.selection.moving.pixels())) {
        return Error{video.string() + ": nothing moves in it; give a video of an object that turns"};
    }
    ExposureNormalizer normalizer(copies->mean, result.selection.moving);
    RS_TRY(write_selected(video, folder, result.selection.frames, normalizer, progress));
    const std::string name = video.filename().string();
    result.notes = make_notes(name, *copies, normalizer.largest_change());
    result.notes.insert(result.notes.begin(), selection_note(name, "frames", frame_count, result.selection));
    return result;
}

}  // namespace rs::capture
