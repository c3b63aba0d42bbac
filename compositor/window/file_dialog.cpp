#include "compositor/window/file_dialog.hpp"

#include "rayspace/base/printable.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <system_error>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxListed = 4096;
constexpr std::array<std::string_view, 16> kOpened = {".rso",  ".wrl",  ".wrl.gz", ".wrz",     ".vrml",  ".x3d",
                                                      ".x3dz", ".x3dv", ".x3d.gz", ".x3dv.gz", ".x3dvz", ".gltf",
                                                      ".glb",  ".obj",  ".ply",    ".json"};
constexpr std::array<std::string_view, 1> kLightLists = {".json"};

std::span<const std::string_view> endings_of(FileUse use) {
    switch (use) {
        case FileUse::kLightList:
            return kLightLists;
        case FileUse::kFolder:
            return {};
        default:
            return kOpened;
    }
}

const char* title_of(FileUse use) {
    switch (use) {
        case FileUse::kLightList:
            return "list of lights";
        case FileUse::kFolder:
            return "folder of images and videos";
        default:
            return "open";
    }
}

fs::path without_slash(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    return normal.has_filename() || !normal.has_relative_path() ? normal : normal.parent_path();
}

bool has_ending(std::string name, std::span<const std::string_view> endings) {
    for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); });
}

}  // namespace

Result<std::vector<ListedFile>> list_files(const fs::path& folder, std::span<const std::string_view> endings) {
    std::vector<ListedFile> files;
    std::error_code failed;
    fs::directory_iterator entries(folder, failed);
    for (; !failed && entries != fs::directory_iterator() && files.size() < kMaxListed; entries.increment(failed)) {
        std::error_code ignored;  // of broken links
        const std::string name = entries->path().filename().string();
        const bool is_folder = entries->is_directory(ignored);
        if (name.starts_with('.') || !(is_folder || has_ending(name, endings))) continue;
        files.push_back({name, is_folder});
    }
    if (failed) return Error{folder.string() + ": " + failed.message() + "; choose another folder"};
    std::ranges::sort(files, [](const ListedFile& a, const ListedFile& b) {
        return std::pair(!a.is_folder, a.name) < std::pair(!b.is_folder, b.name);
    });
    return files;
}

void FileDialog::open(FileUse use, const fs::path& at) {
    use_ = use;
    is_open_ = true;
    std::error_code ignored;
    const fs::path full = without_slash(fs::absolute(at.empty() ? "." : at, ignored));
    list(fs::is_directory(full, ignored) ? full : full.parent_path());
    if (use == FileUse::kLightList) typed_ = full.filename().string();
}

void FileDialog::list(const fs::path& folder) {
    Result<std::vector<ListedFile>> files = list_files(folder, endings_of(use_));
    if (!files) {
        error_ = files.error().message;
        return;
    }
    error_.clear();
    typed_.clear();
    folder_ = folder;
    files_ = std::move(*files);
}

void FileDialog::enter(const std::string& path) {
    if (path.empty()) return;
    const fs::path full = without_slash(folder_ / path);
    std::error_code ignored;
    if (fs::is_directory(full, ignored)) {
        list(full);
    } else if (use_ == FileUse::kFolder || (use_ == FileUse::kOpen && !fs::exists(full, ignored))) {
        error_ = full.string() + ": does not exist; choose another";
    } else {
        choose(full);
    }
}

void FileDialog::choose(const fs::path& path) {
    choice_ = Choice{use_, path.string()};
    is_open_ = false;
}

void FileDialog::draw() {
    if (!is_open_) return;
    const float line = ImGui::GetFrameHeightWithSpacing();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Appearing, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({std::min(24 * line, display.x), std::min(18 * line, display.y)}, ImGuiCond_Appearing);
    const std::string title = std::string(title_of(use_)) + "###files";
    if (ImGui::Begin(title.c_str(), &is_open_, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse)) {
        ImGui::TextUnformatted(printable(folder_.string()).c_str());
        std::optional<std::string> entered;
        ImGui::BeginChild("files", {0, -2.5F * line}, true);
        if (folder_.has_relative_path() && ImGui::Selectable("../")) entered = "..";
        for (const ListedFile& file : files_) {
            const std::string name = printable(file.name) + (file.is_folder ? "/" : "");
            if (ImGui::Selectable(name.c_str())) entered = file.name;
        }
        ImGui::EndChild();
        std::array<char, 1024> text{};
        std::snprintf(text.data(), text.size(), "%s", typed_.c_str());
        const bool is_entered =
            ImGui::InputText("path", text.data(), text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
        typed_ = text.data();
        if (is_entered) entered = typed_;
        if (use_ != FileUse::kFolder) {
            if (ImGui::Button("choose")) entered = typed_;
            ImGui::SameLine();
        }
        if (use_ != FileUse::kLightList) {
            if (ImGui::Button(use_ == FileUse::kOpen ? "open folder as sequence" : "use this folder")) choose_folder();
            ImGui::SameLine();
        }
        if (ImGui::Button("cancel")) close();
        if (!error_.empty()) {
            ImGui::SameLine();
            ImGui::TextWrapped("%s", printable(error_).c_str());
        }
        if (entered) enter(*entered);
    }
    ImGui::End();
}

}  // namespace rs::compositor
