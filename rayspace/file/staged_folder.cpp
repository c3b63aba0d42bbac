#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <utility>

namespace rs {
namespace fs = std::filesystem;
namespace {

constexpr const char* kMarker = ".rayspace-folder";
constexpr std::uint64_t kMarkerCap_bytes = 64 << 20;

fs::path without_trailing_slash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

// Relative paths of all files below `folder`.
Result<std::set<std::string>> files_below(const fs::path& folder) {
    std::set<std::string> files;
    std::error_code error;
    for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::recursive_directory_iterator();
         at.increment(error)) {
        if (at->is_directory(error) && !at->is_symlink(error)) continue;
        files.insert(at->path().lexically_relative(folder).string());
    }
    if (error) return output_error(folder, "cannot be read", error.value());
    return files;
}

Status write_marker(const fs::path& folder, const std::string& contents) {
    RS_ASSIGN_OR_RETURN(const std::set<std::string> files, files_below(folder));
    std::string text = contents + '\n';
    for (const std::string& file : files) text += file + '\n';
    return write_file(folder / kMarker, text);
}

bool is_within(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// The path with links resolved, and the path with links resolved except for the last component.
std::vector<fs::path> possible_paths(const fs::path& given) {
    std::error_code ignored;
    const fs::path path = without_trailing_slash(given);
    if (path.filename() == "." || path.filename() == "..") return {fs::weakly_canonical(path, ignored)};
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    // weakly_canonical() does not follow a link whose target does not exist.
    const fs::path target = fs::is_symlink(path, ignored) ? folder / fs::read_symlink(path, ignored) : path;
    return {fs::weakly_canonical(target, ignored), fs::weakly_canonical(folder, ignored) / path.filename()};
}

Status check_replaceable(const fs::path& path, const std::string& contents, bool force) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(path, error);
    if (status.type() == fs::file_type::not_found) return {};
    if (error) return output_error(path, "cannot be read", error.value());
    if (!fs::is_directory(status)) {
        return Error{path.string() + ": is there already and is not a folder; remove it or choose another name"};
    }
    if (is_within(fs::current_path(error), fs::weakly_canonical(path, error))) {
        return Error{path.string() + ": contains the current folder and is not replaced; choose another name"};
    }
    if (force) return {};
    RS_ASSIGN_OR_RETURN(const std::set<std::string> files, files_below(path));
    if (files.empty()) return {};
    const std::string remedy = "; choose another name, or replace the folder with --force";
    std::set<std::string> ours{kMarker};
    std::string found_contents = contents;
    if (files.contains(kMarker)) {
        RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path / kMarker, kMarkerCap_bytes));
        std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        std::getline(lines, found_contents);
        for (std::string line; std::getline(lines, line);) ours.insert(line);
    }
    const auto other = std::ranges::find_if(files, [&](const std::string& file) { return !ours.contains(file); });
    if (other != files.end()) {
        return Error{path.string() + ": holds files that this program did not write, such as " + printable(*other) +
                     remedy};
    }
    if (found_contents == contents) return {};
    return Error{path.string() + ": holds " + printable(found_contents) + ", not " + contents + remedy};
}

}  // namespace

StagedFolder::StagedFolder(fs::path path, std::string contents, bool force, Temporary temporary)
    : path_(std::move(path)), contents_(std::move(contents)), force_(force), temporary_(std::move(temporary)) {}

Result<StagedFolder> StagedFolder::create(const fs::path& given, std::string contents, bool force) {
    RS_CHECK(!contents.empty());
    const fs::path path = without_trailing_slash(given);
    RS_TRY(check_replaceable(path, contents, force));
    RS_ASSIGN_OR_RETURN(Temporary temporary, Temporary::create(path, Temporary::Kind::kFolder));
    return StagedFolder(path, std::move(contents), force, std::move(temporary));
}

Status StagedFolder::commit() {
    RS_CHECK(temporary_.descriptor() >= 0);
    // Another process may have written to the folder since create().
    RS_TRY(check_replaceable(path_, contents_, force_));
    RS_TRY(write_marker(temporary_.path(), contents_));
    return temporary_.move_to(path_);
}

Status refuse_overwriting_inputs(const fs::path& output, const std::vector<fs::path>& others) {
    if (output.empty()) return {};
    for (const fs::path& other : others) {
        if (other.empty()) continue;
        std::error_code ignored;
        bool is_lost = fs::equivalent(output, other, ignored);
        for (const fs::path& folder : possible_paths(output)) {
            for (const fs::path& place : possible_paths(other)) is_lost = is_lost || is_within(place, folder);
        }
        if (!is_lost) continue;
        return Error{output.string() + ": would overwrite " + other.string() +
                     ", which this command also reads or writes; give another name"};
    }
    return {};
}

}  // namespace rs
