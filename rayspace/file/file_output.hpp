#pragma once
// Output that is never seen half-written: a temporary name beside the target, then a rename.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rs {

// A file that appears under `path` only when commit() succeeds. write() reports a full disk at once; commit() flushes
// to the disk before it renames. Dropped before commit(), it removes its temporary file. Not thread-safe.
class StagedFile {
public:
    // Fails when the folder does not exist or cannot be written.
    static Result<StagedFile> create(const std::filesystem::path& path);
    StagedFile(StagedFile&& other) noexcept;
    StagedFile& operator=(StagedFile&& other) noexcept;
    ~StagedFile();

    Status write(std::span<const std::byte> bytes);
    // Overwrites bytes already written; [offset, offset + size) must lie inside them.
    Status write_at(std::uint64_t offset, std::span<const std::byte> bytes);
    [[nodiscard]] std::uint64_t size_bytes() const { return size_bytes_; }
    [[nodiscard]] const std::filesystem::path& target() const { return path_; }
    // Where the bytes stand until commit(); for libraries that write the file themselves.
    [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }
    Status commit();

private:
    StagedFile() = default;
    std::filesystem::path path_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    std::uint64_t size_bytes_ = 0;
};

// A folder that appears under `path` only when commit() succeeds. It carries a list of its files (.rayspace-files),
// which says what it holds, too: `contents`, in the plural, as "imported photographs". What stands at `path` already is
// replaced as a whole only where it is empty, or a folder of ours in which nobody has added or changed a file and that
// holds the same kind of thing, or does not say what it holds, as those of versions before 0.38; create() refuses
// anything else at once, naming what would be lost. Dropped before commit(), the temporary folder is removed with all
// it holds.
class StagedFolder {
public:
    static Result<StagedFolder> create(const std::filesystem::path& path, std::string contents);
    StagedFolder(StagedFolder&& other) noexcept;
    StagedFolder& operator=(StagedFolder&& other) noexcept;
    ~StagedFolder();

    // Write files here.
    [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }
    Status commit();

private:
    StagedFolder() = default;
    std::filesystem::path path_;
    std::string contents_;
    std::filesystem::path temporary_;
};

// Gives a finished file, or a folder that a StagedFolder has finished, another name on the same file system, with the
// checks and in the way of commit(): whatever stood at `to` is replaced whole, or stays.
Status move_into_place(const std::filesystem::path& from, const std::filesystem::path& to);

// Removes every temporary file and folder of this process that is not committed yet. For the moment before a process is
// ended from outside (interruption.hpp): whoever still writes to them will fail. Thread-safe.
void remove_staged_output();

// The whole file, refused when it is larger than `cap_bytes`.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t cap_bytes);

// Fails as StagedFile does; what stood under the name then still stands.
Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
Status write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace rs
