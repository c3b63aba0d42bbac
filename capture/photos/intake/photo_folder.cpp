#include "capture/photos/intake/photo_folder.hpp"

#include "capture/photos/intake/reduction.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <system_error>
#include <utility>

namespace rs::capture {
namespace {

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// In order of preference. JPEG is first: equally many files of another format with the same names may be masks or
// foreground images.
constexpr std::array<std::string_view, 14> kExtensions = {".jpg",  ".jpeg", ".png", ".tif", ".tiff", ".webp", ".heic",
                                                          ".heif", ".avif", ".bmp", ".exr", ".hdr",  ".tga",  ".ppm"};

// Index in kExtensions of the name's extension; kExtensions.size() if it has another one.
std::size_t extension_of(const std::filesystem::path& name) {
    std::string extension = name.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), lower);
    return static_cast<std::size_t>(std::ranges::find(kExtensions, extension) - kExtensions.begin());
}

// Keeps one of the files that differ only in their extension, the one in the most frequent format: a phone's HEIC and
// the JPEG converted from it are the same photo.
void keep_one_format(PhotoFolder& found) {
    std::array<int, kExtensions.size()> having{};  // [extension]: number of image files
    std::map<std::string, std::filesystem::path> by_stem;
    for (const std::filesystem::path& photo : found.photos) ++having[extension_of(photo)];
    const auto is_better = [&](const std::filesystem::path& a, const std::filesystem::path& b) {
        const std::size_t of_a = extension_of(a), of_b = extension_of(b);
        return having[of_a] != having[of_b] ? having[of_a] > having[of_b] : of_a < of_b;
    };
    for (const std::filesystem::path& photo : found.photos) {
        std::filesystem::path& kept = by_stem[photo.stem().string()];
        if (kept.empty() || is_better(photo, kept)) kept = photo;
    }
    std::erase_if(found.photos, [&](const std::filesystem::path& photo) {
        if (by_stem[photo.stem().string()] == photo) return false;
        found.in_other_formats.push_back(photo.filename().string());
        return true;
    });
}

// Returns the run of digits at `at` without its leading zeros, and advances `at` past it.
std::string_view take_number(std::string_view text, std::size_t& at) {
    while (at < text.size() && text[at] == '0') ++at;
    const std::size_t begin = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return text.substr(begin, at - begin);
}

bool on_its_side(int orientation) {
    return orientation >= 5;
}

// Size of a file's image as displayed with the given EXIF orientation.
std::pair<int, int> shown_size(const ImageInfo& info, int orientation) {
    return on_its_side(orientation) ? std::pair(info.height, info.width) : std::pair(info.width, info.height);
}

// [orientation]: number of files with this EXIF orientation.
using Statements = std::array<int, 9>;

int what_most_state(const Statements& stated) {
    return static_cast<int>(std::ranges::max_element(stated) - stated.begin());
}

// Assigns the most frequent orientation to all files that are stored in the same size, because the camera is fixed. If
// some are stored on their side and others were rotated upright later, each of the two groups has its own.
Status choose_orientations(PhotoFolder& found, const std::vector<ImageInfo>& infos) {
    Statements of_all{};
    std::map<std::pair<int, int>, Statements> of_size;  // key: size as stored
    for (const ImageInfo& info : infos) {
        ++of_all[static_cast<std::size_t>(info.orientation)];
        ++of_size[{info.width, info.height}][static_cast<std::size_t>(info.orientation)];
    }
    found.orientation = what_most_state(of_all);
    for (std::size_t i = 0; i < infos.size(); ++i) {
        const int orientation = what_most_state(of_size[{infos[i].width, infos[i].height}]);
        const auto [width, height] = shown_size(infos[i], orientation);
        if (i == 0) {
            found.shown_width = width;
            found.shown_height = height;
        }
        if (width != found.shown_width || height != found.shown_height) {
            const bool is_turned = std::ranges::any_of(infos, [](const ImageInfo& o) { return o.orientation != 1; });
            return Error{found.photos[i].string() + ": is " + size_text(width, height) + " but " +
                         found.photos.front().filename().string() + " is " +
                         size_text(found.shown_width, found.shown_height) +
                         (is_turned ? ", turned as EXIF states" : "") + "; all images of a turn must have one size"};
        }
        found.other_orientation_count += infos[i].orientation != orientation ? 1 : 0;
        if (of_size.size() > 1) found.own_orientations.push_back(orientation);
    }
    return {};
}

Status read_headers(PhotoFolder& found) {
    std::vector<ImageInfo> infos;
    for (const std::filesystem::path& photo : found.photos) {
        RS_ASSIGN_OR_RETURN(const ImageInfo info, read_image_info(photo, kMaxPhotoSide_px));
        infos.push_back(info);
    }
    const auto all = [&](const auto& holds) { return std::ranges::all_of(infos, holds); };
    const int focal_35mm = infos.front().focal_35mm;
    found.has_alpha = all([](const ImageInfo& info) { return info.has_alpha; });
    found.focal_35mm = all([&](const ImageInfo& info) { return info.focal_35mm == focal_35mm; }) ? focal_35mm : 0;
    return choose_orientations(found, infos);
}

// The name up to its first number: "angle_-" of "angle_-30.jpg".
std::string before_number(const std::filesystem::path& photo) {
    const std::string name = photo.filename().string();
    return {name.begin(), std::ranges::find_if(name, [](char c) { return is_digit(c); })};
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (is_digit(a[i]) && is_digit(b[j])) {
            const std::string_view m = take_number(a, i);
            const std::string_view n = take_number(b, j);
            if (m.size() != n.size()) return m.size() < n.size();
            if (m != n) return m < n;
        } else {
            const char c = lower(a[i++]);
            const char d = lower(b[j++]);
            if (c != d) return static_cast<unsigned char>(c) < static_cast<unsigned char>(d);
        }
    }
    if (i < a.size() || j < b.size()) return i == a.size();
    return a < b;
}

void sort_photos(std::vector<std::filesystem::path>& photos) {
    const auto less = [](const std::filesystem::path& a, const std::filesystem::path& b) {
        return natural_less(a.filename().string(), b.filename().string());
    };
    std::sort(photos.begin(), photos.end(), less);
    // A minus is a sign, not a separator, if the names differ only by it.
    const auto has_minus = [](const std::filesystem::path& photo) { return before_number(photo).ends_with('-'); };
    const auto unsigned_photo = std::ranges::find_if_not(photos, has_minus);
    if (unsigned_photo == photos.end()) return;
    const std::string start = before_number(*unsigned_photo);
    const bool one_series = std::ranges::all_of(photos, [&](const std::filesystem::path& photo) {
        return before_number(photo) == start || before_number(photo) == start + '-';
    });
    if (!one_series) return;
    const auto positive = std::stable_partition(photos.begin(), photos.end(), has_minus);
    std::reverse(photos.begin(), positive);
}

bool is_image_name(const std::filesystem::path& name) {
    return extension_of(name) < kExtensions.size();
}

void set_working_size(PhotoFolder& folder, int max_side_px) {
    folder.width = folder.shown_width;
    folder.height = folder.shown_height;
    folder.reduction = photo_reduction(folder.width, folder.height, max_side_px);
    if (folder.reduction == 1) return;
    // The reduction of a thin photo is limited so that each side keeps at least one pixel.
    folder.reduction = std::min(folder.reduction, static_cast<double>(std::min(folder.width, folder.height)));
    const auto whole = [&](int side) { return static_cast<int>(side / folder.reduction + 1e-9); };
    folder.width = whole(folder.width);
    folder.height = whole(folder.height);
}

std::string size_text(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

Error ambiguous_orientation_error(const PhotoFolder& folder, const std::string& other) {
    const std::string states = folder.has_several_orientations()
                                   ? "the photos have several EXIF orientations"
                                   : "the photos' EXIF orientation is " + std::to_string(folder.orientation);
    return Error{other + ": " + states +
                 ", so it is ambiguous whether the file refers to the stored or the displayed pixels; rotate the "
                 "pixels first, e.g. with exiftran -ai or mogrify -auto-orient, and then create the file again"};
}

std::vector<std::string> file_names(const PhotoFolder& folder) {
    std::vector<std::string> names;
    for (const std::filesystem::path& photo : folder.photos) names.push_back(photo.filename().string());
    return names;
}

Result<PhotoFolder> open_photo_files(std::vector<std::filesystem::path> photos, const std::string& where,
                                     int max_side_px) {
    RS_CHECK(max_side_px >= kMinSide_px && max_side_px <= kMaxImageSide_px);
    PhotoFolder found;
    found.photos = std::move(photos);
    if (found.photos.size() > static_cast<std::size_t>(kMaxViews)) {
        return Error{where + ": holds " + std::to_string(found.photos.size()) + " images; at most " +
                     std::to_string(kMaxViews) + " can be imported"};
    }
    RS_TRY(read_headers(found));
    set_working_size(found, max_side_px);
    return found;
}

Result<PhotoFolder> open_photo_folder(const std::filesystem::path& folder, int max_side_px) {
    std::error_code failure;
    std::filesystem::directory_iterator entries(folder, failure);
    if (failure) {
        return Error{folder.string() + ": cannot be listed (" + failure.message() + "); give a folder of images"};
    }
    PhotoFolder found;
    for (const std::filesystem::directory_iterator end; entries != end; entries.increment(failure)) {
        const std::filesystem::path& path = entries->path();
        const std::string name = path.filename().string();
        if (name.starts_with(".")) continue;
        std::error_code ignored;
        if (entries->is_regular_file(ignored) && is_image_name(path)) {
            found.photos.push_back(path);
        } else {
            found.ignored.push_back(name);
        }
        if (failure) break;
    }
    if (failure) return Error{folder.string() + ": listing stopped (" + failure.message() + "); check the disk"};
    if (found.photos.empty()) {
        const std::size_t count = found.ignored.size();
        const std::string more = count > 1 ? " and " + std::to_string(count - 1) + " more" : "";
        return Error{folder.string() + ": holds no images" +
                     (count > 0 ? ", but " + *std::ranges::min_element(found.ignored) + more : "") +
                     "; give a folder of PNG, JPEG, TIFF, WebP or HEIC "
                     "files (a camera's raw files must be developed first)"};
    }
    sort_photos(found.photos);
    keep_one_format(found);
    std::sort(found.ignored.begin(), found.ignored.end());
    RS_ASSIGN_OR_RETURN(PhotoFolder opened, open_photo_files(std::move(found.photos), folder.string(), max_side_px));
    opened.ignored = std::move(found.ignored);
    opened.in_other_formats = std::move(found.in_other_formats);
    return opened;
}

Image<Rgba8> apply_orientation(Image<Rgba8> stored, int orientation) {
    RS_CHECK(orientation >= 1 && orientation <= 8);
    if (orientation == 1) return stored;
    // TIFF 6.0, tag Orientation: position of the stored first row and column in the upright image.
    const bool swapped = orientation >= 5;
    const bool right_to_left = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool bottom_up = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    const int width = swapped ? stored.height() : stored.width();
    const int height = swapped ? stored.width() : stored.height();
    Image<Rgba8> upright(width, height);
    for (int y = 0; y < stored.height(); ++y) {
        for (int x = 0; x < stored.width(); ++x) {
            const int column = swapped ? y : x;
            const int row = swapped ? x : y;
            upright(right_to_left ? width - 1 - column : column, bottom_up ? height - 1 - row : row) = stored(x, y);
        }
    }
    return upright;
}

Image<Rgba8> to_working_size(Image<Rgba8> upright, const PhotoFolder& folder) {
    RS_CHECK(upright.width() == folder.shown_width && upright.height() == folder.shown_height);
    return folder.reduction > 1 ? reduced_in_linear_light(upright, folder.width, folder.height, folder.reduction)
                                : std::move(upright);
}

Result<Image<Rgba8>> read_photo(const PhotoFolder& folder, std::size_t i) {
    Result<Image<Rgba8>> stored = read_image(folder.photos[i], kMaxPhotoSide_px);
    if (!stored) return stored;
    Image<Rgba8> upright = apply_orientation(std::move(*stored), folder.orientation_of(i));
    if (upright.width() != folder.shown_width || upright.height() != folder.shown_height) {
        return Error{folder.photos[i].string() + ": changed while it was imported; import again"};
    }
    return to_working_size(std::move(upright), folder);
}

}  // namespace rs::capture
