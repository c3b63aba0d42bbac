#pragma once
// Renders the frames of a sequence. Geometry is uploaded to the driver and the tracer once; a frame moves nodes.

#include "compositor/scene/weather.hpp"
#include "compositor/sequence/sequence.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/frame_times.hpp"
#include "compositor/viewer/showroom.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct PlayerOptions {
    FrameOptions frame;
    std::optional<TracedOptions> tracing = {};  // nullopt: raster
    int passes = 16;                            // per traced frame, or per part of it with a shutter
    double shutter = 0;                         // part of the time between frames that a frame averages, 0..1
    int shutter_samples = 8;                    // times that are averaged, >= 1
    std::optional<Weather> weather = {};        // overrides the sequence's weather
    std::optional<Camera> camera = {};          // of all frames, in their size; nullopt: the sequence's cameras
    std::int64_t memory_bytes = default_memory_budget();
};

/// Weather to draw; nullopt if fair.
std::optional<Weather> weather_of(const Sequence& sequence, const PlayerOptions& options);

/// Camera of a frame: its own, else the base scene's, else one that frames the whole scene.
/// \param aspect width / height
SequenceCamera own_or_framing_camera(const Sequence& sequence, std::size_t frame, double aspect);
/// The same, in pixels.
Camera camera_of(const Sequence& sequence, std::size_t frame, int width, int height);

/// Sets the horizontal field of view of all cameras, and of the one that frames the whole scene if there is none.
/// \param aspect width / height
void set_field_of_view(Sequence& sequence, double fov_x_rad, double aspect);

/// Applies the transforms of a frame and the weather's time; takes effect in the next draw().
Status show_frame(const Sequence& sequence, std::size_t frame, const std::optional<Weather>& weather,
                  FrameCompositor& compositor, Showroom& showroom);
/// The same between frames (frame_at()).
/// \param time in frames
Status show_time(const Sequence& sequence, double time, const std::optional<Weather>& weather,
                 FrameCompositor& compositor, Showroom& showroom);

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class SequencePlayer {
public:
    /// \param sequence must not be null.
    /// \param executor draws the objects that it supports; null: the software core draws all
    static Result<SequencePlayer> create(std::shared_ptr<const Sequence> sequence, const PlayerOptions& options,
                                         std::unique_ptr<engine::Executor> executor = nullptr);

    /// Frames may be requested in any order; the result does not depend on it. With a shutter, the mean, in linear
    /// light, of images at evenly spaced times from the frame's on.
    Result<Image<Rgba8>> frame(std::size_t number);
    /// Same, without reading the image back (FrameCompositor::draw).
    Status draw(std::size_t number, const Camera& camera);

    [[nodiscard]] std::size_t frames() const { return sequence_->frames.size(); }
    /// Camera of a frame in the size of the frames.
    [[nodiscard]] Camera camera(std::size_t number) const;
    /// Times of all frames since create(), as by FrameTimes::to_json().
    [[nodiscard]] std::string times_as_json() const { return times_.to_json(*showroom_); }
    [[nodiscard]] const FrameCompositor& compositor() const { return compositor_; }
    /// Number of acceleration structures built for traced frames since create(): one, unless ray-space objects move.
    [[nodiscard]] int tracers_made() const { return tracers_made_; }
    /// Objects that cannot be displayed; each is reported once.
    std::vector<std::string> take_warnings();

private:
    SequencePlayer(std::shared_ptr<const Sequence> sequence, std::unique_ptr<Showroom> showroom,
                   FrameCompositor compositor, const PlayerOptions& options);
    Status make_tracer();
    Status draw_at(double time, const Camera& camera);
    Result<TracingWork> trace(const SlotTransforms& moved, const Camera& camera);
    [[nodiscard]] Camera camera_at(double time) const;

    std::shared_ptr<const Sequence> sequence_;
    Scene scene_;  // with weather applied
    std::optional<TracedRenderer> tracer_;
    glm::dmat4 hidden_transform_{1.0};  // transform of nodes that a frame does not show
    PlayerOptions options_;
    std::unique_ptr<Showroom> showroom_;
    FrameCompositor compositor_;
    FrameTimes times_;
    std::vector<std::string> warnings_;
    int tracers_made_ = 0;
};

}  // namespace rs::compositor
