#include "compositor/scene/scene_images.hpp"

#include "rayspace/file/file_reference.hpp"
#include "rayspace/image_io/image_io.hpp"

namespace rs::compositor {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;  // total of all images of a scene
constexpr int kMaxSide_px = 8192;

}  // namespace

std::shared_ptr<const SceneTexture> SceneImages::read(const std::vector<std::string>& urls,
                                                      const std::filesystem::path& folder, bool repeat_s, bool repeat_t,
                                                      std::string& fault) {
    fault = "names no image";
    for (const std::string& url : urls) {
        const auto path = resolve_reference(url, folder);
        if (!path) {
            fault = "'" + url.substr(0, 80) + "' is not a local file";
            continue;
        }
        Result<std::shared_ptr<const SceneTexture>> texture = read_file(*path, repeat_s, repeat_t);
        if (texture) {
            fault.clear();
            return *texture;
        }
        fault = texture.error().message;
    }
    return nullptr;
}

Result<std::shared_ptr<const SceneTexture>> SceneImages::read_file(const std::filesystem::path& path, bool repeat_s,
                                                                   bool repeat_t) {
    const Key key{path, repeat_s, repeat_t};
    if (const auto known = read_.find(key); known != read_.end()) return known->second;
    RS_ASSIGN_OR_RETURN(const ImageInfo info, read_image_info(path));
    pixels_ += std::int64_t{info.width} * info.height;
    if (info.width > kMaxSide_px || info.height > kMaxSide_px || pixels_ > kMaxPixels) {
        return Error{path.string() + ": is too large for a texture, or the scene has too many; make it smaller"};
    }
    RS_ASSIGN_OR_RETURN(Image<Rgba8> image, read_image(path));
    auto texture = std::make_shared<SceneTexture>();
    texture->file = path;
    texture->image = std::move(image);
    texture->has_alpha = info.has_alpha;
    texture->repeat_s = repeat_s;
    texture->repeat_t = repeat_t;
    texture->modulates = info.channels <= 2;
    read_[key] = texture;
    return std::shared_ptr<const SceneTexture>(texture);
}

}  // namespace rs::compositor
