#include "capture/posed/photo_match.hpp"

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 100000;

// Parts of a path from its end, in lower case, the file name without the extension of an image.
std::vector<std::string> reversed_parts(std::string path) {
    std::ranges::replace(path, '\\', '/');
    std::ranges::transform(path, path.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    fs::path name(path);
    if (is_image_name(name)) name.replace_extension();
    std::vector<std::string> parts;
    for (const fs::path& part : name) {
        if (part != "." && part != "/" && !part.empty()) parts.insert(parts.begin(), part.string());
    }
    return parts;
}

std::size_t common_parts(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    const std::size_t most = std::min(a.size(), b.size());
    std::size_t count = 0;
    while (count < most && a[count] == b[count]) ++count;
    return count;
}

// Index of photos by the last part of their names.
class PhotoIndex {
public:
    explicit PhotoIndex(const std::vector<std::string>& names) : names_(names) {
        for (std::size_t i = 0; i < names.size(); ++i) {
            parts_.push_back(reversed_parts(names[i]));
            by_stem_[parts_.back().front()].push_back(i);
        }
    }

    // The photo of a camera; nullopt if there is none.
    [[nodiscard]] Result<std::optional<std::size_t>> find(const std::string& photo) const {
        const std::vector<std::string> parts = reversed_parts(photo);
        const auto found = parts.empty() ? by_stem_.end() : by_stem_.find(parts.front());
        if (found == by_stem_.end()) return std::optional<std::size_t>();
        std::size_t longest = 0;
        std::vector<std::size_t> best;
        for (const std::size_t i : found->second) {
            const std::size_t common = common_parts(parts, parts_[i]);
            if (common > longest) best.clear();
            if (common >= longest) best.push_back(i);
            longest = std::max(longest, common);
        }
        const std::string extension = fs::path(photo).extension().string();
        const auto same_format = [&](std::size_t i) { return fs::path(names_[i]).extension() == extension; };
        if (best.size() > 1 && std::ranges::count_if(best, same_format) == 1) {
            return std::optional(*std::ranges::find_if(best, same_format));
        }
        if (best.size() > 1) {
            return Error{printable(photo + ": may be " + names_[best[0]] + " or " + names_[best[1]] +
                                   "; give the folder that holds only the photos")};
        }
        return std::optional(best.front());
    }

private:
    const std::vector<std::string>& names_;
    std::vector<std::vector<std::string>> parts_;  // [photo]
    std::map<std::string, std::vector<std::size_t>> by_stem_;
};

// Reads the header and chooses the orientation in which the photo has the size of its camera.
Result<PosedPhoto> sized_photo(const fs::path& file, std::string name, PosedCamera camera, const std::string& where) {
    RS_ASSIGN_OR_RETURN(const ImageInfo info, read_image_info(file, kMaxPhotoSide_px));
    PosedPhoto photo{file, std::move(name), std::move(camera), 1, info.has_alpha};
    Camera& lens = photo.camera.camera;
    if (lens.width == 0) {
        lens.width = info.width;
        lens.height = info.height;
    }
    if (lens.width == info.width && lens.height == info.height) return photo;
    if (info.orientation >= 5 && lens.width == info.height && lens.height == info.width) {
        photo.orientation = info.orientation;
        return photo;
    }
    return Error{printable(file.string() + ": is " + size_text(info.width, info.height) + ", its camera in " + where +
                           " is for " + size_text(lens.width, lens.height) +
                           "; give the photos from which the cameras were computed")};
}

}  // namespace

Result<std::vector<std::string>> list_photos(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code failure;
    std::size_t files = 0;
    for (fs::recursive_directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (++files > kMaxFiles)
            return Error{folder.string() + ": holds too many files; give the folder of the photos"};
        if (entry->path().filename().string().starts_with('.')) {
            if (entry->is_directory(failure)) entry.disable_recursion_pending();
        } else if (is_image_name(entry->path()) && entry->is_regular_file(failure)) {
            names.push_back(entry->path().lexically_relative(folder).generic_string());
        }
    }
    if (failure) return Error{folder.string() + ": cannot be listed (" + failure.message() + "); give a folder"};
    if (names.empty()) return Error{folder.string() + ": holds no image files; give the folder of the photos"};
    std::ranges::sort(names, natural_less);
    return names;
}

Result<PhotoMatches> match_photos(const fs::path& photos, const PosedModel& model) {
    RS_ASSIGN_OR_RETURN(const std::vector<std::string> names, list_photos(photos));
    const PhotoIndex index(names);
    PhotoMatches matches;
    std::map<std::size_t, const PosedCamera*> camera_of;
    std::set<fs::path> folders;  // of matched photos
    for (const PosedCamera& camera : model.cameras) {
        RS_ASSIGN_OR_RETURN(const std::optional<std::size_t> photo, index.find(camera.photo));
        if (!photo) {
            matches.without_photo.push_back(camera.photo);
            continue;
        }
        if (!camera_of.try_emplace(*photo, &camera).second) {
            return Error{printable((photos / names[*photo]).string() + ": has two cameras in " + model.where + ", " +
                                   camera_of[*photo]->photo + " and " + camera.photo +
                                   "; give the folder with all photos, or correct the names")};
        }
        folders.insert(fs::path(names[*photo]).parent_path());
    }
    if (camera_of.empty()) {
        return Error{printable(photos.string() + ": has none of the " + std::to_string(model.cameras.size()) +
                               " photos of " + model.where + ", the first is " + model.cameras.front().photo +
                               "; give the folder of these photos")};
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto found = camera_of.find(i);
        if (found == camera_of.end()) {
            if (folders.contains(fs::path(names[i]).parent_path())) matches.without_camera.push_back(names[i]);
            continue;
        }
        RS_ASSIGN_OR_RETURN(PosedPhoto photo, sized_photo(photos / names[i], names[i], *found->second, model.where));
        matches.photos.push_back(std::move(photo));
    }
    return matches;
}

}  // namespace rs::capture
