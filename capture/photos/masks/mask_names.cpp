#include "capture/photos/masks/mask_names.hpp"

#include "rayspace/file/input_file.hpp"

#include <algorithm>
#include <system_error>

namespace rs::capture {
namespace {

std::size_t extension_rank(const std::filesystem::path& file) {
    return static_cast<std::size_t>(std::ranges::find(kMaskExtensions, lower_case_extension(file)) -
                                    kMaskExtensions.begin());
}

bool equals_ignoring_case(std::string_view a, std::string_view lower_case) {
    return std::ranges::equal(a, lower_case, [](char x, char y) {
        return (x >= 'A' && x <= 'Z' ? static_cast<char>(x - 'A' + 'a') : x) == y;
    });
}

// "a_Mask" becomes "a_mask", so that one look-up finds both.
std::string with_lower_case_marker(std::string stem) {
    constexpr std::string_view kPrefix = "mask_";
    if (stem.size() > kPrefix.size() &&
        equals_ignoring_case(std::string_view(stem).substr(0, kPrefix.size()), kPrefix)) {
        stem.replace(0, kPrefix.size(), kPrefix);
    }
    for (const std::string_view suffix : {"_mask", "-mask", ".mask"}) {
        if (stem.size() <= suffix.size()) continue;
        const std::size_t at = stem.size() - suffix.size();
        if (equals_ignoring_case(std::string_view(stem).substr(at), suffix)) stem.replace(at, suffix.size(), suffix);
    }
    return stem;
}

}  // namespace

Result<MaskNames> MaskNames::list(const std::filesystem::path& folder) {
    MaskNames names;
    std::error_code failure;
    for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        const std::filesystem::path& file = entry->path();
        const std::size_t rank = extension_rank(file);
        std::error_code ignored;
        if (file.filename().string().front() == '.' || rank == kMaskExtensions.size() || entry->is_directory(ignored)) {
            continue;
        }
        // If names differ in the case of the extension only, takes the first in byte order, whatever the disk's order.
        std::filesystem::path& known = names.files_[with_lower_case_marker(file.stem().string())][rank];
        if (known.empty() || file < known) known = file;
    }
    if (failure)
        return Error{folder.string() + ": cannot be listed (" + failure.message() + "); give a folder of masks"};
    return names;
}

std::vector<std::filesystem::path> MaskNames::masks_of(const std::filesystem::path& photo) const {
    std::vector<std::filesystem::path> masks;
    const auto add = [&](const std::filesystem::path& mask) {
        std::error_code ignored;
        if (std::ranges::find(masks, mask) == masks.end() && !std::filesystem::equivalent(mask, photo, ignored)) {
            masks.push_back(mask);
        }
    };
    const auto add_all = [&](const std::string& stem) {
        const auto found = files_.find(with_lower_case_marker(stem));
        if (found == files_.end()) return;
        for (const auto& [rank, file] : found->second) add(file);
    };
    const std::string stem = photo.stem().string();
    if (const auto same = files_.find(with_lower_case_marker(stem)); same != files_.end()) {
        const auto file = same->second.find(extension_rank(photo));
        if (file != same->second.end()) add(file->second);
    }
    add_all(stem);
    add_all(photo.filename().string());
    for (const char* suffix : {"_mask", "-mask", ".mask"}) add_all(stem + suffix);
    add_all("mask_" + stem);
    return masks;
}

}  // namespace rs::capture
