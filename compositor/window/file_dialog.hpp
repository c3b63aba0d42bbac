#pragma once
// File list of a window: folders and files with known endings, and a field for a path. Dear ImGui, because dialogs of
// the desktop are not available everywhere.

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rs::compositor {

struct ListedFile {
    std::string name;
    bool is_folder = false;
    bool operator==(const ListedFile&) const = default;
};

/// Folders, then files whose names end in one of `endings` (lower case; in any case in names), each by name. Hidden
/// entries are left out, and all beyond 4096 entries. Errors name the folder.
Result<std::vector<ListedFile>> list_files(const std::filesystem::path& folder,
                                           std::span<const std::string_view> endings);

/// Use of the file that is chosen.
enum class FileUse {
    kOpen,       // a scene, object, light list, or the folder of a sequence
    kLightList,  // name to load lights from or to save them to; need not exist
    kFolder      // of saved images and videos
};

// One thread.
class FileDialog {
public:
    /// Shows the folder, or that of a file.
    void open(FileUse use, const std::filesystem::path& at);
    void close() { is_open_ = false; }
    [[nodiscard]] bool is_open() const { return is_open_; }

    /// Lists a folder, or chooses a file. A relative path is below the listed folder.
    void enter(const std::string& path);
    /// Chooses the listed folder.
    void choose_folder() { choose(folder_); }

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const std::vector<ListedFile>& files() const { return files_; }
    /// Reason for which a folder cannot be listed or a file not be chosen; may be empty.
    [[nodiscard]] const std::string& error() const { return error_; }

    struct Choice {
        FileUse use;
        std::string path;
    };
    /// Choice since the last call; the dialog is closed then.
    std::optional<Choice> take_choice() { return std::exchange(choice_, std::nullopt); }

    /// Call it between NewFrame() and Render().
    void draw();

private:
    void list(const std::filesystem::path& folder);
    void choose(const std::filesystem::path& path);

    bool is_open_ = false;
    FileUse use_ = FileUse::kOpen;
    std::filesystem::path folder_;
    std::vector<ListedFile> files_;
    std::string error_;
    std::string typed_;
    std::optional<Choice> choice_;
};

}  // namespace rs::compositor
