#include "compositor/playback/sequence_player.hpp"

#include "compositor/viewer/views/framing.hpp"

#include <utility>

namespace rs::compositor {

std::optional<Weather> weather_of(const Sequence& sequence, const PlayerOptions& options) {
    return options.weather ? options.weather : sequence.weather;
}

Camera camera_of(const Sequence& sequence, std::size_t frame, int width, int height) {
    std::optional<SequenceCamera> camera = camera_of(sequence, frame);
    if (!camera) {
        camera = SequenceCamera{};
        const BoundingBox bounds = bounds_of(scene_at(sequence, 0));
        const double aspect = static_cast<double>(width) / height;
        camera->pose =
            bounds.empty() ? CameraPose{{0, 1.6, 6}, {0, 1, 0}} : framing_pose(bounds, camera->fov_x_rad, aspect);
    }
    return look_at_camera(camera->pose.eye, camera->pose.at, camera->fov_x_rad, width, height);
}

SequencePlayer::SequencePlayer(std::shared_ptr<const Sequence> sequence, std::unique_ptr<Showroom> showroom,
                               FrameCompositor compositor, const PlayerOptions& options)
    : sequence_(std::move(sequence)),
      options_(options),
      showroom_(std::move(showroom)),
      compositor_(std::move(compositor)) {}

Result<SequencePlayer> SequencePlayer::create(std::shared_ptr<const Sequence> sequence, const PlayerOptions& options) {
    const std::optional<Weather> weather = weather_of(*sequence, options);
    const Scene scene = weather ? in_weather(sequence->scene, *weather) : sequence->scene;
    auto showroom =
        std::make_unique<Showroom>(scene, ShowroomOptions{.memory_bytes = options.memory_bytes, .waits = true});
    if (const Status status = showroom->wait_for_all({0, 0, 0}); !status) return status.error();
    auto compositor = FrameCompositor::create(scene, showroom->engine(), showroom->nodes(), options.frame);
    if (!compositor) return compositor.error();
    SequencePlayer player(std::move(sequence), std::move(showroom), std::move(*compositor), options);
    player.scene_.lights = scene.lights;
    player.scene_.background = scene.background;
    player.scene_.fog = scene.fog;
    return player;
}

Status show_frame(const Sequence& sequence, std::size_t frame, const std::optional<Weather>& weather,
                  FrameCompositor& compositor, Showroom& showroom) {
    const MovedSlots moved = moved_slots(sequence, frame);
    for (std::size_t slot = 0; slot < sequence.slots.size(); ++slot) {
        for (const std::size_t node : sequence.slots[slot].geometry) {
            std::optional<glm::dmat4> matrix = moved.geometry[slot];
            if (matrix) *matrix = *matrix * sequence.scene.geometry[node].world_from_node;
            if (Status status = compositor.move_geometry(node, matrix); !status) return status;
        }
    }
    for (const auto& [node, chain] : moved.objects) showroom.move_object(node, chain);
    compositor.set_weather(weather, static_cast<double>(frame) / sequence.frames_per_second);
    return {};
}

Status SequencePlayer::draw(std::size_t number, const Camera& camera) {
    const auto weather = weather_of(*sequence_, options_);
    if (Status status = show_frame(*sequence_, number, weather, compositor_, *showroom_); !status) return status;
    if (options_.method) {
        if (Status status = trace(number, camera); !status) return status;
    }
    if (Status status = showroom_->update(camera.centre(), 1 / sequence_->frames_per_second); !status) return status;
    for (std::string& warning : showroom_->take_warnings()) warnings_.push_back(std::move(warning));
    return compositor_.draw(camera);
}

Status SequencePlayer::trace(std::size_t number, const Camera& camera) {
    Scene scene = scene_at(*sequence_, number);
    scene.lights = scene_.lights;
    std::vector<PlacedObject> objects;
    for (const ShownNode& node : *showroom_->nodes()) {
        if (node.object && !node.hidden) objects.push_back(*node.object);
    }
    auto tracer =
        TracedRenderer::create(scene, objects, {.method = *options_.method, .exposure_ev = options_.frame.exposure_ev});
    if (!tracer) return tracer.error();
    tracer->look(camera);
    for (int pass = 0; pass < options_.passes; ++pass) tracer->add_pass();
    compositor_.set_traced(std::make_shared<const Image<Rgba8>>(tracer->picture()));
    return {};
}

Result<Image<Rgba8>> SequencePlayer::frame(std::size_t number) {
    const Camera camera = camera_of(*sequence_, number, compositor_.width(), compositor_.height());
    if (Status status = draw(number, camera); !status) return status.error();
    return compositor_.picture();
}

std::vector<std::string> SequencePlayer::take_warnings() {
    return std::exchange(warnings_, {});
}

}  // namespace rs::compositor
