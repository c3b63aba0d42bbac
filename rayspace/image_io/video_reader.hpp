#pragma once
// Reads video files frame by frame with FFmpeg, which is linked by the module that image_io.hpp describes.

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace rs {

namespace image_io {
class VideoDecoder;
}

struct VideoInfo {
    int width = 0;  // px, of the frames as stored, with square pixels
    int height = 0;
    // From the file's display matrix; values as ImageInfo::orientation.
    int orientation = 1;
    double frames_per_second = 0;     // average; 0 if unknown
    std::int64_t frame_estimate = 0;  // from the header; 0 if unknown
    bool is_hdr = false;              // transfer function PQ or HLG, which is not converted
};

/// Decodes a video file frame by frame, in display order: any codec of the installed FFmpeg, in MP4 and QuickTime,
/// Matroska and WebM, AVI, MPEG-TS and MPEG-PS, Ogg, FLV, ASF and MXF files. Files and
/// network addresses that the file refers to are not opened.
///
/// Frames of 8 to 16 bits, full or limited range, with a BT.601, 709 or 2020 matrix are converted to opaque 8-bit sRGB.
/// If the file states no matrix, BT.709 is assumed from 720 lines on and BT.601 below. Non-square pixels are scaled to
/// square ones. As in read_image(), the display matrix is not applied (see VideoInfo::orientation).
///
/// Memory: the decoder's reference frames (at most about 20 frames of 1.5 to 6 bytes per pixel) and two RGBA frames.
/// Not thread-safe. There is no seeking: open the file again to start over.
class VideoReader {
public:
    /// Errors: missing file, unknown container, no video stream, no decoder for the codec, a side outside
    /// 1..kMaxImageSide_px.
    static Result<VideoReader> open(const std::filesystem::path& path);
    VideoReader(VideoReader&&) noexcept;
    VideoReader& operator=(VideoReader&&) noexcept;
    ~VideoReader();

    [[nodiscard]] const VideoInfo& info() const;
    /// Decodes the next frame into `frame` (resized to width x height). Returns false at the end of the file.
    /// Frames that the decoder reports as damaged are skipped. Errors: no frame in the file, a file that ends more
    /// than a tenth (at least a second) before the duration in its header, more than a twentieth of the frames damaged
    /// (three are always tolerated), a frame size that changes.
    Result<bool> read(Image<Rgba8>& frame);
    /// Frames skipped so far.
    [[nodiscard]] int damaged_frames() const;

private:
    explicit VideoReader(std::unique_ptr<image_io::VideoDecoder> decoder);
    std::unique_ptr<image_io::VideoDecoder> decoder_;
};

}  // namespace rs
