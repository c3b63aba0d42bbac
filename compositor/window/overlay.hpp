#pragma once
// ImGui overlay of a window: toolbar, panel with statistics and settings, help, a message line, and a notice while the
// view is frozen.

#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/views/navigation.hpp"
#include "compositor/window/playback.hpp"
#include "compositor/window/view_recorder.hpp"
#include "compositor/window/window.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct ObjectLine {
    std::string name;
    bool in_view = false;
    int width = 0;  // of the rendered image, px
    int height = 0;
    double milliseconds = 0;  // engine time
    std::string absence;      // reason why the object is not displayed; empty if it is
};

/// State displayed by toolbar and panel, and changed by their controls.
struct PanelState {
    std::string scene;                    // name, in the toolbar
    std::vector<std::string> viewpoints;  // names
    std::size_t viewpoint = 0;
    std::optional<std::size_t> next_viewpoint;  // selected in the toolbar
    bool show_panel = false;
    bool show_help = false;
    bool wire_frame = false;
    bool shadows = true;
    bool traced = false;   // the view is fixed and refines progressively
    bool walk_on = false;  // keeps moving with coarse traced images
    TracedMethod method = TracedMethod::kPath;
    int passes = 0;  // of the traced image
    bool recording = false;
    NavigationMode mode = NavigationMode::kWalk;
    double speed = 1;  // scene units per second
    bool take_screenshot = false;
    SavedNames saved;
    bool choose_file = false;    // requests of the file list
    bool choose_folder = false;  // of saved images and videos
    std::string unconfirmed;     // file that would discard edited lights if it were opened; may be empty
    bool confirmed = false;

    double frame_ms = 0;  // median of the last frames
    double geometry_ms = 0;
    double engine_ms = 0;
    double upload_ms = 0;
    double composite_ms = 0;
    std::string executor;
    int views_by_core = 0;  // in the last frame
    int views_by_board = 0;
    double memory_mib = 0;  // used by objects
    double budget_mib = 0;  // budget of objects
    std::string device;
    std::vector<ObjectLine> objects;
    int picked = -1;               // index into `objects`
    double turn_rad = 0;           // rotation applied by the visitor
    std::string news;              // may be empty
    Playback* playback = nullptr;  // null without a sequence
};

/// Notice that traced light has frozen the view, with the key that releases it; empty if the view can move.
std::string frozen_notice(const PanelState& state);

/// Filters input and draws over a window; one per process. Must be destroyed before the window. Fonts and margins have
/// the scale of the display on which the window was created.
class Overlay {
public:
    explicit Overlay(Window& window);
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;
    ~Overlay();

    /// True while the pointer is over the panel, or text is typed into it: events then belong to the panel.
    [[nodiscard]] bool captures_mouse() const;
    [[nodiscard]] bool captures_keys() const;

    /// Draws into the window; call it after the image, before swap(). `more` draws other panels.
    void draw(PanelState& state, const std::function<void()>& more = nullptr);
};

}  // namespace rs::compositor
