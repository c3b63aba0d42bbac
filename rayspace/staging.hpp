#pragma once
// What StagedFile and StagedFolder share (file_output.hpp); private to rayspace.

#include "rayspace/result.hpp"

#include <filesystem>
#include <string>

namespace rs::staging {

// The system's reason for errno `error`, with what to do about it where that is known.
std::string reason(int error);
// "PATH: WHAT: reason".
Error failure(const std::filesystem::path& path, const std::string& what, int error);

// The path has a name, and its folder exists.
Status check_parent(const std::filesystem::path& path);

// "FOLDER/.NAME.partial-PID-N.EXT": hidden, beside the target (a rename does not cross file systems), and free for this
// process whatever else writes the same target. It keeps the extension, by which libraries choose what to write.
std::filesystem::path temporary_name(const std::filesystem::path& path);

// Makes a rename inside the folder of `path` durable. Some file systems cannot; the rename itself has succeeded, so
// that is no error.
void sync_folder_of(const std::filesystem::path& path);

// The temporaries that exist, for remove_staged_output(). Thread-safe.
void remember(const std::filesystem::path& temporary);
void forget(const std::filesystem::path& temporary);

}  // namespace rs::staging
