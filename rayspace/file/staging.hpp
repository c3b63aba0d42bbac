#pragma once
// What StagedFile and StagedFolder share (file_output.hpp); private to rayspace.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::staging {

// The system's reason for errno `error`, with what to do about it where that is known.
std::string reason(int error);
// "PATH: WHAT: reason".
Error failure(const std::filesystem::path& path, const std::string& what, int error);

// The path has a name, and its folder exists.
Status check_parent(const std::filesystem::path& path);

// "FOLDER/.NAME.partial-HOST-PID-N.EXT": hidden, beside the target (a rename does not cross file systems), and free for
// this process whatever else writes the same target. A long NAME is shortened; HOST is a number. It keeps the
// extension, by which libraries choose what to write.
std::filesystem::path temporary_name(const std::filesystem::path& path);

// Removes the temporaries of `path` that processes of this host have left behind when they were killed.
void remove_left_behind(const std::filesystem::path& path);

// Renames `temporary` to `path`, which it replaces, and forgets it; where `exchanged`, `path` exists and its old
// contents take the temporary's place and name, and are still remembered. The value is errno, 0 where it was done.
// remove_staged_output() waits meanwhile, or makes it fail.
int put_in_place(const std::filesystem::path& temporary, const std::filesystem::path& path, bool exchanged);

// read_file() of something that is to be replaced: it does not become an input (input_file.hpp).
Result<std::vector<std::byte>> read_old_file(const std::filesystem::path& path, std::uint64_t cap_bytes);

// Makes a rename inside the folder of `path` durable. Some file systems cannot; the rename itself has succeeded, so
// that is no error.
void sync_folder_of(const std::filesystem::path& path);

// The temporaries that exist, for remove_staged_output(). Thread-safe.
void remember(const std::filesystem::path& temporary);
void forget(const std::filesystem::path& temporary);

}  // namespace rs::staging
