#include "capture/photos/masks/mask_folder.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/masks/mask_names.hpp"
#include "capture/photos/masks/mask_statistics.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <utility>

namespace rs::capture {
namespace {

constexpr int kObjectFrom = 128;  // least code that counts as object
// Tolerances, as shares of the photo's sides.
constexpr double kMinMaskScale = 1.0 / 16;
constexpr double kMaxMaskScale = 2;

// "3 of 12 masks (first 004.png)"; nullopt if there are none.
std::optional<std::string> count_text(const std::vector<std::filesystem::path>& files,
                                      const std::function<bool(std::size_t)>& holds) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = files.size(); i-- > 0;) {
        if (!holds(i)) continue;
        ++count;
        first = i;
    }
    if (count == 0) return std::nullopt;
    return std::to_string(count) + " of " + std::to_string(files.size()) + " masks (first " +
           files[first].filename().string() + ")";
}

// Has the aspect ratio of the photo within a pixel, and a size that can be resized to it.
bool is_scaled_photo(int width, int height, int photo_width, int photo_height) {
    const double by_width = static_cast<double>(width) / photo_width;
    const double by_height = static_cast<double>(height) / photo_height;
    const bool has_aspect_ratio =
        std::abs(height - by_width * photo_height) <= 1 || std::abs(width - by_height * photo_width) <= 1;
    return has_aspect_ratio && std::min(by_width, by_height) >= kMinMaskScale &&
           std::max(by_width, by_height) <= kMaxMaskScale;
}

// Pixels of a histogram that become object.
std::uint64_t object_pixels(const CodeHistogram& histogram, const std::array<std::uint8_t, 256>& mask_by_code) {
    std::uint64_t pixels = 0;
    for (std::size_t code = 0; code < histogram.size(); ++code) {
        if (mask_by_code[code] >= kObjectFrom) pixels += histogram[code];
    }
    return pixels;
}

// The least code that becomes object where masks are not inverted.
int least_white(int white) {
    return (kObjectFrom * white + 254) / 255;
}

}  // namespace

struct MaskFolder::Survey {
    std::vector<MaskStatistics> masks;  // [photo]

    [[nodiscard]] static const ChannelStatistics& channel(const MaskStatistics& mask, bool alpha) {
        return alpha ? mask.alpha : mask.grey;
    }
    [[nodiscard]] CodeHistogram total(bool alpha) const {
        CodeHistogram sum{};
        for (const MaskStatistics& mask : masks) {
            const CodeHistogram& one = channel(mask, alpha).whole;
            for (std::size_t code = 0; code < sum.size(); ++code) sum[code] += one[code];
        }
        return sum;
    }
};

Status MaskFolder::find_files(const std::filesystem::path& folder, const PhotoFolder& photos) {
    RS_ASSIGN_OR_RETURN(const MaskNames names, MaskNames::list(folder));
    std::vector<std::string> missing;
    std::size_t ambiguous = 0;
    std::string first_choice;
    for (const std::filesystem::path& photo : photos.photos) {
        const std::vector<std::filesystem::path> masks = names.masks_of(photo);
        if (masks.empty()) {
            missing.push_back(photo.filename().string());
            continue;
        }
        if (masks.size() > 1 && ambiguous++ == 0) {
            first_choice = masks[0].filename().string() + ", not " + masks[1].filename().string();
        }
        files_.push_back(masks.front());
    }
    if (!missing.empty()) {
        const std::string stem = std::filesystem::path(missing.front()).stem().string();
        return Error{printable(folder.string() + ": has no mask for " + std::to_string(missing.size()) + " of " +
                               std::to_string(photos.photos.size()) + " photos, the first is " + missing.front() +
                               "; add " + stem + ".png, " + missing.front() + ".png or " + stem +
                               "_mask.png, white where the object is")};
    }
    if (ambiguous > 0) {
        notes_.push_back(printable(std::to_string(ambiguous) + " of " + std::to_string(files_.size()) +
                                   " photos have several masks in " + folder.string() + "; used: " + first_choice));
    }
    return {};
}

Status MaskFolder::check_sizes(const std::filesystem::path& folder, const PhotoFolder& photos) {
    for (std::size_t i = 0; i < files_.size(); ++i) {
        RS_ASSIGN_OR_RETURN(const ImageInfo info, read_image_info(files_[i], kMaxPhotoSide_px));
        sizes_.push_back({info.width, info.height});
        if (is_scaled_photo(info.width, info.height, shown_.width, shown_.height)) continue;
        const bool is_turned = info.width == shown_.height && info.height == shown_.width;
        return Error{printable(files_[i].string() + ": is " + size_text(info.width, info.height) + ", its photo " +
                               photos.photos[i].filename().string() + " is shown in " +
                               size_text(shown_.width, shown_.height) + "; " +
                               (is_turned ? "turn the masks by 90 degrees, as EXIF states for the photos"
                                          : "masks must have the photos' size, or their aspect ratio and 1/16 to 2 "
                                            "times their size"))};
    }
    const auto is_resized = [&](std::size_t i) { return sizes_[i] != shown_; };
    if (const auto count = count_text(files_, is_resized)) {
        const auto first = std::ranges::find_if(sizes_, [&](const Size& size) { return size != shown_; });
        notes_.push_back(printable(folder.string() + ": " + *count + " are " + size_text(first->width, first->height) +
                                   "; resized to " + size_text(shown_.width, shown_.height)));
    }
    return {};
}

Status MaskFolder::choose_channel(const std::filesystem::path& folder, const Survey& survey) {
    const auto transparent = count_text(files_, [&](std::size_t i) { return has_transparency(survey.masks[i]); });
    if (transparent) {
        if (const auto opaque = count_text(files_, [&](std::size_t i) { return !has_transparency(survey.masks[i]); })) {
            return Error{printable(folder.string() + ": " + *transparent + " are transparent in places, " + *opaque +
                                   " are opaque; give masks of one kind")};
        }
        reads_alpha_ = true;
        notes_.push_back(printable(folder.string() + ": masks are transparent in places; read by their alpha"));
        return {};
    }
    if (const auto photos = count_text(files_, [&](std::size_t i) { return is_photo(survey.masks[i]); })) {
        return Error{
            printable(folder.string() + ": " + *photos +
                      " look like photos, not masks; give black and white masks, or foreground images as PNG with "
                      "transparency")};
    }
    return {};
}

void MaskFolder::choose_codes(const std::filesystem::path& folder, const Survey& survey) {
    int white = two_level_white(survey.total(reads_alpha_));
    // With one grey besides black the object may be half transparent everywhere; a bright one counts as object anyway.
    if (white != 1 && (kind_ == MaskKind::kAlpha || white >= kObjectFrom)) white = 255;
    if (white != 255) {
        notes_.push_back(printable(folder.string() + ": masks hold 0 and " + std::to_string(white) + " only; " +
                                   std::to_string(white) + " is read as white"));
    }
    const auto is_inverted = [&](std::size_t i) {
        return looks_inverted(Survey::channel(survey.masks[i], reads_alpha_), least_white(white));
    };
    std::size_t inverted = 0;
    for (std::size_t i = 0; i < files_.size(); ++i) inverted += is_inverted(i) ? 1 : 0;
    const bool invert = inverted * 2 > files_.size();
    if (invert) {
        notes_.push_back(printable(folder.string() + ": masks are black where the object is; inverted"));
    }
    if (const auto others = count_text(files_, [&](std::size_t i) { return is_inverted(i) != invert; });
        others && inverted > 0) {
        notes_.push_back(printable(folder.string() + ": " + *others + (invert ? " do not look" : " look") +
                                   " inverted, unlike the others; check them"));
    }
    for (int code = 0; code < 256; ++code) {
        const int scaled = std::min(255, (code * 255 + white / 2) / white);
        mask_by_code_[static_cast<std::size_t>(code)] = static_cast<std::uint8_t>(invert ? 255 - scaled : scaled);
    }
}

Status MaskFolder::check_content(const std::filesystem::path& folder, const Survey& survey) const {
    const auto object = [&](std::size_t i) {
        return object_pixels(Survey::channel(survey.masks[i], reads_alpha_).whole, mask_by_code_);
    };
    const auto refused = [&](const std::string& what) {
        return Error{printable(folder.string() + ": " + what +
                               "; mark the object white and all else black, or take the photos out")};
    };
    if (const auto black = count_text(files_, [&](std::size_t i) { return object(i) == 0; })) {
        return refused(*black + " have no white pixel");
    }
    if (const auto white = count_text(files_, [&](std::size_t i) { return object(i) == survey.masks[i].pixels; })) {
        return refused(*white + " have no black pixel");
    }
    return {};
}

void MaskFolder::note_grey(const std::filesystem::path& folder, const Survey& survey) {
    constexpr int kLeastGrey = 16, kMostGrey = 239;
    constexpr double kMuch = 0.05;  // more than what antialiased edges take
    if (kind_ != MaskKind::kBinary) return;
    const CodeHistogram total = survey.total(reads_alpha_);
    std::uint64_t grey = 0;
    for (std::size_t code = 0; code < total.size(); ++code) {
        if (mask_by_code_[code] >= kLeastGrey && mask_by_code_[code] <= kMostGrey) grey += total[code];
    }
    const double share = static_cast<double>(grey) / static_cast<double>(pixels_from(total, 0));
    if (share <= kMuch) return;
    notes_.push_back(printable(folder.string() + ": " + std::to_string(std::lround(100 * share)) +
                               " % of the masks are grey; codes from 128 are read as object. If grey is the "
                               "object's alpha, give --masks-alpha"));
}

Result<MaskFolder> MaskFolder::open(const std::filesystem::path& folder, const PhotoFolder& photos, MaskKind kind,
                                    Progress* progress) {
    RS_CHECK(!photos.photos.empty() && photos.shown_width > 0 && photos.shown_height > 0);
    MaskFolder masks;
    masks.kind_ = kind;
    RS_TRY(masks.find_files(folder, photos));
    RS_TRY(masks.load(folder, photos, progress));
    return masks;
}

Result<MaskFolder> MaskFolder::open_files(std::vector<std::filesystem::path> files, const std::filesystem::path& where,
                                          const PhotoFolder& photos, MaskKind kind, Progress* progress) {
    RS_CHECK(!files.empty() && files.size() == photos.photos.size());
    MaskFolder masks;
    masks.kind_ = kind;
    masks.files_ = std::move(files);
    RS_TRY(masks.load(where, photos, progress));
    return masks;
}

// Surveys the masks of files_ and chooses their interpretation.
Status MaskFolder::load(const std::filesystem::path& folder, const PhotoFolder& photos, Progress* progress) {
    shown_ = {photos.shown_width, photos.shown_height};
    RS_TRY(check_sizes(folder, photos));

    Survey survey{std::vector<MaskStatistics>(files_.size())};
    // for_each_photo() is given bytes per pixel of the working size; masks are read in their own size.
    double most_pixels = 0;
    for (const Size& size : sizes_) most_pixels = std::max(most_pixels, 1.0 * size.width * size.height);
    const double bytes_per_px = std::ceil(kReadBytesPerPixel * most_pixels / (1.0 * photos.width * photos.height));
    RS_TRY(for_each_photo(photos, static_cast<int>(std::min(bytes_per_px, 1e9)), "reading masks", progress,
                          [&](std::size_t i) -> Status {
                              RS_ASSIGN_OR_RETURN(const auto mask, read_image(files_[i], kMaxPhotoSide_px));
                              survey.masks[i] = mask_statistics(mask);
                              return {};
                          }));
    RS_TRY(choose_channel(folder, survey));
    choose_codes(folder, survey);
    RS_TRY(check_content(folder, survey));
    note_grey(folder, survey);
    return {};
}

Result<Image<std::uint8_t>> MaskFolder::read(std::size_t i) const {
    RS_CHECK(i < files_.size());
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> stored, read_image(files_[i], kMaxPhotoSide_px));
    if (stored.width() != sizes_[i].width || stored.height() != sizes_[i].height) {
        return Error{printable(files_[i].string() + ": has changed its size to " +
                               size_text(stored.width(), stored.height()) + " while it was in use; run again")};
    }
    Image<std::uint8_t> mask(stored.width(), stored.height());
    for (std::size_t p = 0; p < mask.pixels().size(); ++p) {
        const Rgba8& pixel = stored.pixels()[p];
        mask.pixels()[p] = mask_by_code_[reads_alpha_ ? pixel.a : mask_grey(pixel)];
    }
    if (sizes_[i] != shown_) {
        Image<std::uint8_t> resized(shown_.width, shown_.height);
        cv::Mat1b to(shown_.height, shown_.width, resized.data());
        const bool is_smaller = shown_.width < mask.width() && shown_.height < mask.height();
        cv::resize(mat_view(mask), to, to.size(), 0, 0, is_smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
        mask = std::move(resized);
    }
    if (kind_ == MaskKind::kBinary) {
        for (std::uint8_t& code : mask.pixels()) code = code >= kObjectFrom ? 255 : 0;
    }
    return mask;
}

}  // namespace rs::capture
