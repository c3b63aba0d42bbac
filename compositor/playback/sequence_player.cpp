#include "compositor/playback/sequence_player.hpp"

#include "compositor/viewer/views/framing.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace rs::compositor {

namespace {

// Transform that hides instances: scaled down, below the scene.
glm::dmat4 hidden_transform(const Scene& scene) {
    constexpr double kSmall = 1e-6;
    const BoundingBox box = bounds_of(scene);
    glm::dmat4 matrix(kSmall);
    matrix[3] =
        glm::dvec4(box.empty() ? glm::dvec3(0) : glm::dvec3(box.middle().x, box.lowest.y - 1, box.middle().z), 1);
    return matrix;
}

// Shows the whole first frame.
SequenceCamera framing_camera(const Sequence& sequence, double fov_x_rad, double aspect) {
    const BoundingBox bounds = bounds_of(scene_at(sequence, 0));
    return {bounds.empty() ? CameraPose{{0, 1.6, 6}, {0, 1, 0}} : framing_pose(bounds, fov_x_rad, aspect), fov_x_rad};
}

}  // namespace

std::optional<Weather> weather_of(const Sequence& sequence, const PlayerOptions& options) {
    return options.weather ? options.weather : sequence.weather;
}

SequenceCamera own_or_framing_camera(const Sequence& sequence, std::size_t frame, double aspect) {
    const std::optional<SequenceCamera> camera = camera_of(sequence, frame);
    return camera ? *camera : framing_camera(sequence, SequenceCamera{}.fov_x_rad, aspect);
}

namespace {

Camera pixel_camera(const SequenceCamera& camera, int width, int height) {
    return look_at_camera(camera.pose.eye, camera.pose.at, camera.fov_x_rad, width, height);
}

// Sum of images in linear light.
class LinearMean {
public:
    LinearMean(int width, int height) : sum_(width, height) {}

    void add(const Image<Rgba8>& image) {
        std::ranges::transform(image.pixels(), sum_.pixels(), sum_.pixels().begin(), [](Rgba8 p, const RgbaF& sum) {
            return RgbaF{sum.r + linear_from_srgb8(p.r), sum.g + linear_from_srgb8(p.g), sum.b + linear_from_srgb8(p.b),
                         sum.a + 1};
        });
    }

    [[nodiscard]] Image<Rgba8> image() const {
        Image<Rgba8> mean(sum_.width(), sum_.height());
        std::ranges::transform(sum_.pixels(), mean.pixels().begin(), [](const RgbaF& sum) {
            return Rgba8{srgb8_by_table(sum.r / sum.a), srgb8_by_table(sum.g / sum.a), srgb8_by_table(sum.b / sum.a),
                         255};
        });
        return mean;
    }

private:
    Image<RgbaF> sum_;  // a: number of images
};

}  // namespace

Camera camera_of(const Sequence& sequence, std::size_t frame, int width, int height) {
    return pixel_camera(own_or_framing_camera(sequence, frame, static_cast<double>(width) / height), width, height);
}

void set_field_of_view(Sequence& sequence, double fov_x_rad, double aspect) {
    if (!sequence.camera) sequence.camera = framing_camera(sequence, fov_x_rad, aspect);
    sequence.camera->fov_x_rad = fov_x_rad;
    for (SequenceFrame& frame : sequence.frames) {
        if (frame.camera) frame.camera->fov_x_rad = fov_x_rad;
    }
}

SequencePlayer::SequencePlayer(std::shared_ptr<const Sequence> sequence, std::unique_ptr<Showroom> showroom,
                               FrameCompositor compositor, const PlayerOptions& options)
    : sequence_(std::move(sequence)),
      options_(options),
      showroom_(std::move(showroom)),
      compositor_(std::move(compositor)) {}

Result<SequencePlayer> SequencePlayer::create(std::shared_ptr<const Sequence> sequence, const PlayerOptions& options,
                                              std::unique_ptr<engine::Executor> executor) {
    const std::optional<Weather> weather = weather_of(*sequence, options);
    const Scene scene = weather ? apply_weather(sequence->scene, *weather) : sequence->scene;
    auto showroom = std::make_unique<Showroom>(
        scene, ShowroomOptions{.memory_bytes = options.memory_bytes, .waits = true}, std::move(executor));
    RS_TRY(showroom->wait_for_all({0, 0, 0}));
    RS_ASSIGN_OR_RETURN(auto compositor,
                        FrameCompositor::create(scene, showroom->engine(), showroom->nodes(), options.frame));
    SequencePlayer player(std::move(sequence), std::move(showroom), std::move(compositor), options);
    player.hidden_transform_ = hidden_transform(scene);
    player.scene_ = scene;
    return player;
}

Status show_frame(const Sequence& sequence, std::size_t frame, const std::optional<Weather>& weather,
                  FrameCompositor& compositor, Showroom& showroom) {
    return show_time(sequence, static_cast<double>(frame), weather, compositor, showroom);
}

Status show_time(const Sequence& sequence, double time, const std::optional<Weather>& weather,
                 FrameCompositor& compositor, Showroom& showroom) {
    const SlotTransforms moved = slot_transforms(sequence, frame_at(sequence, time));
    for (std::size_t slot = 0; slot < sequence.slots.size(); ++slot) {
        for (const std::size_t node : sequence.slots[slot].geometry) {
            std::optional<glm::dmat4> matrix = moved.geometry[slot];
            if (matrix) *matrix = *matrix * sequence.scene.geometry[node].world_from_node;
            RS_TRY(compositor.move_geometry(node, matrix));
        }
    }
    for (const auto& [node, chain] : moved.objects) showroom.move_object(node, chain);
    compositor.set_weather(weather, time / sequence.frames_per_second);
    return {};
}

Status SequencePlayer::draw(std::size_t number, const Camera& camera) {
    return draw_at(static_cast<double>(number), camera);
}

Status SequencePlayer::draw_at(double time, const Camera& camera) {
    const auto weather = weather_of(*sequence_, options_);
    RS_TRY(show_time(*sequence_, time, weather, compositor_, *showroom_));
    TracingWork traced;
    if (options_.tracing) {
        RS_ASSIGN_OR_RETURN(traced, trace(slot_transforms(*sequence_, frame_at(*sequence_, time)), camera));
    }
    RS_TRY(times_.draw(*showroom_, compositor_, camera, 1 / sequence_->frames_per_second, traced));
    for (std::string& warning : showroom_->take_warnings()) warnings_.push_back(std::move(warning));
    return {};
}

Status SequencePlayer::make_tracer() {
    std::vector<PlacedObject> objects;
    for (const DisplayedNode& node : *showroom_->nodes()) {
        if (node.object && !node.hidden) objects.push_back(*node.object);
    }
    RS_ASSIGN_OR_RETURN(auto tracer, TracedRenderer::create(scene_, objects, *options_.tracing));
    ++tracers_made_;
    tracer_.emplace(std::move(tracer));
    return {};
}

Result<TracingWork> SequencePlayer::trace(const SlotTransforms& moved, const Camera& camera) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    // Ray-space objects cannot move in a tracer, so it is rebuilt.
    if (!tracer_ || !moved.objects.empty()) {
        RS_TRY(make_tracer());
    }
    for (std::size_t slot = 0; slot < sequence_->slots.size(); ++slot) {
        const auto id = static_cast<std::uint32_t>(slot);
        // Nodes drawn by raster alone are not in the tracer.
        static_cast<void>(tracer_->move(id, moved.geometry[slot].value_or(hidden_transform_)));
    }
    tracer_->begin_image(camera);
    for (int pass = 0; pass < options_.passes; ++pass) tracer_->add_pass();
    compositor_.set_traced(std::make_shared<const Image<Rgba8>>(tracer_->image()), tracer_->object_irradiance());
    return TracingWork{std::chrono::duration<double>(Clock::now() - begin).count(), tracer_->passes()};
}

Camera SequencePlayer::camera(std::size_t number) const {
    if (options_.camera) return *options_.camera;
    return camera_of(*sequence_, number, compositor_.width(), compositor_.height());
}

Camera SequencePlayer::camera_at(double time) const {
    const auto camera = frame_at(*sequence_, time).camera;
    const auto number = std::min(static_cast<std::size_t>(time), frames() - 1);
    return options_.camera || !camera ? this->camera(number)
                                      : pixel_camera(*camera, compositor_.width(), compositor_.height());
}

Result<Image<Rgba8>> SequencePlayer::frame(std::size_t number) {
    if (options_.shutter == 0) {
        RS_TRY(draw(number, camera(number)));
        return compositor_.image();
    }
    LinearMean mean(compositor_.width(), compositor_.height());
    for (int i = 0; i < options_.shutter_samples; ++i) {
        const double time = static_cast<double>(number) + options_.shutter * (i + 0.5) / options_.shutter_samples;
        RS_TRY(draw_at(time, camera_at(time)));
        mean.add(compositor_.image());
    }
    return mean.image();
}

std::vector<std::string> SequencePlayer::take_warnings() {
    return std::exchange(warnings_, {});
}

}  // namespace rs::compositor
