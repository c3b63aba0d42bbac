#include "capture/tools/kept_input.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

namespace rs::capture {

namespace {

// Where `path` is once links are followed, and where its name is, which differs where it is a link itself.
std::vector<std::filesystem::path> places_of(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::filesystem::path plain = path.has_filename() ? path : path.parent_path();  // "set/" is "set"
    const std::filesystem::path folder = plain.has_parent_path() ? plain.parent_path() : std::filesystem::path(".");
    return {std::filesystem::weakly_canonical(plain, ignored),
            std::filesystem::weakly_canonical(folder, ignored) / plain.filename()};
}

bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

Status check_output_keeps(const std::filesystem::path& output, const std::filesystem::path& input) {
    if (input.empty()) return {};
    for (const std::filesystem::path& folder : places_of(output)) {
        for (const std::filesystem::path& place : places_of(input)) {
            if (!is_within(place, folder)) continue;
            return Error{output.string() + ": writing the set would replace this folder and " + input.string() +
                         " with it; give another -o"};
        }
    }
    return {};
}

}  // namespace rs::capture
