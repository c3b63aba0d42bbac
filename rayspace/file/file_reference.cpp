#include "rayspace/file/file_reference.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

std::string with_slashes(std::string text) {
    std::ranges::replace(text, '\\', '/');
    return text;
}

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Scheme of another host or of embedded data; a single letter is a drive of Windows.
bool is_remote(std::string_view reference) {
    const std::size_t colon = reference.find(':');
    return colon != std::string_view::npos && colon > 1 && reference.find_first_of("/\\") > colon;
}

// Existing file whose path differs from `path` in letter case only.
std::optional<fs::path> match_any_case(const fs::path& path) {
    fs::path found;
    for (const fs::path& part : path) {
        std::error_code failed;
        if (part == "." || part == ".." || part == "/" || fs::exists(found / part, failed)) {
            found /= part;
            continue;
        }
        const std::string wanted = lower_case(part.string());
        std::optional<fs::path> match;
        for (fs::directory_iterator at(found.empty() ? fs::path(".") : found, failed), end; !failed && at != end;
             at.increment(failed)) {
            if (lower_case(at->path().filename().string()) == wanted) match = found / at->path().filename();
        }
        if (!match) return std::nullopt;
        found = *match;
    }
    return is_file(found) ? std::optional(found) : std::nullopt;
}

}  // namespace

std::optional<fs::path> resolve_reference(std::string_view reference, const fs::path& folder) {
    for (const std::string_view scheme : {"file://", "file:"}) {
        if (!reference.starts_with(scheme)) continue;
        reference.remove_prefix(scheme.size());
        break;
    }
    if (is_remote(reference)) return std::nullopt;
    const std::string written(reference);
    const std::string decoded = decode_uri(reference);
    if (decoded.empty() || decoded.find('\0') != std::string::npos) return std::nullopt;
    const std::vector<std::string> spellings = {written, decoded, with_slashes(written), with_slashes(decoded)};
    for (const std::string& spelling : spellings) {
        if (is_file(folder / spelling)) return (folder / spelling).lexically_normal();
    }
    for (const std::string& spelling : spellings) {
        if (auto match = match_any_case((folder / spelling).lexically_normal())) return match;
    }
    for (const std::string& spelling : {with_slashes(written), with_slashes(decoded)}) {
        for (std::size_t slash = spelling.find('/'); slash != std::string::npos;
             slash = spelling.find('/', slash + 1)) {
            const fs::path end = folder / spelling.substr(slash + 1);
            if (is_file(end)) return end.lexically_normal();
        }
    }
    return (folder / decoded).lexically_normal();
}

std::string decode_uri(std::string_view uri) {
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        const std::string_view digits = uri[i] == '%' ? uri.substr(i + 1, 2) : std::string_view();
        const bool escaped =
            digits.size() == 2 && std::from_chars(digits.data(), digits.data() + 2, code, 16).ptr == digits.data() + 2;
        decoded += escaped ? static_cast<char>(code) : uri[i];
        if (escaped) i += 2;
    }
    return decoded;
}

}  // namespace rs
