#pragma once
// Writes what a window shows: screenshots, and videos of consecutive frames.

#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace rs::compositor {

/// The first free name of PREFIX-N.ENDING in a folder, with N above `number`, which is set to N.
std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& prefix, const char* ending,
                                int& number);

/// Saved files are FOLDER/IMAGE-N.png or .jpg and FOLDER/VIDEO-N.mp4.
struct SavedNames {
    std::string folder = ".";  // created if missing
    std::string image = "screenshot";
    std::string video = "recording";
    bool operator==(const SavedNames&) const = default;
};

// One thread. Functions return a message for the user, because a failure does not end the visit.
class ViewRecorder {
public:
    explicit ViewRecorder(SavedNames names) : names_(std::move(names)) {}
    ViewRecorder(const ViewRecorder&) = delete;
    ViewRecorder& operator=(const ViewRecorder&) = delete;
    ~ViewRecorder();  // finishes a video

    /// Names of the files that are begun afterwards.
    void set_names(const SavedNames& names);

    /// Writes IMAGE-N.png.
    std::string write_png_screenshot(const Image<Rgba8>& image);
    /// Writes IMAGE-N.jpg.
    std::string write_jpeg_screenshot(const Image<Rgba8>& image);

    [[nodiscard]] bool is_recording() const { return video_.has_value(); }
    /// Begins VIDEO-N.mp4. Fails if the video cannot be created.
    Result<std::string> begin_video(int width, int height, double frames_per_second);
    /// Adds a frame. Fails if it cannot be written; the video is closed then.
    Status add_frame(const Image<Rgba8>& image);
    std::string end_video();

private:
    [[nodiscard]] Result<std::filesystem::path> next_file(const std::string& name, const char* ending,
                                                          int& number) const;

    SavedNames names_;
    std::optional<VideoWriter> video_;
    int screenshots_ = 0;
};

}  // namespace rs::compositor
