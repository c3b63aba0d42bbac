// The video half of librayspace_pictures.so: OpenCV's FFMPEG writer. See picture_io.hpp for what it promises.
#include "rayspace/pictures/picture_backend.hpp"

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <system_error>

namespace rs::pictures {
namespace {

// OpenCV does not say why a file could not be written.
bool disk_is_full(const std::string& path) {
    constexpr std::uintmax_t kNextToNothing_bytes = 1024 * 1024;
    std::error_code failure;
    const auto space = std::filesystem::space(std::filesystem::absolute(path).parent_path(), failure);
    return !failure && space.available < kNextToNothing_bytes;
}

constexpr const char* kFull = ": no space left on device; free some space or write elsewhere";

class OpenCvEncoder final : public VideoEncoder {
public:
    OpenCvEncoder(const cv::VideoWriter& writer, std::string path, std::string shown, const VideoOptions& options)
        : writer_(writer),
          path_(std::move(path)),
          shown_(std::move(shown)),
          options_(options),
          bgr_(options.height, options.width, CV_8UC3) {}

    Status add(ConstImageView<Rgba8> frame) override {
        for (int y = 0; y < frame.height(); ++y) {
            cv::Vec3b* const row = bgr_.ptr<cv::Vec3b>(y);
            for (int x = 0; x < frame.width(); ++x) {
                const Rgba8 p = over(frame(x, y), options_.backdrop);
                row[x] = {p.b, p.g, p.r};
            }
        }
        try {
            writer_.write(bgr_);
        } catch (const std::exception& escaped) {
            return Error{shown_ + ": the video encoder failed: " + escaped.what()};
        }
        ++frames_;
        return {};
    }

    Status finish() override {
        try {
            writer_.release();
            if (frames_ == 0) return Error{shown_ + ": a video needs at least one frame"};
            // The encoder does not report a full disk; a file that reads back whole was written whole.
            cv::VideoCapture check(path_, cv::CAP_FFMPEG);
            const bool whole = check.isOpened() && std::llround(check.get(cv::CAP_PROP_FRAME_COUNT)) == frames_;
            if (whole) return {};
            return Error{shown_ + (disk_is_full(path_)
                                       ? kFull
                                       : ": the video could not be written completely; is the disk full?")};
        } catch (const std::exception& escaped) {
            return Error{shown_ + ": the video encoder failed: " + escaped.what()};
        }
    }

private:
    cv::VideoWriter writer_;
    std::string path_;
    std::string shown_;
    VideoOptions options_;
    cv::Mat bgr_;
    long long frames_ = 0;
};

}  // namespace

Result<std::unique_ptr<VideoEncoder>> open_video(const std::string& path, const std::string& shown,
                                                 const VideoOptions& options) {
    try {
        // Errors are told once, by us: OpenCV and FFmpeg shall not write to stderr on their own.
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
        // H.264 plays everywhere; where FFmpeg was built without an encoder for it, MPEG-4 still does.
        for (const int codec :
             {cv::VideoWriter::fourcc('a', 'v', 'c', '1'), cv::VideoWriter::fourcc('m', 'p', '4', 'v')}) {
            cv::VideoWriter writer(path, cv::CAP_FFMPEG, codec, options.frames_per_second,
                                   cv::Size(options.width, options.height));
            if (!writer.isOpened()) continue;
            return std::unique_ptr<VideoEncoder>(new OpenCvEncoder(writer, path, shown, options));
        }
    } catch (const std::exception& escaped) {
        return Error{shown + ": the video cannot be opened: " + escaped.what()};
    }
    if (disk_is_full(path)) return Error{shown + kFull};
    return Error{shown +
                 ": the video cannot be opened; use the extension .mp4 and an OpenCV that was built with FFmpeg"};
}

}  // namespace rs::pictures
