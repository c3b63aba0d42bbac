#include "compositor/scene/scene_images.hpp"

#include "rayspace/image_io/image_io.hpp"

namespace rs::compositor {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;  // total of all images of a scene
constexpr int kMaxSide_px = 8192;

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

std::optional<std::filesystem::path> local_path(const std::string& url, const std::filesystem::path& folder) {
    std::string name = url;
    if (name.starts_with("file://")) {
        name = name.substr(7);
    } else if (name.starts_with("file:")) {
        name = name.substr(5);
    } else if (const std::size_t colon = name.find(':'); colon != std::string::npos && colon > 1) {
        // http:, urn:, javascript:; a single letter may be a drive.
        if (name.find_first_of("/\\") > colon) return std::nullopt;
    }
    std::string decoded;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool escaped =
            name[i] == '%' && i + 2 < name.size() && hex_digit(name[i + 1]) >= 0 && hex_digit(name[i + 2]) >= 0;
        decoded += escaped ? static_cast<char>(hex_digit(name[i + 1]) * 16 + hex_digit(name[i + 2])) : name[i];
        if (escaped) i += 2;
    }
    if (decoded.empty() || decoded.find('\0') != std::string::npos) return std::nullopt;
    return (folder / decoded).lexically_normal();
}

std::shared_ptr<const SceneTexture> SceneImages::read(const std::vector<std::string>& urls,
                                                      const std::filesystem::path& folder, bool repeat_s, bool repeat_t,
                                                      std::string& fault) {
    fault = "names no image";
    for (const std::string& url : urls) {
        const auto path = local_path(url, folder);
        if (!path) {
            fault = "'" + url.substr(0, 80) + "' is not a local file";
            continue;
        }
        const Key key{*path, repeat_s, repeat_t};
        if (const auto known = read_.find(key); known != read_.end()) {
            fault.clear();
            return known->second;
        }
        const Result<ImageInfo> info = read_image_info(*path);
        if (!info) {
            fault = info.error().message;
            continue;
        }
        pixels_ += std::int64_t{info->width} * info->height;
        if (info->width > kMaxSide_px || info->height > kMaxSide_px || pixels_ > kMaxPixels) {
            fault = path->string() + ": is too large for a texture, or the scene has too many; make it smaller";
            continue;
        }
        Result<Image<Rgba8>> image = read_image(*path);
        if (!image) {
            fault = image.error().message;
            continue;
        }
        auto texture = std::make_shared<SceneTexture>();
        texture->file = *path;
        texture->image = std::move(*image);
        texture->has_alpha = info->has_alpha;
        texture->repeat_s = repeat_s;
        texture->repeat_t = repeat_t;
        texture->modulates = info->channels <= 2;
        read_[key] = texture;
        fault.clear();
        return texture;
    }
    return nullptr;
}

}  // namespace rs::compositor
