#include "compositor/window/view_recorder.hpp"

#include "rayspace/base/printable.hpp"

#include <system_error>
#include <utility>

namespace rs::compositor {

std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& prefix, const char* ending,
                                int& number) {
    std::error_code failed;  // e.g. for a name that is too long; writing fails then
    for (;;) {
        std::filesystem::path path = folder / (prefix + "-" + std::to_string(++number) + ending);
        if (!std::filesystem::exists(path, failed)) return path;
    }
}

ViewRecorder::~ViewRecorder() {
    if (video_) static_cast<void>(video_->finish());
}

void ViewRecorder::set_names(const SavedNames& names) {
    if (names != names_) screenshots_ = 0;
    names_ = names;
}

Result<std::filesystem::path> ViewRecorder::next_file(const std::string& name, const char* ending, int& number) const {
    if (name.empty() || name.find('/') != std::string::npos) {
        return Error{"'" + printable(name) + "' cannot name saved files; type a name without /"};
    }
    const std::filesystem::path folder = names_.folder.empty() ? "." : names_.folder;
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (!std::filesystem::is_directory(folder, failed)) {
        return Error{printable(folder.string()) + ": is no folder and cannot be created; type another"};
    }
    const std::filesystem::path path = free_name(folder, name, ending, number);
    static_cast<void>(std::filesystem::symlink_status(path, failed));
    if (failed && failed != std::errc::no_such_file_or_directory) {
        return Error{"'" + printable(name) + "' cannot name saved files: " + failed.message() + "; type another name"};
    }
    return path;
}

std::string ViewRecorder::write_png_screenshot(const Image<Rgba8>& image) {
    const Result<std::filesystem::path> path = next_file(names_.image, ".png", screenshots_);
    if (!path) return path.error().message;
    const Status written = write_png(*path, image);
    return written ? path->string() : written.error().message;
}

std::string ViewRecorder::write_jpeg_screenshot(const Image<Rgba8>& image) {
    constexpr int kQuality = 92;
    const Result<std::filesystem::path> path = next_file(names_.image, ".jpg", screenshots_);
    if (!path) return path.error().message;
    const Status written = write_jpeg(*path, image, kQuality);
    return written ? path->string() : written.error().message;
}

Result<std::string> ViewRecorder::begin_video(int width, int height, double frames_per_second) {
    int number = 0;
    RS_ASSIGN_OR_RETURN(const std::filesystem::path path, next_file(names_.video, ".mp4", number));
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
