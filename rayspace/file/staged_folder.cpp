#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/folder_list.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/file/staging.hpp"

#include <xxhash.h>

#include <cerrno>
#include <cstdio>
#include <iterator>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <utility>

namespace rs {
namespace fs = std::filesystem;
using namespace staging;
namespace {

// A folder path may end in a slash; its name is what stands before it.
fs::path without_trailing_slash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

void remove_quietly(const fs::path& path) {
    std::error_code ignored;
    fs::remove_all(path, ignored);
}

// Says what a folder that we made holds, "# CONTENTS" on its first line (not before 0.38), and lists its files,
// "XXH64 NAME" to a line, so that a later commit() can see what it may replace: a file that was added or changed since
// is somebody's work, and what another tool made is no older version of this.
constexpr const char* kManifest = ".rayspace-files";
constexpr std::uint64_t kManifestCap_bytes = 64 << 20;
constexpr std::uint64_t kLargestFile_bytes = std::uint64_t{4} << 30;

// Every file below `folder`, as relative paths; folders do not count.
Result<std::set<std::string>> files_below(const fs::path& folder) {
    std::set<std::string> files;
    std::error_code error;
    for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::recursive_directory_iterator();
         at.increment(error)) {
        if (at->is_directory(error) && !at->is_symlink(error)) continue;
        files.insert(at->path().lexically_relative(folder).string());
    }
    if (error) return failure(folder, "cannot be looked into", error.value());
    return files;
}

Result<std::string> manifest_line(const fs::path& folder, const std::string& file) {
    const auto bytes = read_old_file(folder / file, kLargestFile_bytes);
    if (!bytes) return bytes.error();
    char sum[32];
    std::snprintf(sum, sizeof sum, "%016llx ", static_cast<unsigned long long>(XXH64(bytes->data(), bytes->size(), 0)));
    return sum + file + '\n';
}

constexpr const char* kContents = "# ";

Status write_manifest(const fs::path& folder, const std::string& contents) {
    const Result<std::set<std::string>> files = files_below(folder);
    if (!files) return files.error();
    std::string text = kContents + contents + '\n';
    for (const std::string& file : *files) {
        const Result<std::string> line = manifest_line(folder, file);
        if (!line) return line.error();
        text += *line;
    }
    Result<StagedFile> manifest = StagedFile::create(folder / kManifest);
    if (!manifest) return manifest.error();
    if (Status written = manifest->write(std::as_bytes(std::span(text))); !written) return written;
    return manifest->commit();
}

struct Manifest {
    std::string contents;         // empty: it does not say
    std::set<std::string> files;  // lines as of manifest_line()
};

Result<Manifest> read_manifest(const fs::path& folder) {
    const auto bytes = read_old_file(folder / kManifest, kManifestCap_bytes);
    if (!bytes) return bytes.error();
    Manifest manifest;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kContents)) {
            manifest.contents = line.substr(std::char_traits<char>::length(kContents));
        } else {
            manifest.files.insert(line + '\n');
        }
    }
    return manifest;
}

// What commit() may replace: nothing, an empty folder, or one of ours, with the same contents if they are known, to
// which nobody has added anything.
Status check_replaceable(const fs::path& path, const std::string& contents) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(path, error);
    if (status.type() == fs::file_type::not_found) return {};
    if (error) return failure(path, "cannot be looked at", error.value());
    if (!fs::is_directory(status)) {
        return Error{path.string() + ": is there already and is not a folder; remove it or choose another name"};
    }
    Result<std::set<std::string>> files = files_below(path);
    if (!files) return files.error();
    Manifest ours;
    if (files->erase(kManifest) != 0) {
        Result<Manifest> manifest = read_manifest(path);
        if (!manifest) return manifest.error();
        ours = std::move(*manifest);
    }
    for (auto file = files->begin(); file != files->end();) {
        const Result<std::string> line = manifest_line(path, *file);
        file = line && ours.files.contains(*line) ? files->erase(file) : std::next(file);
    }
    if (files->empty()) {
        if (contents.empty() || ours.contents.empty() || ours.contents == contents) return {};
        return Error{path.string() + ": holds " + printable(ours.contents) + ", which " + contents +
                     " do not replace; choose another name, or remove it first"};
    }
    return Error{path.string() + ": holds files that were added or changed by hand, such as " + *files->begin() +
                 ", and is left alone; choose another name or move them away"};
}

}  // namespace

Result<StagedFolder> StagedFolder::create(const fs::path& given, std::string contents) {
    RS_CHECK(!contents.empty());
    const fs::path path = without_trailing_slash(given);
    if (const Status parent = check_parent(path); !parent) return parent.error();
    if (Status replaceable = check_replaceable(path, contents); !replaceable) return replaceable.error();
    if (Status kept = check_keeps_inputs(path); !kept) return kept.error();
    remove_left_behind(path);
    StagedFolder folder;
    folder.path_ = path;
    folder.contents_ = std::move(contents);
    folder.temporary_ = temporary_name(path);
    std::error_code error;
    if (!fs::create_directory(folder.temporary_, error)) {
        folder.temporary_.clear();
        return failure(path, "cannot be created", error ? error.value() : EEXIST);
    }
    remember(folder.temporary_);
    return folder;
}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : path_(std::move(other.path_)), contents_(std::move(other.contents_)), temporary_(std::move(other.temporary_)) {
    other.temporary_.clear();
}

StagedFolder& StagedFolder::operator=(StagedFolder&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(contents_, other.contents_);
    std::swap(temporary_, other.temporary_);
    return *this;
}

StagedFolder::~StagedFolder() {
    if (temporary_.empty()) return;
    remove_quietly(temporary_);
    forget(temporary_);
}

fs::path list_of_files(const fs::path& folder) {
    return folder / kManifest;
}

Result<std::vector<std::string>> listed_files(const fs::path& folder) {
    const Result<Manifest> manifest = read_manifest(folder);
    if (!manifest) return manifest.error();
    std::vector<std::string> names;
    for (const std::string& line : manifest->files) {
        const std::size_t name = line.find(' ') + 1;  // the line ends in '\n'
        names.push_back(line.substr(name, line.size() - 1 - name));
    }
    return names;
}

Status move_into_place(const fs::path& from, const fs::path& to) {
    if (Status parent = check_parent(to); !parent) return parent;
    std::error_code ignored;
    const bool folder = fs::is_directory(from, ignored);
    if (folder) {
        const Result<Manifest> ours =
            fs::exists(from / kManifest, ignored) ? read_manifest(from) : Result<Manifest>(Manifest{});
        if (!ours) return ours.error();
        if (Status replaceable = check_replaceable(to, ours->contents); !replaceable) return replaceable;
    } else if (fs::exists(to, ignored) && !fs::is_regular_file(to, ignored)) {
        return Error{to.string() + ": is there already and is no file; remove it or choose another name"};
    }
    if (Status kept = check_keeps_inputs(to); !kept) return kept;
    const bool exchanged = folder && fs::exists(fs::symlink_status(to, ignored));
    if (const int error = put_in_place(from, to, exchanged); error != 0) {
        return failure(to, "cannot be put in place", error);
    }
    sync_folder_of(to);
    if (exchanged) remove_quietly(from);
    return {};
}

Status StagedFolder::commit() {
    RS_CHECK(!temporary_.empty());
    // Somebody may have filled the folder since create().
    if (Status replaceable = check_replaceable(path_, contents_); !replaceable) return replaceable;
    if (Status kept = check_keeps_inputs(path_); !kept) return kept;

    if (Status listed = write_manifest(temporary_, contents_); !listed) return listed;

    // What stands there with files in it cannot be renamed over; the two change places, so that at every moment one
    // whole folder bears the name.
    std::error_code ignored;
    const bool exchanged = fs::exists(fs::symlink_status(path_, ignored));
    int error = put_in_place(temporary_, path_, exchanged);
    if (exchanged && (error == EINVAL || error == ENOSYS)) {
        return Error{
            path_.string() +
            ": cannot be replaced, for this file system cannot exchange two folders; remove it first, or write "
            "elsewhere"};
    }
    if (error != 0) return failure(path_, "cannot be put in place", error);
    sync_folder_of(path_);
    if (exchanged) {
        remove_quietly(temporary_);
        forget(temporary_);
    }
    temporary_.clear();
    return {};
}

}  // namespace rs
