#pragma once
// Image and video files, with OpenImageIO and FFmpeg.
//
// Those libraries take a quarter of a second to load. Their code is therefore in a module (librayspace_image_io.so,
// beside the tools) that is loaded at the first call of a function of this header.
//
// Every reader checks the header's size against kMaxImageSide_px, or a given limit, before it allocates. Every writer
// writes to a temporary name beside `path` and renames; a failure leaves no file. All functions are thread-safe. Errors
// name the file and a remedy.

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
    // EXIF orientation of the stored pixels: 1 as stored, 3 upside down, 6 and 8 rotated by 90 degrees, 2, 4, 5 and 7
    // mirrored too. 1 if missing or invalid.
    int orientation = 1;
    // EXIF focal length equivalent to 35 mm film (43.27 mm diagonal), mm. 0 if missing.
    int focal_35mm = 0;
};

/// Reads the header only.
Result<ImageInfo> read_image_info(const std::filesystem::path& path, int max_side_px = kMaxImageSide_px);

/// Reads an image as 8-bit sRGB with straight alpha (255 if the file has none), in any format that OpenImageIO reads,
/// except icons, Photoshop and JPEG 2000. Colours are converted from RGB profiles (ICC) to sRGB, except in float files
/// (the profile of HEIC files is not read by OpenImageIO 2.4); a damaged profile is an error. Grey is expanded to RGB;
/// 16-bit and float files are converted (float as linear light). Associated alpha is divided out. EXIF orientation is
/// not applied (see ImageInfo), since the camera model refers to the stored pixels. A damaged or truncated file is an
/// error.
Result<Image<Rgba8>> read_image(const std::filesystem::path& path, int max_side_px = kMaxImageSide_px);

/// Reads linear-light float RGBA with straight alpha: EXR and HDR unchanged, 8- and 16-bit files through the sRGB
/// curve.
Result<Image<RgbaF>> read_image_linear(const std::filesystem::path& path);

/// Reads a radiance image, such as an environment, as read_image_linear() does, opaque, with finite and non-negative
/// values. Values that are not finite are an error; negative ones (from sharpening in panorama tools) become 0.
Result<Image<RgbaF>> read_radiance(const std::filesystem::path& path);

/// Reads a one-channel float image, such as a depth channel written by write_exr_channel: channel "Z", else the first
/// one.
Result<Image<float>> read_channel(const std::filesystem::path& path);

/// Writes a PNG, 8 bit, straight alpha.
Status write_png(const std::filesystem::path& path, ConstImageView<Rgba8> image);

/// Writes a JPEG: 8-bit sRGB, without alpha, chroma at half resolution. `quality` 1..100.
Status write_jpeg(const std::filesystem::path& path, ConstImageView<Rgba8> image, int quality);

/// Encodes a PNG as write_png does, for embedding; `shown` names the image in errors.
Result<std::vector<std::byte>> encode_png(ConstImageView<Rgba8> image, const std::string& shown);

/// Writes an OpenEXR file: float, zip, linear light. EXR files have associated alpha: colours are multiplied by alpha
/// on writing and divided on reading.
Status write_exr(const std::filesystem::path& path, ConstImageView<RgbaF> image);

/// Writes one float channel named "Z".
Status write_exr_channel(const std::filesystem::path& path, ConstImageView<float> channel);

/// Writes a video file (mp4: H.264) frame by frame. Alpha is composited over `backdrop`. Frames must have the size
/// given to open(), which must be even. finish() renames the temporary file; without it no file remains.
class VideoWriter {
public:
    static Result<VideoWriter> open(const std::filesystem::path& path, int width, int height, double frames_per_second,
                                    Rgba8 backdrop = {40, 42, 46, 255});
    VideoWriter(VideoWriter&&) noexcept;
    VideoWriter& operator=(VideoWriter&&) noexcept;
    ~VideoWriter();

    Status add(ConstImageView<Rgba8> frame);
    Status finish();

    struct Backend;  // defined in the module

private:
    explicit VideoWriter(std::unique_ptr<Backend> backend);
    std::unique_ptr<Backend> backend_;
};

}  // namespace rs
