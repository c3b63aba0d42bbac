#include "compositor/window/view_recorder.hpp"

#include <utility>

namespace rs::compositor {

std::filesystem::path free_name(const std::filesystem::path& folder, const char* prefix, const char* ending,
                                int& number) {
    for (;;) {
        std::filesystem::path path = folder / (std::string(prefix) + "-" + std::to_string(++number) + ending);
        if (!std::filesystem::exists(path)) return path;
    }
}

ViewRecorder::~ViewRecorder() {
    if (video_) static_cast<void>(video_->finish());
}

std::string ViewRecorder::write_png_screenshot(const Image<Rgba8>& image) {
    const std::filesystem::path path = free_name(folder_, "screenshot", ".png", screenshots_);
    const Status written = write_png(path, image);
    return written ? path.string() : written.error().message;
}

std::string ViewRecorder::write_jpeg_screenshot(const Image<Rgba8>& image) {
    constexpr int kQuality = 92;
    const std::filesystem::path path = free_name(folder_, "screenshot", ".jpg", screenshots_);
    const Status written = write_jpeg(path, image, kQuality);
    return written ? path.string() : written.error().message;
}

Result<std::string> ViewRecorder::begin_video(int width, int height, double frames_per_second) {
    int number = 0;
    const std::filesystem::path path = free_name(folder_, "recording", ".mp4", number);
    RS_ASSIGN_OR_RETURN(VideoWriter video, VideoWriter::open(path, width, height, frames_per_second));
    video_.emplace(std::move(video));
    return "recording " + path.string();
}

Status ViewRecorder::add_frame(const Image<Rgba8>& image) {
    Status status = video_->add(image);
    if (!status) video_.reset();
    return status;
}

std::string ViewRecorder::end_video() {
    const Status status = video_->finish();
    video_.reset();
    return status ? "recording finished" : status.error().message;
}

}  // namespace rs::compositor
