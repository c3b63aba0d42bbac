#pragma once
// A scene in a window: walk, fly and look around, pick and turn objects, edit lights, record images and videos.
//
// For the main thread only. The scene is loaded; its objects are read in the background.
//
//     events -> input -> camera -> traced view, if any -> frame -> recorder -> panels -> window

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/viewer/views/navigation.hpp"
#include "compositor/window/file_dialog.hpp"
#include "compositor/window/light_editor.hpp"
#include "compositor/window/light_panel.hpp"
#include "compositor/window/overlay.hpp"
#include "compositor/window/playback.hpp"
#include "compositor/window/traced_view.hpp"
#include "compositor/window/view_recorder.hpp"
#include "compositor/window/visit_sharing.hpp"
#include "compositor/window/visitor_input.hpp"
#include "compositor/window/window.hpp"
#include "rayspace/base/result.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rs::compositor {

struct VisitOptions {
    std::vector<Viewpoint> viewpoints;                            // at least one; the camera starts at the first
    std::string scene_name;                                       // in the toolbar
    std::filesystem::path images = ".";                           // initial folder of screenshots and recordings
    FrameOptions frame{.shadows = true, .upright_images = true};  // at the start; without its size
    std::filesystem::path lights = "lights.json";                 // the file that edited lights are saved to
    bool traced = false;                                          // at the start
    TracedOptions tracing{};                                      // with the exposure above
    std::optional<int> first_grid_cells{};                        // of FirstGridSelector
    std::string executor = "software core";                       // of the engine, for the panel
    std::shared_ptr<const Sequence> sequence;                     // to play, in this weather
    std::optional<Weather> weather;
    bool follows_sequence = true;  // starts with the sequence's camera instead of the first viewpoint
    /// Loads a file or folder that takes the place of the scene; the visit ends if it succeeds. Empty: none can be
    /// opened.
    std::function<Status(const std::string& file)> open = {};
    /// Loads the objects of the scene with an added one. Empty: objects cannot be added.
    std::function<Result<std::unique_ptr<Showroom>>(const Scene& scene)> load_objects = {};
    SharingPeers sharing{};  // a follower's camera, lights and frame are its leader's
    std::function<void(const std::vector<std::string>&)> warn;  // for objects that cannot be shown; may be empty
};

class Visit {
public:
    static Result<std::unique_ptr<Visit>> create(Window window, const Scene& scene, std::unique_ptr<Showroom> showroom,
                                                 const VisitOptions& options);

    /// Handles the events since the last frame, draws the next frame and shows it.
    /// \param seconds since the last frame; measured if not given
    /// \return false if the user closes the window
    Result<bool> step(std::optional<double> seconds = std::nullopt);

    [[nodiscard]] Window& window() { return window_; }
    [[nodiscard]] const Visitor& visitor() const { return visitor_; }
    [[nodiscard]] const PanelState& panel() const { return panel_; }
    /// The tracer exists or is being built: after a second without movement, or with traced light.
    [[nodiscard]] bool has_tracer() const { return traced_view_.has_tracer(); }
    /// Traced light follows the camera with coarse images; else the camera does not move while it is on.
    void walk_on(bool on) { panel_.walk_on = on; }
    [[nodiscard]] LightEditor& lights() { return desk_; }
    [[nodiscard]] std::size_t object_count() const { return names_.size(); }
    /// Ends the visit and returns its window.
    static Window leave(std::unique_ptr<Visit> visit) { return std::move(visit->window_); }
    /// The last frame, without the overlay.
    [[nodiscard]] Image<Rgba8> image() const { return compositor_.image(); }

private:
    Visit(Window window, std::unique_ptr<Showroom> showroom, FrameCompositor compositor, const Scene& scene,
          const VisitOptions& options);

    static Result<FrameCompositor> make_compositor(const Scene& scene, Showroom& showroom, const glm::ivec2& size,
                                                   const VisitOptions& options);

    void handle_events();
    void on_key(Key command);
    void go_to_viewpoint(std::size_t number);
    [[nodiscard]] std::string viewpoint_name(std::size_t number) const;
    Status change_weather();
    Result<FrameCompositor> compositor_of(const Scene& scene, Showroom& showroom) const;
    void take_compositor(FrameCompositor compositor);
    void begin_travel(const Visitor& to);
    void apply_mode();
    void examine();
    void end_examining();
    [[nodiscard]] bool is_frozen() const { return panel_.traced && !panel_.walk_on; }
    [[nodiscard]] std::optional<glm::dvec3> centre_of_picked() const;
    bool move(double seconds);
    void pick(const glm::dvec2& at_px);
    [[nodiscard]] EditorView desk_view();
    Status resize_if_needed(const glm::ivec2& size);
    Status apply_light_edits();
    void apply_shadow_setting();
    Result<bool> play(double seconds);
    Result<bool> follow();
    void share();
    [[nodiscard]] Refinement::Lighting lighting_to_trace() const;
    bool refine(const Camera& here);
    void drop(const DropEvent& event);
    void take_file(const std::string& file, const glm::dvec2& at_px);
    void load_lights(const std::string& file);
    Status add_object(const std::string& file, const glm::dvec2& at_px);
    [[nodiscard]] std::optional<glm::dvec3> ground_at(const glm::dvec2& at_px);
    void request_open(std::string file);
    void poll_panels();
    void take_choice(const FileDialog::Choice& choice);
    bool open_requested();
    void take_screenshots();
    void record();
    Status show(const glm::ivec2& size);
    void draw_panels();
    void refresh_panel(double seconds);
    Status poll_streaming(double seconds);
    void report(const std::string& news);
    void report(const Error& error);
    [[nodiscard]] Camera camera() const;

    Window window_;
    std::unique_ptr<Showroom> showroom_;
    FrameCompositor compositor_;
    std::unique_ptr<Overlay> overlay_;
    VisitOptions options_;
    NavigationSettings navigation_;
    std::vector<std::string> names_;  // of the objects
    glm::dvec3 middle_{0};            // of the scene's bounds
    VisitorInput input_;
    PanelState panel_;
    Visitor visitor_;
    struct Travel {
        Visitor from;
        Visitor to;
        double t = 0;
    };
    std::optional<Travel> travel_;
    NavigationMode mode_ = NavigationMode::kWalk;  // applied mode; the panel's may be newer
    struct BeforeExamining {
        NavigationMode mode;
        double eye_height;
    };
    std::optional<BeforeExamining> before_examining_;
    std::size_t viewpoint_ = 0;
    std::vector<double> turns_rad_;  // [object]
    std::vector<double> frame_seconds_;
    TracedView traced_view_;
    LightEditor desk_;
    LightPanel light_panel_;
    std::optional<Playback> playback_;
    ViewRecorder recorder_;
    FileDialog dialog_;
    std::string opening_;  // file to open after this frame
    VisitSharing sharing_;
    std::optional<Viewpoint> followed_;  // the leader's camera
    double news_seconds_ = 0;
    std::chrono::steady_clock::time_point last_;
};

/// Creates a visit and runs it until the user closes the window or opens another file in it.
/// \return the window
Result<Window> visit(Window window, const Scene& scene, std::unique_ptr<Showroom> showroom,
                     const VisitOptions& options);

}  // namespace rs::compositor
