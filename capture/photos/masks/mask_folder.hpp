#pragma once
// Masks supplied with the photos (rs-capture import --masks): finds the mask of each photo, determines how the folder
// is to be interpreted, and returns the masks in the photos' size.
//
// File names: mask_names.hpp. The interpretation is determined once, over all masks:
//
//   channel    alpha if masks have transparent pixels (foreground images); otherwise the largest of red, green and
//              blue.
//   white      255; if all masks hold only 0 and one other code (0 and 1, labels of a palette), that code.
//   inverted   if most masks are white at the border and black in the centre.
//   size       that of the displayed photo, or 1/16 to 2 times it with the same aspect ratio within a pixel: such masks
//              are resized.
//
// Interpretations that are not obvious are reported by notes(). The EXIF orientation of a mask is not applied.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

enum class MaskKind {
    kBinary,  ///< object or background; the soft edge is still to be estimated
    kAlpha,   ///< grey is the final alpha
};

class MaskFolder {
public:
    /// Finds the mask of every photo and reads each once, as many at a time as for_each_photo() allows.
    ///
    /// \param folder the masks.
    /// \param photos names and shown size of the photos.
    /// \param kind   what read() is to give.
    /// \return an error where photos have no mask (how many, and the first), where a mask has another size, is a photo,
    ///         or is all black or all white, where some masks are transparent and others are not, and those of
    ///         read_image().
    static Result<MaskFolder> open(const std::filesystem::path& folder, const PhotoFolder& photos, MaskKind kind,
                                   Progress* progress = nullptr);

    /// The same with given files, `files[i]` for photo i; `where` names their list in messages.
    static Result<MaskFolder> open_files(std::vector<std::filesystem::path> files, const std::filesystem::path& where,
                                         const PhotoFolder& photos, MaskKind kind, Progress* progress = nullptr);

    /// The mask of photo i, photos.shown_width x photos.shown_height: 255 where the object is and 0 elsewhere, nothing
    /// between for kBinary (a code of 128 counts as object). Thread-safe. Memory: that of read_image() and the mask.
    /// \return the errors of read_image(), and one where the file has changed its size since open().
    [[nodiscard]] Result<Image<std::uint8_t>> read(std::size_t i) const;

    [[nodiscard]] MaskKind kind() const { return kind_; }
    [[nodiscard]] std::size_t size() const { return files_.size(); }
    /// The mask file of photo i.
    [[nodiscard]] const std::filesystem::path& file(std::size_t i) const { return files_[i]; }
    /// One line each, for the user: how the masks were interpreted, where that is not obvious.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

private:
    struct Size {
        int width = 0;
        int height = 0;
        bool operator==(const Size&) const = default;
    };
    struct Survey;

    Status find_files(const std::filesystem::path& folder, const PhotoFolder& photos);
    Status load(const std::filesystem::path& folder, const PhotoFolder& photos, Progress* progress);
    Status check_sizes(const std::filesystem::path& folder, const PhotoFolder& photos);
    Status choose_channel(const std::filesystem::path& folder, const Survey& survey);
    void choose_codes(const std::filesystem::path& folder, const Survey& survey);
    [[nodiscard]] Status check_content(const std::filesystem::path& folder, const Survey& survey) const;
    void note_grey(const std::filesystem::path& folder, const Survey& survey);

    MaskKind kind_ = MaskKind::kBinary;
    Size shown_;
    std::vector<std::filesystem::path> files_;  // [photo]
    std::vector<Size> sizes_;                   // [photo], of the files
    bool reads_alpha_ = false;
    std::array<std::uint8_t, 256> mask_by_code_{};  // white becomes 255, inverted masks are turned
    std::vector<std::string> notes_;
};

}  // namespace rs::capture
