#pragma once
// Interface between image_io.cpp and librayspace_image_io.so: a table of functions, found by one C symbol.
//
// The module is built with the tools and installed with them, so that C++ types may cross the boundary. It uses only
// header code of this library, and so needs no symbols of the program that opens it. `path` is the file to be read;
// `shown` is its name in errors. Exceptions do not leave the module.

#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/video_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rs::image_io {

/// Encodes into a file, which image_io.cpp stages and renames.
class VideoEncoder {
public:
    virtual ~VideoEncoder() = default;
    virtual Status add(ConstImageView<Rgba8> frame) = 0;
    /// Closes the file, which is then complete on the disk.
    virtual Status finish() = 0;
};

/// Interface behind VideoReader (video_reader.hpp).
class VideoDecoder {
public:
    virtual ~VideoDecoder() = default;
    [[nodiscard]] virtual const VideoInfo& info() const = 0;
    virtual Result<bool> read(Image<Rgba8>& frame) = 0;
    [[nodiscard]] virtual int damaged_frames() const = 0;
};

struct VideoOptions {
    int width = 0;
    int height = 0;
    double frames_per_second = 0;
    Rgba8 backdrop;
};

struct Backend {
    std::uint32_t version = 0;
    Result<ImageInfo> (*read_info)(const std::string& path, int max_side_px) = nullptr;
    Result<Image<Rgba8>> (*read_image)(const std::string& path, int max_side_px) = nullptr;
    Result<Image<RgbaF>> (*read_image_linear)(const std::string& path) = nullptr;
    Result<Image<float>> (*read_channel)(const std::string& path) = nullptr;
    Result<std::vector<std::byte>> (*encode_png)(ConstImageView<Rgba8> image, const std::string& shown) = nullptr;
    Result<std::vector<std::byte>> (*encode_jpeg)(ConstImageView<Rgba8> image, int quality,
                                                  const std::string& shown) = nullptr;
    Result<std::vector<std::byte>> (*encode_exr)(ConstImageView<RgbaF> image, const std::string& shown) = nullptr;
    Result<std::vector<std::byte>> (*encode_exr_channel)(ConstImageView<float> channel,
                                                         const std::string& shown) = nullptr;
    Result<std::unique_ptr<VideoEncoder>> (*open_video)(const std::string& path, const std::string& shown,
                                                        const VideoOptions& options) = nullptr;
    Result<std::unique_ptr<VideoDecoder>> (*read_video)(const std::string& path) = nullptr;
};

/// Must be incremented with every change of the declarations above.
inline constexpr std::uint32_t kBackendVersion = 5;
inline constexpr const char* kBackendFileName = "librayspace_image_io.so";
inline constexpr const char* kBackendSymbol = "rayspace_image_io_backend";
using BackendFunction = const Backend* (*)();

/// Module-internal: video_backend.cpp.
Result<std::unique_ptr<VideoEncoder>> open_video(const std::string& path, const std::string& shown,
                                                 const VideoOptions& options);

/// Module-internal: video_decoder.cpp.
Result<std::unique_ptr<VideoDecoder>> read_video(const std::string& path);

}  // namespace rs::image_io
