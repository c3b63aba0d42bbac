#pragma once
// What lies over the image in a window: a panel of figures and switches, help, and a line of news. Dear ImGui.

#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/views/navigation.hpp"
#include "compositor/window/playback.hpp"
#include "compositor/window/window.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rs::compositor {

struct ObjectLine {
    std::string name;
    bool in_view = false;
    int width = 0;  // of the image that the engine drew, px
    int height = 0;
    double milliseconds = 0;  // of the engine
    std::string absence;      // why it is not there; empty where it is
};

// What the panel shows, and what the visitor changes in it.
struct PanelState {
    bool show_panel = true;
    bool show_help = false;
    bool wire_frame = false;
    bool shadows = true;
    bool traced = false;   // the view stands still and refines,
    bool walk_on = false;  // but for walking by coarse images
    TracedMethod method = TracedMethod::kPath;
    int passes = 0;  // of it
    bool recording = false;
    NavigationMode mode = NavigationMode::kWalk;
    double speed = 1;  // scene units a second
    bool take_screenshot = false;

    double frame_ms = 0;  // of the last frames' middle one
    double geometry_ms = 0;
    double engine_ms = 0;
    double upload_ms = 0;
    double composite_ms = 0;
    std::string executor;
    int views_by_core = 0;  // in the last frame
    int views_by_board = 0;
    double memory_mib = 0;  // that objects take
    double budget_mib = 0;  // that they may take
    std::string device;
    std::vector<ObjectLine> objects;
    int picked = -1;               // of `objects`
    double turn_rad = 0;           // by which the visitor has turned it
    std::string news;              // empty: none
    Playback* playback = nullptr;  // of a sequence
};

// Stands between a window and its owner's drawing; one a process. Destroyed before the window.
class Overlay {
public:
    explicit Overlay(Window& window);
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;
    ~Overlay();

    // True while the mouse is over the panel, or something is typed into it: events are the panel's.
    [[nodiscard]] bool takes_mouse() const;
    [[nodiscard]] bool takes_keys() const;

    // Draws into the window; after the image, before swap(). `more` draws other panels.
    void draw(PanelState& state, const std::function<void()>& more = nullptr);
};

}  // namespace rs::compositor
