#pragma once
// Images and video on disk, through OpenImageIO and FFmpeg.
//
// Those libraries take a quarter of a second to load, so their code lives in a module (librayspace_image_io.so, beside
// the tools) that is opened at the first call of a function of this header; a tool that only prints its help never
// pays.
//
// Every reader checks the header's size against kMaxImageSide_px, or another limit that it is given, before it
// allocates. Every writer writes to a
// temporary name beside `path` and renames; on failure nothing is left. All functions may be called from any thread.
// Errors name the file and what to do.

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rs {

struct ImageInfo {
    int width = 0;
    int height = 0;
    int channels = 0;
    bool has_alpha = false;
    // EXIF: how the stored pixels are to be shown. 1 as they are, 3 upside down, 6 and 8 on their side, 2, 4, 5 and 7
    // mirrored too. 1 where the file states nothing, or nothing valid.
    int orientation = 1;
    // EXIF: mm of the lens that shows as much on film, 43.27 mm across the image's diagonal. 0 where nothing is
    // stated.
    int focal_35mm = 0;
};

// Only the header is read.
Result<ImageInfo> read_image_info(const std::filesystem::path& path, int max_side_px = kMaxImageSide_px);

// Any image format that OpenImageIO reads, but icons, Photoshop's and JPEG 2000 files, as 8-bit sRGB with straight
// alpha (255 where the file has none). Colours of an RGB profile (ICC) become sRGB, but of float files (a HEIC file's
// profile is not read by OpenImageIO 2.4); a file with a damaged profile is an error. Grey is spread to RGB; 16-bit and
// float files are converted (float as linear light). Associated alpha is undone. EXIF orientation is not applied
// (ImageInfo has it): pixels stay where the camera model has them. A damaged or truncated file is an error.
Result<Image<Rgba8>> read_image(const std::filesystem::path& path, int max_side_px = kMaxImageSide_px);

// Linear-light float RGBA, alpha straight: EXR and HDR as they are, 8- and 16-bit files through the sRGB curve.
Result<Image<RgbaF>> read_image_linear(const std::filesystem::path& path);

// An image of light itself, such as an environment: the same, opaque, every value finite and not negative. What is not
// finite is an error; below 0 (panorama tools that sharpened) it becomes 0.
Result<Image<RgbaF>> read_radiance(const std::filesystem::path& path);

// One-channel float image, such as a depth channel written by write_exr_channel; the channel "Z" or else the first.
Result<Image<float>> read_channel(const std::filesystem::path& path);

// PNG, 8 bit, straight alpha.
Status write_png(const std::filesystem::path& path, ConstImageView<Rgba8> image);

// JPEG as cameras write it: 8-bit sRGB, alpha left out, colour differences at half the resolution. `quality` 1..100.
Status write_jpeg(const std::filesystem::path& path, ConstImageView<Rgba8> image, int quality);

// The bytes that write_png would write, for images inside of other files; `shown` names the image in errors.
Result<std::vector<std::byte>> encode_png(ConstImageView<Rgba8> image, const std::string& shown);

// OpenEXR, float, zip; linear light. The EXR convention is associated alpha: colours are multiplied on writing and
// divided on reading.
Status write_exr(const std::filesystem::path& path, ConstImageView<RgbaF> image);

// One float channel named "Z".
Status write_exr_channel(const std::filesystem::path& path, ConstImageView<float> channel);

// A video file (mp4: H.264) written frame by frame. Alpha is composited over `backdrop`. Frames must have the size
// given at opening, which must be even. finish() renames the temporary file; a writer that is dropped before it leaves
// nothing.
class VideoWriter {
public:
    static Result<VideoWriter> open(const std::filesystem::path& path, int width, int height, double frames_per_second,
                                    Rgba8 backdrop = {40, 42, 46, 255});
    VideoWriter(VideoWriter&&) noexcept;
    VideoWriter& operator=(VideoWriter&&) noexcept;
    ~VideoWriter();

    Status add(ConstImageView<Rgba8> frame);
    Status finish();

    struct Backend;  // in the module

private:
    explicit VideoWriter(std::unique_ptr<Backend> backend);
    std::unique_ptr<Backend> backend_;
};

}  // namespace rs
