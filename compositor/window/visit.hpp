#pragma once
// A visit to a scene in a window: walk, fly, look around, pick and turn objects, take images home.
//
// For the main thread only. The scene is read before; objects come while the visit goes on.

#include "compositor/scene/scene.hpp"
#include "compositor/traced/refinement.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/viewer/views/navigation.hpp"
#include "compositor/window/light_editor.hpp"
#include "compositor/window/light_panel.hpp"
#include "compositor/window/overlay.hpp"
#include "compositor/window/playback.hpp"
#include "compositor/window/visitor_input.hpp"
#include "compositor/window/window.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct VisitOptions {
    std::vector<Viewpoint> viewpoints;   // at least one; the first is where the visit begins
    std::filesystem::path images = ".";  // where screenshots and recordings go
    int samples = 4;
    bool wire_frame = false;
    ObjectDepth object_depth = ObjectDepth::kPlane;
    int object_samples = FrameOptions{}.object_samples;
    double exposure_ev = 0;
    std::filesystem::path lights = "lights.json";  // the profile that edited light is saved to
    bool shadows = true;
    bool traced = false;                       // from the beginning
    TracedOptions tracing{};                   // with the exposure above
    std::string executor = "software core";    // of the engine, for the panel
    std::shared_ptr<const Sequence> sequence;  // to be played, in this weather
    std::optional<Weather> weather;
    std::function<void(const std::string&)> open;               // another sequence is requested; the visit ends
    std::function<void(const std::vector<std::string>&)> warn;  // of objects that cannot be shown; may be empty
};

class Visit {
public:
    static Result<std::unique_ptr<Visit>> create(Window window, const Scene& scene, std::unique_ptr<Showroom> showroom,
                                                 const VisitOptions& options);
    ~Visit();  // finishes a recording

    // A frame: what happened since the last, the image, the overlay. False when the visitor wants to leave.
    // `seconds`: since the last frame, by a clock on the wall if not given.
    Result<bool> step(std::optional<double> seconds = std::nullopt);

    [[nodiscard]] Window& window() { return window_; }
    [[nodiscard]] const Visitor& visitor() const { return visitor_; }
    [[nodiscard]] const PanelState& panel() const { return panel_; }
    // Whether traced light has its trees, or will have them soon: for who has stood still for a second, or traces.
    [[nodiscard]] bool has_tracer() const { return refinement_.has_value(); }
    // Traced light follows whoever moves, by coarse images; else the view stands still.
    void walk_on(bool on) { panel_.walk_on = on; }
    [[nodiscard]] LightDesk& lights() { return desk_; }
    // Of the last frame, without the overlay.
    [[nodiscard]] Image<Rgba8> image() const { return compositor_.image(); }

private:
    Visit(Window window, std::unique_ptr<Showroom> showroom, FrameCompositor compositor, const Scene& scene,
          const VisitOptions& options);

    Status obey(Key command);
    void go_to_viewpoint(std::size_t number);
    void begin_travel(const Visitor& to);
    bool move(double seconds);
    void pick(const glm::dvec2& at_px);
    [[nodiscard]] DeskView desk_view();
    // Gives light that was edited to both renderers.
    Status relight();
    Status show(const glm::ivec2& size);
    // As it is lit and stands now.
    [[nodiscard]] std::shared_ptr<const Scene> scene_to_trace() const;
    // Makes the tracer of what stands there now, if there is none or it has another number of objects.
    void make_tracer();
    // Makes it ahead for whoever stands still, so that it is there, or soon will be, when traced light is switched on.
    void expect_tracing(const Camera& here, double seconds);
    // Whether there is a new image to show.
    bool refine(const Camera& here);
    Result<bool> play(double seconds);
    Status take_images();
    Status record();
    void refresh_panel(double seconds);
    void hear_showroom();
    void report(const std::string& news);
    [[nodiscard]] Camera camera() const;

    Window window_;
    std::unique_ptr<Showroom> showroom_;
    FrameCompositor compositor_;
    std::unique_ptr<Overlay> overlay_;
    VisitOptions options_;
    NavigationSettings navigation_;
    std::vector<std::string> names_;  // of the objects
    glm::dvec3 middle_{0};            // of the scene
    VisitorInput input_;
    PanelState panel_;
    Visitor visitor_;
    struct Travel {
        Visitor from;
        Visitor to;
        double t = 0;
    };
    std::optional<Travel> travel_;
    std::size_t viewpoint_ = 0;
    std::vector<double> turns_rad_;  // [object]
    std::vector<double> frame_seconds_;
    std::optional<Refinement> refinement_;
    Camera still_at_;                // of the last frame
    double still_s_ = 0;             // for which nobody has moved
    std::optional<Camera> refined_;  // what is traced now
    Camera shown_from_;              // of the traced image, which is behind where one walks on
    TracedMethod refined_by_ = TracedMethod::kPath;
    bool relit_ = false;  // since the tracer began
    LightDesk desk_;
    LightPanel light_panel_;
    std::size_t traced_objects_ = 0;
    std::optional<Playback> playback_;
    std::optional<VideoWriter> video_;
    int shots_ = 0;
    double news_seconds_ = 0;
    std::chrono::steady_clock::time_point last_;
};

// The first name of PREFIX-1.ENDING, PREFIX-2.ENDING, ... behind `number` that is free in the folder; sets its number.
std::filesystem::path free_name(const std::filesystem::path& folder, const char* prefix, const char* ending,
                                int& number);

// Until the visitor leaves.
Status visit(Window window, const Scene& scene, std::unique_ptr<Showroom> showroom, const VisitOptions& options);

}  // namespace rs::compositor
