#include "rayspace/image_io/image_io.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/image_io/image_backend.hpp"
#include "rayspace/image_io/video_reader.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs {
namespace fs = std::filesystem;
namespace {

struct LoadedBackend {
    const image_io::Backend* backend = nullptr;
    std::string error;
};

LoadedBackend load_backend() {
    std::error_code ignored;
    const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    // The file of this code: the program, or librayspace.so.
    Dl_info info{};
    const bool found = ::dladdr(reinterpret_cast<const void*>(&load_backend), &info) != 0 && info.dli_fname != nullptr;
    const fs::path library = found ? fs::path(info.dli_fname).parent_path() : here;
    const fs::path candidates[] = {
        here / image_io::kBackendFileName,                              // a build folder
        image_io::kBackendFileName,                                     // the run path and the system's library folders
        here / ".." / "lib" / "rayspace" / image_io::kBackendFileName,  // an installation of tools
        library / image_io::kBackendFileName,                           // a build folder's Python module
        // An installation of librayspace.so in lib or lib/MACHINE, of the Python module in lib/python3/dist-packages.
        library / "rayspace" / image_io::kBackendFileName,
        library / ".." / "rayspace" / image_io::kBackendFileName,
        library / ".." / ".." / "rayspace" / image_io::kBackendFileName,
    };
    std::string why;
    for (const fs::path& candidate : candidates) {
        // RTLD_LOCAL hides the symbols of about a hundred libraries. The handle is never closed, since those libraries
        // have threads and exit handlers.
        void* const module = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (module == nullptr) {
            // The error of an existing module that lacks a library is more useful than that of a missing module.
            const char* const message = ::dlerror();
            if (why.empty() || fs::exists(candidate, ignored)) why = message != nullptr ? message : "unknown reason";
            continue;
        }
        const auto function = reinterpret_cast<image_io::BackendFunction>(::dlsym(module, image_io::kBackendSymbol));
        const image_io::Backend* const backend = function != nullptr ? function() : nullptr;
        if (backend != nullptr && backend->version == image_io::kBackendVersion) return {backend, {}};
        why = candidate.string() + " belongs to another version of these tools";
    }
    // Messages of the loader if the address space or memory of the process is limited.
    if (why.find("failed to map segment") != std::string::npos || why.find("annot allocate") != std::string::npos) {
        return {nullptr, "not enough memory to load the image libraries; raise the limit (ulimit -v)"};
    }
    return {nullptr, std::string(image_io::kBackendFileName) + " cannot be opened (" + why +
                         "); put it beside the program or in ../lib/rayspace, with OpenImageIO and FFmpeg installed"};
}

Result<const image_io::Backend*> backend_for(const fs::path& path) {
    static const LoadedBackend loaded = load_backend();
    if (loaded.backend == nullptr) return Error{path.string() + ": " + loaded.error};
    return loaded.backend;
}

// Images are encoded in memory, so that only StagedFile reports disk errors.
Status check_size(const std::string& shown, int width, int height) {
    if (width >= 1 && height >= 1 && width <= kMaxImageSide_px && height <= kMaxImageSide_px) return {};
    return Error{shown + ": an image of " + std::to_string(width) + "x" + std::to_string(height) +
                 " pixels cannot be written; each side must be 1.." + std::to_string(kMaxImageSide_px)};
}

// Writes an image. `encode` returns the file's bytes from the backend.
template <class Pixel, class Encode>
Status write_encoded(const fs::path& path, ConstImageView<Pixel> image, const Encode& encode) {
    RS_TRY(check_size(path.string(), image.width(), image.height()));
    RS_ASSIGN_OR_RETURN(const auto backend, backend_for(path));
    // Check that the file can be written before encoding.
    RS_ASSIGN_OR_RETURN(auto file, StagedFile::create(path));
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, encode(*backend));
    RS_TRY(file.write(bytes));
    return file.commit();
}

}  // namespace

Result<ImageInfo> read_image_info(const fs::path& path, int max_side_px) {
    RS_TRY(check_input(path));
    const auto backend = backend_for(path);
    return backend ? (*backend)->read_info(path.string(), max_side_px) : backend.error();
}

Result<Image<Rgba8>> read_image(const fs::path& path, int max_side_px) {
    RS_TRY(check_input(path));
    const auto backend = backend_for(path);
    return backend ? (*backend)->read_image(path.string(), max_side_px) : backend.error();
}

Result<Image<RgbaF>> read_image_linear(const fs::path& path) {
    RS_TRY(check_input(path));
    const auto backend = backend_for(path);
    return backend ? (*backend)->read_image_linear(path.string()) : backend.error();
}

Result<Image<RgbaF>> read_radiance(const fs::path& path) {
    Result<Image<RgbaF>> image = read_image_linear(path);
    if (!image) return image;
    for (RgbaF& p : image->pixels()) {
        if (!std::isfinite(p.r) || !std::isfinite(p.g) || !std::isfinite(p.b)) {
            return Error{path.string() + " has pixels that are not finite; repair it"};
        }
        p = {std::max(p.r, 0.0F), std::max(p.g, 0.0F), std::max(p.b, 0.0F), 1.0F};
    }
    return image;
}

Result<Image<float>> read_channel(const fs::path& path) {
    RS_TRY(check_input(path));
    const auto backend = backend_for(path);
    return backend ? (*backend)->read_channel(path.string()) : backend.error();
}

Status write_png(const fs::path& path, ConstImageView<Rgba8> image) {
    return write_encoded(path, image,
                         [&](const image_io::Backend& backend) { return backend.encode_png(image, path.string()); });
}

Status write_jpeg(const fs::path& path, ConstImageView<Rgba8> image, int quality) {
    RS_CHECK(quality >= 1 && quality <= 100);
    return write_encoded(path, image, [&](const image_io::Backend& backend) {
        return backend.encode_jpeg(image, quality, path.string());
    });
}

Result<std::vector<std::byte>> encode_png(ConstImageView<Rgba8> image, const std::string& shown) {
    RS_TRY(check_size(shown, image.width(), image.height()));
    const auto backend = backend_for(shown);
    return backend ? (*backend)->encode_png(image, shown) : backend.error();
}

Status write_exr(const fs::path& path, ConstImageView<RgbaF> image) {
    return write_encoded(path, image,
                         [&](const image_io::Backend& backend) { return backend.encode_exr(image, path.string()); });
}

Status write_exr_channel(const fs::path& path, ConstImageView<float> channel) {
    return write_encoded(path, channel, [&](const image_io::Backend& backend) {
        return backend.encode_exr_channel(channel, path.string());
    });
}

struct VideoWriter::Backend {
    // Members are destroyed in reverse order: the encoder closes the file before it is removed.
    StagedFile file;
    std::unique_ptr<image_io::VideoEncoder> encoder;
    image_io::VideoOptions options;
    std::string shown;
};

VideoWriter::VideoWriter(std::unique_ptr<Backend> backend) : backend_(std::move(backend)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

Result<VideoWriter> VideoWriter::open(const fs::path& path, int width, int height, double frames_per_second,
                                      Rgba8 backdrop) {
    const std::string shown = path.string();
    if (width < 2 || height < 2 || width % 2 != 0 || height % 2 != 0 || width > kMaxImageSide_px ||
        height > kMaxImageSide_px) {
        return Error{shown + ": a video of " + std::to_string(width) + "x" + std::to_string(height) +
                     " pixels cannot be written; width and height must be even and 2.." +
                     std::to_string(kMaxImageSide_px)};
    }
    if (!(std::isfinite(frames_per_second) && frames_per_second > 0 && frames_per_second <= 1000)) {
        return Error{shown + ": the frame rate must lie between 0 and 1000 frames per second"};
    }
    RS_ASSIGN_OR_RETURN(const auto backend, backend_for(path));
    RS_ASSIGN_OR_RETURN(auto file, StagedFile::create(path));
    const image_io::VideoOptions options{width, height, frames_per_second, backdrop};
    RS_ASSIGN_OR_RETURN(auto encoder, backend->open_video(file.temporary_path().string(), shown, options));
    return VideoWriter(std::unique_ptr<Backend>(new Backend{std::move(file), std::move(encoder), options, shown}));
}

Status VideoWriter::add(ConstImageView<Rgba8> frame) {
    RS_CHECK(backend_ != nullptr && backend_->encoder != nullptr);
    if (frame.width() != backend_->options.width || frame.height() != backend_->options.height) {
        return Error{backend_->shown + ": a frame of " + std::to_string(frame.width()) + "x" +
                     std::to_string(frame.height()) + " pixels does not fit the video of " +
                     std::to_string(backend_->options.width) + "x" + std::to_string(backend_->options.height)};
    }
    return backend_->encoder->add(frame);
}

Status VideoWriter::finish() {
    RS_CHECK(backend_ != nullptr && backend_->encoder != nullptr);
    RS_TRY(backend_->encoder->finish());
    backend_->encoder.reset();
    return backend_->file.commit();
}

VideoReader::VideoReader(std::unique_ptr<image_io::VideoDecoder> decoder) : decoder_(std::move(decoder)) {}
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;
VideoReader::~VideoReader() = default;

Result<VideoReader> VideoReader::open(const fs::path& path) {
    RS_TRY(check_input(path));
    RS_ASSIGN_OR_RETURN(const auto backend, backend_for(path));
    RS_ASSIGN_OR_RETURN(auto decoder, backend->read_video(path.string()));
    return VideoReader(std::move(decoder));
}

const VideoInfo& VideoReader::info() const {
    return decoder_->info();
}

Result<bool> VideoReader::read(Image<Rgba8>& frame) {
    return decoder_->read(frame);
}

int VideoReader::damaged_frames() const {
    return decoder_->damaged_frames();
}

}  // namespace rs
