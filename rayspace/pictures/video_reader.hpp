#pragma once
// Video files read frame by frame, through FFmpeg. The code is in the module that picture_io.hpp describes.

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace rs {

namespace pictures {
class VideoDecoder;
}

struct VideoInfo {
    int width = 0;  // px, of the frames as stored, with square pixels
    int height = 0;
    // How stored frames are to be shown, from the file's display matrix; values as PictureInfo::orientation.
    int orientation = 1;
    double frames_per_second = 0;     // average; 0 where the file does not state it
    std::int64_t frame_estimate = 0;  // from the header; 0 where unknown
    bool is_hdr = false;              // transfer curve PQ or HLG, which is not converted
};

/// Decodes a video file frame by frame, in display order: any codec of the installed FFmpeg, in MP4 and QuickTime,
/// Matroska and WebM, AVI, MPEG-TS and MPEG-PS, Ogg, FLV, ASF and MXF files. No other file and no network address that
/// the file names is opened.
///
/// Frames of 8 to 16 bits, full or limited range, BT.601, 709 or 2020 matrix become 8-bit sRGB codes, opaque; a file
/// that states no matrix has BT.709 from 720 lines on and BT.601 below. Non-square pixels are scaled to square ones.
/// The display matrix is not applied (VideoInfo::orientation has it), as in read_picture().
///
/// Memory: the decoder's reference frames (at most some 20 frames of 1.5 to 6 bytes per pixel) and two RGBA frames.
/// One thread at a time may use a reader. Reading starts at the first frame; open the file again to start over.
class VideoReader {
public:
    /// Errors: no file, no known container, no video stream, no decoder for the codec, no picture size, a side of more
    /// than kMaxPictureSide_px.
    static Result<VideoReader> open(const std::filesystem::path& path);
    VideoReader(VideoReader&&) noexcept;
    VideoReader& operator=(VideoReader&&) noexcept;
    ~VideoReader();

    [[nodiscard]] const VideoInfo& info() const;
    /// Decodes the next frame into `frame`, which becomes width x height; false at the end of the file.
    /// Frames that the decoder reports as damaged are skipped. Errors: a file without any frame, a file that ends more
    /// than a tenth (at least a second) before the duration in its header, more than a twentieth of the frames damaged
    /// (three are always tolerated), a frame size that changes.
    Result<bool> read(Image<Rgba8>& frame);
    /// Frames skipped so far.
    [[nodiscard]] int damaged_frames() const;

private:
    explicit VideoReader(std::unique_ptr<pictures::VideoDecoder> decoder);
    std::unique_ptr<pictures::VideoDecoder> decoder_;
};

}  // namespace rs
