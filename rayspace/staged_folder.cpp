#include "rayspace/file_output.hpp"
#include "rayspace/staging.hpp"

#include <cerrno>
#include <cstdio>
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

// Empty, absent, or made by us: what commit() may replace.
Status check_replaceable(const fs::path& path, const std::string& marker) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(path, error);
    if (status.type() == fs::file_type::not_found) return {};
    if (error) return failure(path, "cannot be looked at", error.value());
    if (!fs::is_directory(status)) {
        return Error{path.string() + ": is there already and is not a folder; remove it or choose another name"};
    }
    const bool empty = fs::is_empty(path, error);
    if (error) return failure(path, "cannot be looked into", error.value());
    if (empty || fs::exists(path / marker, error)) return {};
    return Error{path.string() + ": is a folder with other contents (no " + marker +
                 " in it) and is left alone; choose another name or empty it first"};
}

}  // namespace

Result<StagedFolder> StagedFolder::create(const fs::path& given, const std::string& marker) {
    const fs::path path = without_trailing_slash(given);
    if (const Status parent = check_parent(path); !parent) return parent.error();
    if (const Status replaceable = check_replaceable(path, marker); !replaceable) return replaceable.error();
    StagedFolder folder;
    folder.path_ = path;
    folder.marker_ = marker;
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
    : path_(std::move(other.path_)), temporary_(std::move(other.temporary_)), marker_(std::move(other.marker_)) {
    other.temporary_.clear();
}

StagedFolder& StagedFolder::operator=(StagedFolder&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(temporary_, other.temporary_);
    std::swap(marker_, other.marker_);
    return *this;
}

StagedFolder::~StagedFolder() {
    if (temporary_.empty()) return;
    remove_quietly(temporary_);
    forget(temporary_);
}

Status StagedFolder::commit() {
    RS_CHECK(!temporary_.empty());
    // Somebody may have filled the folder since create().
    if (Status replaceable = check_replaceable(path_, marker_); !replaceable) return replaceable;

    fs::path old;
    std::error_code error;
    if (fs::exists(fs::symlink_status(path_, error))) {
        // A folder with files in it cannot be renamed over: the old one steps aside, and back if the new one cannot
        // come.
        old = temporary_name(path_);
        if (::rename(path_.c_str(), old.c_str()) != 0) return failure(path_, "cannot be replaced", errno);
    }
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
        const int rename_error = errno;
        if (!old.empty() && ::rename(old.c_str(), path_.c_str()) != 0) {
            return Error{path_.string() + ": cannot be put in place: " + reason(rename_error) +
                         "; what was there before is now " + old.string()};
        }
        return failure(path_, "cannot be put in place", rename_error);
    }
    forget(temporary_);
    temporary_.clear();
    sync_folder_of(path_);
    if (!old.empty()) remove_quietly(old);
    return {};
}

}  // namespace rs
