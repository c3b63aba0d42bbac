// Image part of librayspace_image_io.so, with OpenImageIO. See image_io.hpp for the contracts.
#include "rayspace/image_io/image_backend.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/image_io/backend/colour_profile.hpp"
#include "rayspace/image_io/backend/file_checks.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <type_traits>

namespace rs::image_io {
namespace {

// Joins a library's message, which may have several lines and repeat the file's name.
std::string one_line(std::string message) {
    while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) message.pop_back();
    std::replace_if(
        message.begin(), message.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return message.empty() ? "no reason given" : message;
}

template <class Function>
auto catch_exceptions(const std::string& shown, Function&& function) -> decltype(function()) {
    try {
        return function();
    } catch (const std::bad_alloc&) {
        return Error{shown + ": not enough memory for this image"};
    } catch (const std::exception& escaped) {
        return Error{shown + ": " + one_line(escaped.what())};
    }
}

struct OpenedImage {
    std::unique_ptr<OIIO::ImageInput> input;
    int width = 0;  // display window: the visible part of the image
    int height = 0;
};

enum class Need { kHeader, kWholeFile };

Result<OpenedImage> open_image(const std::string& path, Need need, int max_side_px = kMaxImageSide_px) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return Error{path + ": does not exist; check the name"};
    if (std::filesystem::is_directory(path, error)) return Error{path + ": is a folder, not an image"};
    if (std::filesystem::is_empty(path, error)) return Error{path + ": is an empty file; get it again or remove it"};
    if (need == Need::kWholeFile) {
        RS_TRY(check_png_integrity(path));
    }
    RS_TRY(check_exr_header(path, max_side_px));
    RS_TRY(check_profile_integrity(path));
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);  // keeps colours under alpha 0
    // OpenImageIO 2.4 stores profile data in global tables without a lock.
    static std::mutex opening;
    auto input = [&] {
        const std::lock_guard lock(opening);
        return OIIO::ImageInput::open(path, &hints);
    }();
    if (!input) {
        return Error{path + ": cannot be read as an image: " + one_line(OIIO::geterror()) +
                     "; get it again or remove it"};
    }
    const OIIO::ImageSpec& spec = input->spec();
    const int width = spec.full_width > 0 ? spec.full_width : spec.width;
    const int height = spec.full_height > 0 ? spec.full_height : spec.height;
    const auto too_large = [&](int side) { return side < 1 || side > max_side_px; };
    if (too_large(spec.width) || too_large(spec.height) || too_large(width) || too_large(height)) {
        return Error{path + ": claims " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                     " pixels; each side must be 1.." + std::to_string(max_side_px)};
    }
    if (spec.deep || spec.depth > 1 || spec.nchannels < 1) {
        return Error{path + ": holds deep or volume data; convert it to an ordinary image"};
    }
    input->threads(1);  // callers read images in parallel
    return OpenedImage{std::move(input), width, height};
}

// The file's channels that make up a colour image.
struct Channels {
    int count = 0;       // the first `count` channels are read
    int colours = 0;     // 1 or 3
    bool alpha = false;  // follows the colours
    bool straight = true;
};

Channels choose_channels(const OIIO::ImageSpec& spec) {
    Channels chosen;
    chosen.colours = spec.nchannels >= 3 && spec.alpha_channel != 1 ? 3 : 1;
    chosen.alpha = spec.alpha_channel == chosen.colours;
    chosen.count = chosen.colours + (chosen.alpha ? 1 : 0);
    chosen.straight = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
    return chosen;
}

// Reads the data window's first `channels` channels, interleaved.
template <class T>
Result<std::vector<T>> read_samples(OpenedImage& opened, const std::string& path, int first, int channels) {
    const OIIO::ImageSpec spec = opened.input->spec();
    std::vector<T> samples(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                           static_cast<std::size_t>(channels));
    const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
    if (!opened.input->read_image(0, 0, first, first + channels, type, samples.data())) {
        return Error{path + ": is damaged or cut short: " + one_line(opened.input->geterror())};
    }
    // Some readers continue after damage and only record an error.
    if (opened.input->has_error()) {
        return Error{path + ": is damaged or cut short: " + one_line(opened.input->geterror())};
    }
    return samples;
}

// Calls set(x, y, sample pointer) for the part of the data window inside the display window.
template <class T, class Set>
void for_each_visible(const OpenedImage& opened, const std::vector<T>& samples, int channels, Set&& set) {
    const OIIO::ImageSpec& spec = opened.input->spec();
    for (int y = 0; y < spec.height; ++y) {
        const std::int64_t shown_y = std::int64_t{y} + spec.y - spec.full_y;
        if (shown_y < 0 || shown_y >= opened.height) continue;
        const T* sample = samples.data() + static_cast<std::ptrdiff_t>(y) * spec.width * channels;
        for (int x = 0; x < spec.width; ++x, sample += channels) {
            const std::int64_t shown_x = std::int64_t{x} + spec.x - spec.full_x;
            if (shown_x < 0 || shown_x >= opened.width) continue;
            set(static_cast<int>(shown_x), static_cast<int>(shown_y), sample);
        }
    }
}

std::uint8_t byte_from_unit(float v) {
    // The comparison maps NaN to 0.
    return v > 0 ? static_cast<std::uint8_t>(std::lround(std::min(v, 1.0F) * 255.0F)) : std::uint8_t{0};
}

template <class T>
RgbaF pixel_of(const T* sample, const Channels& channels) {
    const float scale = std::is_floating_point_v<T> ? 1.0F : 1.0F / static_cast<float>(std::numeric_limits<T>::max());
    const auto at = [&](int i) { return static_cast<float>(sample[i]) * scale; };
    RgbaF pixel{at(0), at(channels.colours == 3 ? 1 : 0), at(channels.colours == 3 ? 2 : 0),
                channels.alpha ? at(channels.colours) : 1.0F};
    if (channels.alpha && !channels.straight && pixel.a > 0) {
        pixel.r /= pixel.a;
        pixel.g /= pixel.a;
        pixel.b /= pixel.a;
    }
    return pixel;
}

std::optional<ColourProfile> profile_of(const OpenedImage& opened) {
    const OIIO::ParamValue* const icc = opened.input->spec().find_attribute("ICCProfile");
    if (icc == nullptr || icc->type().basetype != OIIO::TypeDesc::UINT8) return std::nullopt;
    return ColourProfile::create_unless_srgb({static_cast<const std::byte*>(icc->data()), icc->type().size()});
}

Result<ImageInfo> read_info(const std::string& path, int max_side_px) {
    return catch_exceptions(path, [&]() -> Result<ImageInfo> {
        RS_ASSIGN_OR_RETURN(const auto opened, open_image(path, Need::kHeader, max_side_px));
        const OIIO::ImageSpec& spec = opened.input->spec();
        const int orientation = spec.get_int_attribute("Orientation", 1);
        return ImageInfo{opened.width,
                         opened.height,
                         spec.nchannels,
                         choose_channels(spec).alpha,
                         orientation >= 1 && orientation <= 8 ? orientation : 1,
                         std::max(0, spec.get_int_attribute("Exif:FocalLengthIn35mmFilm", 0))};
    });
}

// Reads 8-bit files with straight alpha; all values are unchanged.
Result<Image<Rgba8>> read_bytes(OpenedImage& opened, const std::string& path, const Channels& channels) {
    RS_ASSIGN_OR_RETURN(const auto samples, read_samples<std::uint8_t>(opened, path, 0, channels.count));
    Image<Rgba8> image(opened.width, opened.height);
    const int green = channels.colours == 3 ? 1 : 0;
    const int blue = channels.colours == 3 ? 2 : 0;
    for_each_visible(opened, samples, channels.count, [&](int x, int y, const std::uint8_t* s) {
        const std::uint8_t alpha = channels.alpha ? s[channels.colours] : std::uint8_t{255};
        image(x, y) = {s[0], s[green], s[blue], alpha};
    });
    return image;
}

Result<Image<Rgba8>> read_image(const std::string& path, int max_side_px) {
    return catch_exceptions(path, [&]() -> Result<Image<Rgba8>> {
        RS_ASSIGN_OR_RETURN(auto opened, open_image(path, Need::kWholeFile, max_side_px));
        const Channels channels = choose_channels(opened.input->spec());
        const bool is_float = opened.input->spec().format.is_floating_point();
        const std::optional<ColourProfile> profile = profile_of(opened);
        if (opened.input->spec().format == OIIO::TypeUInt8 && (channels.straight || !channels.alpha)) {
            Result<Image<Rgba8>> image = read_bytes(opened, path, channels);
            if (image && profile) profile->to_srgb(std::span(image->pixels()));
            return image;
        }
        Image<Rgba8> image(opened.width, opened.height);
        const auto store = [&](int x, int y, RgbaF p) {
            if (is_float) p = {srgb_from_linear(p.r), srgb_from_linear(p.g), srgb_from_linear(p.b), p.a};
            image(x, y) = {byte_from_unit(p.r), byte_from_unit(p.g), byte_from_unit(p.b), byte_from_unit(p.a)};
        };
        RS_ASSIGN_OR_RETURN(const auto samples, read_samples<float>(opened, path, 0, channels.count));
        for_each_visible(opened, samples, channels.count,
                         [&](int x, int y, const float* s) { store(x, y, pixel_of(s, channels)); });
        if (profile && !is_float) profile->to_srgb(std::span(image.pixels()));
        return image;
    });
}

Result<Image<RgbaF>> read_image_linear(const std::string& path) {
    return catch_exceptions(path, [&]() -> Result<Image<RgbaF>> {
        RS_ASSIGN_OR_RETURN(auto opened, open_image(path, Need::kWholeFile));
        const Channels channels = choose_channels(opened.input->spec());
        const bool is_float = opened.input->spec().format.is_floating_point();
        RS_ASSIGN_OR_RETURN(const auto samples, read_samples<float>(opened, path, 0, channels.count));
        Image<RgbaF> image(opened.width, opened.height);
        for_each_visible(opened, samples, channels.count,
                         [&](int x, int y, const float* s) { image(x, y) = pixel_of(s, channels); });
        if (is_float) return image;
        if (const auto profile = profile_of(opened)) profile->to_srgb(std::span(image.pixels()));
        for (RgbaF& p : image.pixels()) {
            p = {linear_from_srgb(p.r), linear_from_srgb(p.g), linear_from_srgb(p.b), p.a};
        }
        return image;
    });
}

Result<Image<float>> read_channel(const std::string& path) {
    return catch_exceptions(path, [&]() -> Result<Image<float>> {
        RS_ASSIGN_OR_RETURN(auto opened, open_image(path, Need::kWholeFile));
        const std::vector<std::string>& names = opened.input->spec().channelnames;
        const auto z = std::find(names.begin(), names.end(), "Z");
        const int channel = z == names.end() ? 0 : static_cast<int>(z - names.begin());
        RS_ASSIGN_OR_RETURN(const auto samples, read_samples<float>(opened, path, channel, 1));
        Image<float> image(opened.width, opened.height);
        for_each_visible(opened, samples, 1, [&](int x, int y, const float* s) { image(x, y) = *s; });
        return image;
    });
}

struct PixelRows {
    const void* pixels = nullptr;
    OIIO::TypeDesc channel;
    std::ptrdiff_t pixel_bytes = 0;
    std::ptrdiff_t row_bytes = 0;
};

template <class Pixel>
PixelRows rows_of(ConstImageView<Pixel> image, const OIIO::TypeDesc& channel) {
    return {.pixels = image.data(),
            .channel = channel,
            .pixel_bytes = sizeof(Pixel),
            .row_bytes = image.stride() * static_cast<std::ptrdiff_t>(sizeof(Pixel))};
}

// Encodes an image of `spec` into memory.
Result<std::vector<std::byte>> encode(const char* format, const OIIO::ImageSpec& spec, const PixelRows& rows,
                                      const std::string& shown) {
    return catch_exceptions(shown, [&]() -> Result<std::vector<std::byte>> {
        auto output = OIIO::ImageOutput::create(format);
        if (!output) return Error{shown + ": cannot be encoded: " + one_line(OIIO::geterror())};
        OIIO::Filesystem::IOVecOutput memory;
        output->threads(1);
        // With a proxy nothing is written to the disk; the name only appears in messages.
        if (!output->set_ioproxy(&memory) || !output->open(shown, spec) ||
            !output->write_image(rows.channel, rows.pixels, rows.pixel_bytes, rows.row_bytes) || !output->close()) {
            return Error{shown + ": cannot be encoded: " + one_line(output->geterror())};
        }
        const auto* const first = reinterpret_cast<const std::byte*>(memory.buffer().data());
        return std::vector<std::byte>(first, first + memory.buffer().size());
    });
}

Result<std::vector<std::byte>> encode_png(ConstImageView<Rgba8> image, const std::string& shown) {
    OIIO::ImageSpec spec(image.width(), image.height(), 4, OIIO::TypeUInt8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("oiio:ColorSpace", "sRGB");
    // Takes half of the time of the default level with a filter chosen per row, for up to a tenth more bytes.
    constexpr int kFilterUp = 0x20;  // PNG_FILTER_UP of libpng
    spec.attribute("png:compressionLevel", 4);
    spec.attribute("png:filter", kFilterUp);
    return encode("png", spec, rows_of(image, OIIO::TypeUInt8), shown);
}

Result<std::vector<std::byte>> encode_jpeg(ConstImageView<Rgba8> image, int quality, const std::string& shown) {
    OIIO::ImageSpec spec(image.width(), image.height(), 3, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("compression", "jpeg:" + std::to_string(quality));
    spec.attribute("jpeg:subsampling", "4:2:0");
    return encode("jpeg", spec, rows_of(image, OIIO::TypeUInt8), shown);
}

// Without a fixed date the time of writing becomes "capDate", and equal images would make different files.
void describe_exr(OIIO::ImageSpec& spec) {
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "1970:01:01 00:00:00");
}

Result<std::vector<std::byte>> encode_exr(ConstImageView<RgbaF> image, const std::string& shown) {
    std::vector<RgbaF> associated;
    associated.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
    for (int y = 0; y < image.height(); ++y) {
        for (const RgbaF& p : image.row_span(y)) associated.push_back({p.r * p.a, p.g * p.a, p.b * p.a, p.a});
    }
    OIIO::ImageSpec spec(image.width(), image.height(), 4, OIIO::TypeFloat);
    describe_exr(spec);
    return encode("openexr", spec,
                  {.pixels = associated.data(),
                   .channel = OIIO::TypeFloat,
                   .pixel_bytes = sizeof(RgbaF),
                   .row_bytes = OIIO::AutoStride},
                  shown);
}

Result<std::vector<std::byte>> encode_exr_channel(ConstImageView<float> channel, const std::string& shown) {
    OIIO::ImageSpec spec(channel.width(), channel.height(), 1, OIIO::TypeFloat);
    spec.channelnames = {"Z"};
    spec.z_channel = 0;
    describe_exr(spec);
    return encode("openexr", spec, rows_of(channel, OIIO::TypeFloat), shown);
}

const Backend& table() {
    static const Backend backend = [] {
        // Callers process images in parallel; the libraries' own thread pools would compete for the cores.
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);
        Backend made;
        made.version = kBackendVersion;
        made.read_info = read_info;
        made.read_image = read_image;
        made.read_image_linear = read_image_linear;
        made.read_channel = read_channel;
        made.encode_png = encode_png;
        made.encode_jpeg = encode_jpeg;
        made.encode_exr = encode_exr;
        made.encode_exr_channel = encode_exr_channel;
        made.open_video = open_video;
        made.read_video = read_video;
        return made;
    }();
    return backend;
}

}  // namespace
}  // namespace rs::image_io

extern "C" const rs::image_io::Backend* rayspace_image_io_backend() {
    return &rs::image_io::table();
}
