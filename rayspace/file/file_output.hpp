#pragma once
// Output of files and folders: written under a temporary name beside the target, synced, and renamed, so that a reader
// sees the old or the new contents even if the writer is killed. Temporaries are named ".NAME.partial-RANDOM.EXT" and
// locked (flock) while they are written; those that a killed process left are removed by the next writer of the same
// target.

#include "rayspace/base/result.hpp"
#include "rayspace/file/temporary.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rs {

/// File that appears under its name when commit() succeeds. Without commit() the temporary file is removed.
/// Not thread-safe.
class StagedFile {
public:
    /// \return an error if the folder of `path` does not exist or cannot be written, or if `path` is a folder, a
    ///     device or a pipe.
    static Result<StagedFile> create(const std::filesystem::path& path);

    /// Reports a full disk at once.
    Status write(std::span<const std::byte> bytes);
    /// Overwrites bytes that are written already; [offset, offset + size) must lie inside them.
    Status write_at(std::uint64_t offset, std::span<const std::byte> bytes);
    [[nodiscard]] std::uint64_t size_bytes() const { return size_bytes_; }
    [[nodiscard]] const std::filesystem::path& target() const { return path_; }
    /// File to write, for libraries that open it by name.
    [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_.path(); }
    /// Syncs the file and renames it; an older file of that name is replaced.
    Status commit();

private:
    StagedFile(std::filesystem::path path, Temporary temporary);
    std::filesystem::path path_;
    Temporary temporary_;
    std::uint64_t size_bytes_ = 0;
};

/// Folder that appears under its name when commit() succeeds. Without commit() the temporary folder is removed with its
/// files. commit() adds the file ".rayspace-folder": the kind of contents, such as "imported photos", in the first
/// line and the name of a file in each further one.
///
/// An existing folder is replaced as a whole if it is empty, or if it has the same kind of contents and only files
/// that its ".rayspace-folder" names. Anything else is refused by create(), and again by commit(), unless `force` is
/// set. Changed contents of the named files are not detected.
class StagedFolder {
public:
    /// \param contents kind of contents, a noun in the plural
    /// \param force replace an existing folder with any contents, unless it contains the current folder
    static Result<StagedFolder> create(const std::filesystem::path& path, std::string contents, bool force = false);

    /// Folder to write the files to.
    [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_.path(); }
    Status commit();

private:
    StagedFolder(std::filesystem::path path, std::string contents, bool force, Temporary temporary);
    std::filesystem::path path_;
    std::string contents_;
    bool force_;
    Temporary temporary_;
};

/// Description of the option --force of tools that write folders.
inline constexpr const char* kForceHelp = "replace the output folder even if it holds other files";

/// Refuses an output that would overwrite an input or another output of the same command. Tools call it before they
/// write. Links are followed, and hard links are recognised.
/// \param output file or folder to be written, which need not exist; empty: no output
/// \param others files and folders that the command reads or writes besides; empty ones are skipped
/// \return an error that names both if `output` is one of `others`, or a folder that contains one.
Status refuse_overwriting_inputs(const std::filesystem::path& output, const std::vector<std::filesystem::path>& others);

/// Reads a whole file. Fails if it is larger than `cap_bytes`.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t cap_bytes);

/// Writes a StagedFile in one call; an existing file is unchanged on failure.
Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
Status write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace rs
