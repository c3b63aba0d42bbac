#pragma once
// Draws the frames of a sequence. Everything is given to the driver and the tracer once; a frame moves nodes.

#include "compositor/scene/weather.hpp"
#include "compositor/sequence/sequence.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
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
    std::optional<TracedOptions> tracing = {};  // raster where there is none
    int passes = 16;                            // of a traced frame
    std::optional<Weather> weather = {};        // in place of the sequence's
    std::int64_t memory_bytes = usual_memory_budget();
};

// The weather that is drawn; nothing where it is fair.
std::optional<Weather> weather_of(const Sequence& sequence, const PlayerOptions& options);

// The camera of a frame: its own, the base's, or one from where all is seen.
Camera camera_of(const Sequence& sequence, std::size_t frame, int width, int height);

// Brings everything that moves to where a frame has it, and the weather to its time; for the next draw().
Status show_frame(const Sequence& sequence, std::size_t frame, const std::optional<Weather>& weather,
                  FrameCompositor& compositor, Showroom& showroom);

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class SequencePlayer {
public:
    // `sequence` is not null.
    static Result<SequencePlayer> create(std::shared_ptr<const Sequence> sequence, const PlayerOptions& options);

    // Frames may be requested in any order; each is the same bytes however it is come by.
    Result<Image<Rgba8>> frame(std::size_t number);
    // The same, left with the driver (FrameCompositor::draw).
    Status draw(std::size_t number, const Camera& camera);

    [[nodiscard]] std::size_t frames() const { return sequence_->frames.size(); }
    [[nodiscard]] const FrameCompositor& compositor() const { return compositor_; }
    // Trees over triangles built for traced frames since create() began: none after the first, unless ray-space objects
    // move.
    [[nodiscard]] int tracers_made() const { return tracers_made_; }
    // Seconds that moving everything and building the tree over it took, in the last traced frame.
    [[nodiscard]] double commit_s() const { return commit_s_; }
    // Of objects that cannot be shown, each reported once.
    std::vector<std::string> take_warnings();

private:
    SequencePlayer(std::shared_ptr<const Sequence> sequence, std::unique_ptr<Showroom> showroom,
                   FrameCompositor compositor, const PlayerOptions& options);
    Status make_tracer();
    Status trace(std::size_t number, const Camera& camera);

    std::shared_ptr<const Sequence> sequence_;
    Scene scene_;  // in its weather
    std::optional<TracedRenderer> tracer_;
    glm::dmat4 nowhere_{1.0};  // for what a frame does not show
    PlayerOptions options_;
    std::unique_ptr<Showroom> showroom_;
    FrameCompositor compositor_;
    std::vector<std::string> warnings_;
    int tracers_made_ = 0;
    double commit_s_ = 0;
};

}  // namespace rs::compositor
