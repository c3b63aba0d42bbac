#include "compositor/tools/window_content.hpp"

#include "compositor/tools/scene_options.hpp"

#include <filesystem>
#include <utility>

namespace rs::compositor {

bool is_sequence(const std::filesystem::path& file) {
    std::error_code ignored;
    return file.filename() == "frames.json" || std::filesystem::is_directory(file, ignored);
}

Status show_contents(Window window, WindowContent content, const LoadContent& load) {
    std::optional<Window> shown(std::move(window));
    for (;;) {
        std::optional<WindowContent> next;
        content.visit.warn = print_warnings;
        const bool is_shared = content.visit.sharing.leader || content.visit.sharing.follower;
        // Machines that share a view have the same scene.
        if (is_shared) content.visit.load_objects = {};
        content.visit.open = [&](const std::string& file) -> Status {
            if (is_shared) return Error{file + ": a shared view cannot change its scene; start rs-view again with it"};
            RS_ASSIGN_OR_RETURN(next, load(file));
            return {};
        };
        shown->set_title(content.title + " - rs-view");
        RS_ASSIGN_OR_RETURN(Window left,
                            visit(std::move(*shown), content.scene, std::move(content.showroom), content.visit));
        if (!next) return {};
        shown.emplace(std::move(left));
        content = std::move(*next);
    }
}

}  // namespace rs::compositor
