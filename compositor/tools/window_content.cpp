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
        content.visit.open = [&](const std::string& file) -> Status {
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
