#pragma once
// Temporary files and folders of StagedFile and StagedFolder (file_output.hpp).

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs {

/// Temporary file or folder beside its target. The destructor removes it. Move-only.
class Temporary {
public:
    enum class Kind { kFile, kFolder };

    /// Removes temporaries of the same target that killed processes left, and creates a new, empty one.
    static Result<Temporary> create(const std::filesystem::path& target, Kind kind);
    Temporary(Temporary&& other) noexcept;
    Temporary& operator=(Temporary&& other) noexcept;
    ~Temporary();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// File opened for reading and writing, or folder opened for reading. Holds the lock that marks it as in use.
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Renames it to `target`, which is replaced. An existing folder is exchanged with the temporary and then removed.
    /// On file systems that cannot exchange folders it is renamed to ".NAME.old-RANDOM" in between.
    Status move_to(const std::filesystem::path& target);

private:
    Temporary() = default;
    void remove();
    std::filesystem::path path_;  // empty: moved from, or moved to the target
    int descriptor_ = -1;
};

/// Removes the temporaries of this process, for the moment before a signal ends it (rayspace/tool/tool_main.cpp).
/// Later operations on them fail. Thread-safe.
void remove_temporaries();

/// \return "PATH: WHAT: reason" for errno `error`, with a remedy where one is known.
Error output_error(const std::filesystem::path& path, const std::string& what, int error);

}  // namespace rs
