#pragma once
// Interactive light editor: applies pointer and key events to the scene's lights, loads and saves light lists, and
// provides the relit scene. Its panel is light_panel.hpp, its model lighting/light_edits.hpp. Independent of OpenGL and
// windows; single-threaded.
//
//     on_event(event) ... -> update() -> if take_change(): scene() -> both renderers

#include "compositor/lighting/light_drag.hpp"
#include "compositor/lighting/light_edits.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/window/events.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rs::compositor {

/// View under the pointer.
struct EditorView {
    Camera camera;
    SurfaceAt surface;
};

class LightEditor {
public:
    LightEditor(const Scene& scene, double exposure_ev, const std::filesystem::path& profile);

    [[nodiscard]] const LightEdits& edits() const { return edits_; }
    [[nodiscard]] LightEdits& edits() { return edits_; }
    /// Scene with the edited lights; the geometry never changes.
    [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return lit_; }
    /// True once after lights changed: scene() is then a new scene.
    bool take_change();

    /// Replaces the scene by one with the same geometry, in other weather. Takes over its lights if none has been
    /// edited, otherwise keeps the edited ones. scene() is then a new scene, which take_change() does not report.
    void set_scene(const Scene& scene);

    [[nodiscard]] bool is_open() const { return open_; }
    void open(bool open);

    /// Handles pointer events.
    /// \return false if the event was not consumed.
    bool on_event(const Event& event, const EditorView& view);
    /// Handles undo, redo, delete, duplicate and open.
    /// \return false for other keys.
    bool on_key(Key command);
    /// Updates a drag with the pointer; call it after the events of a frame.
    void update(const EditorView& view);

    [[nodiscard]] std::vector<HandleStroke> strokes(const Camera& camera) const;

    /// Adds a light at the centre of the view and selects it. Luminaires use the first of files().
    void add(LightKind kind, const EditorView& view);

    /// Loads `profile` as one undo step, replacing all lights if the list has "replace". Changes nothing on failure.
    Status load();
    /// Replaces all lights by those of a list, and sets the exposure. Fails if they do not fit the scene.
    /// \param from name of the list for errors
    Status set_lights(const LightList& list, double exposure_ev, const std::string& from);
    Status save();
    /// True if lights have been edited since they were loaded or saved.
    [[nodiscard]] bool has_unsaved_edits() const { return edits_.revision() != saved_revision_; }
    std::string profile;  // file name of the light list
    /// Requests the selection of `profile` in a file list.
    void request_profile() { profile_requested_ = true; }
    bool take_profile_request() { return std::exchange(profile_requested_, false); }

    /// Lists the photometric files of a folder by name; at most 500.
    void scan_folder(const std::filesystem::path& folder);
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
    /// Reads a photometric file into the selected luminaire as one undo step.
    Status use_file(const std::filesystem::path& file);

    /// Warning about the selected light or the loaded list; may be empty.
    [[nodiscard]] const std::string& warning() const { return warning_; }
    /// Message for the user since the last call; may be empty.
    std::string take_message();
    void report(const std::string& news) { news_ = news; }

private:
    [[nodiscard]] Result<Scene> scene_with(LightList list, const std::string& from) const;
    void relight();
    void end_drag();
    void follow(const EditorView& view);

    std::shared_ptr<const Scene> base_;  // original scene
    std::shared_ptr<const Scene> lit_;
    double lift_ = 0.001;  // offset of lights from surfaces
    LightEdits edits_;
    std::uint64_t lit_revision_ = 0;
    std::uint64_t saved_revision_ = 0;
    std::optional<std::pair<std::uint64_t, std::optional<std::size_t>>> warned_;
    bool open_ = false;
    glm::dvec2 pointer_{-1};
    bool pointer_moved_ = false;
    std::optional<HandleHit> hovered_;
    struct HandleGrab {
        HandleHit hit;
        glm::dvec2 at_px;
    };
    std::optional<HandleGrab> grab_;
    std::optional<glm::dvec2> pressed_outside_;
    std::optional<LightDrag> drag_;
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
    bool profile_requested_ = false;
    std::string warning_;
    std::string news_;
};

}  // namespace rs::compositor
