#pragma once
// Light that is edited while one looks: what pointer and keys do to the scene's lights, profiles in files, and the
// scene as it is lit then. The panel of it is light_panel.hpp, its model lighting/light_edits.hpp. No OpenGL, no window
// of its own; one thread.
//
//     take(event) ... -> settle() -> where take_change(): scene() -> both renderers

#include "compositor/lighting/light_drag.hpp"
#include "compositor/lighting/light_edits.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/window/events.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

// What the pointer is over.
struct DeskView {
    Camera camera;
    SurfaceAt surface;
};

class LightDesk {
public:
    LightDesk(const Scene& scene, double exposure_ev, const std::filesystem::path& profile);

    [[nodiscard]] const LightEdits& edits() const { return edits_; }
    [[nodiscard]] LightEdits& edits() { return edits_; }
    // The scene with the lights as they are now; the geometry is always the same.
    [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return lit_; }
    // True once after light changed: then scene() is another.
    bool take_change();

    [[nodiscard]] bool is_open() const { return open_; }
    void open(bool open);

    // False where the event is nobody's here: then it is the visitor's.
    bool take(const Event& event, const DeskView& view);
    // Undo, redo, delete, duplicate and open; false for other keys.
    bool obey(Key command);
    // After the events of a frame: a drag follows the pointer.
    void settle(const DeskView& view);

    [[nodiscard]] std::vector<HandleStroke> strokes(const Camera& camera) const;

    // At what is seen in the image's middle, selected. Luminaires take the first of files().
    void add(LightKind kind, const DeskView& view);

    // In place of all lights, or beside them where the list does not have "replace"; a step. Fails with nothing
    // changed.
    Status load();
    Status save() const;
    std::string profile;  // the name of the file

    // The photometric files in a folder, by name; at most 500.
    void look_for_files(const std::filesystem::path& folder);
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
    // Reads a file into the selected luminaire; a step.
    Status use_file(const std::filesystem::path& file);

    // What is wrong with the selected light, or was with what was loaded; may be empty.
    [[nodiscard]] const std::string& warning() const { return warning_; }
    // Since the last call, for people; empty: nothing.
    std::string take_news();
    void report(const std::string& news) { news_ = news; }

private:
    void end_drag();
    void follow(const DeskView& view);

    std::shared_ptr<const Scene> base_;  // as it came
    std::shared_ptr<const Scene> lit_;
    double lift_ = 0.001;  // of lights before surfaces
    LightEdits edits_;
    std::uint64_t lit_revision_ = 0;
    std::optional<std::pair<std::uint64_t, std::optional<std::size_t>>> warned_;
    bool open_ = false;
    glm::dvec2 pointer_{-1};
    bool pointer_moved_ = false;
    std::optional<HandleHit> under_pointer_;
    struct Grasp {
        HandleHit hit;
        glm::dvec2 at_px;
    };
    std::optional<Grasp> grasp_;
    std::optional<glm::dvec2> pressed_beside_;
    std::optional<LightDrag> drag_;
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
    std::string warning_;
    std::string news_;
};

}  // namespace rs::compositor
