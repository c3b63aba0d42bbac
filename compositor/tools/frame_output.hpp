#pragma once
// Writes rendered frames as an image, a video or a folder, with a progress bar.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/output/view_output.hpp"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

/// Adds --stats.
void add_stats_option(CLI::App& command, std::optional<std::string>& stats);

/// Fails if several frames would be written into one image.
Status check_frame_count(const std::string& output, OutputKind kind, std::size_t frames);

struct FrameOutput {
    std::string path;
    OutputKind kind = OutputKind::folder;
    bool force = false;             // of StagedFolder
    bool writes_cameras = true;     // into a folder, as transforms.json; not for frames that no pinhole camera has
    double frames_per_second = 30;  // of a video
};

/// Renders the cameras in order and writes them to `output`. A folder also gets the cameras
/// (transforms.json) unless `writes_cameras` is false.
Status write_frames(const FrameOutput& output, const std::vector<Camera>& cameras, const RenderView& render,
                    Progress& progress);

/// Shows the progress of several frames by frame, and that of a single traced frame by pass.
class FrameProgress {
public:
    FrameProgress(bool quiet, std::size_t frames, bool traced)
        : bar_(quiet), silent_(true), frames_(frames), by_pass_(traced && frames == 1) {}

    /// Progress for the passes of a traced frame.
    [[nodiscard]] Progress& of_passes() { return by_pass_ ? bar_ : silent_; }
    /// Progress for the frames.
    [[nodiscard]] Progress& of_frames() { return bar_; }
    void start() {
        if (!by_pass_) bar_.start("compositing", static_cast<std::int64_t>(frames_));
    }
    void finish() { bar_.finish(); }

private:
    ProgressBar bar_;
    ProgressBar silent_;
    std::size_t frames_;
    bool by_pass_;
};

}  // namespace rs::compositor
