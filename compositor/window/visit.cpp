#include "compositor/window/visit.hpp"

#include "compositor/viewer/views/framing.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <cstdio>
#include <thread>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kTravelSeconds = 1;
constexpr double kNewsSeconds = 3;
constexpr std::chrono::milliseconds kPauseWhileTracing(10);
constexpr std::size_t kFramesCounted = 31;
constexpr double kRecordedFrames_per_s = 30;

}  // namespace

Visit::Visit(Window window, std::unique_ptr<Showroom> showroom, FrameCompositor compositor, const Scene& scene,
             const VisitOptions& options)
    : window_(std::move(window)),
      showroom_(std::move(showroom)),
      compositor_(std::move(compositor)),
      overlay_(std::make_unique<Overlay>(window_)),
      options_(options),
      traced_view_(options.tracing, options.first_grid_cells),
      desk_(scene, options.exposure_ev, options.lights),
      recorder_({.folder = options.images.string()}),
      last_(std::chrono::steady_clock::now()) {
    navigation_.speed = scene.navigation.speed;
    if (const BoundingBox bounds = bounds_of(scene); !bounds.empty()) middle_ = bounds.middle();
    for (const RaySpaceNode& node : scene.objects) {
        names_.push_back(node.description.empty() ? node.file.stem().string() : node.description);
    }
    turns_rad_.resize(names_.size());
    visitor_ = visitor_at(options_.viewpoints.front(), middle_);
    panel_.mode = mode_of(scene.navigation);
    panel_.speed = navigation_.speed;
    panel_.wire_frame = options.wire_frame;
    panel_.shadows = options.shadows;
    panel_.traced = options.traced;
    panel_.method = options.tracing.method;
    panel_.executor = options.executor;
    panel_.device = window_.context().device_name();
    if (options.sequence) playback_.emplace(options.sequence, options.weather);
    if (playback_ && !options.follows_sequence) playback_->release_camera();
    panel_.playback = playback_ ? &*playback_ : nullptr;
    panel_.scene = printable(options.scene_name);
    panel_.saved.folder = options.images.string();
    for (std::size_t i = 0; i < options.viewpoints.size(); ++i) panel_.viewpoints.push_back(viewpoint_name(i));
}

Result<FrameCompositor> Visit::make_compositor(const Scene& scene, Showroom& showroom, const glm::ivec2& size,
                                               const VisitOptions& options) {
    return FrameCompositor::create(scene, showroom.engine(), showroom.nodes(),
                                   {.width = size.x,
                                    .height = size.y,
                                    .samples = options.samples,
                                    .shadows = options.shadows,
                                    .exposure_ev = options.exposure_ev,
                                    .relighting = options.tracing.relighting,
                                    .object_depth = options.object_depth,
                                    .object_samples = options.object_samples,
                                    .upright_images = true});
}

Result<std::unique_ptr<Visit>> Visit::create(Window window, const Scene& scene, std::unique_ptr<Showroom> showroom,
                                             const VisitOptions& options) {
    RS_CHECK(!options.viewpoints.empty());
    const glm::ivec2 size = glm::max(window.framebuffer_px(), glm::ivec2(1));
    RS_ASSIGN_OR_RETURN(FrameCompositor compositor, make_compositor(scene, *showroom, size, options));
    return std::unique_ptr<Visit>(
        new Visit(std::move(window), std::move(showroom), std::move(compositor), scene, options));
}

Camera Visit::camera() const {
    if (playback_) {
        if (const auto camera = playback_->camera(compositor_.width(), compositor_.height())) return *camera;
    }
    const Viewpoint here = viewpoint_of(visitor_, options_.viewpoints[viewpoint_]);
    return camera_at(here, compositor_.width(), compositor_.height());
}

void Visit::report(const std::string& news) {
    panel_.news = news;
    news_seconds_ = kNewsSeconds;
}

void Visit::begin_travel(const Visitor& to) {
    travel_ = {visitor_, to, 0};
}

void Visit::go_to_viewpoint(std::size_t number) {
    viewpoint_ = number;
    panel_.viewpoint = number;
    if (playback_) playback_->release_camera();
    begin_travel(visitor_at(options_.viewpoints[number], middle_));
    report(viewpoint_name(number));
}

std::string Visit::viewpoint_name(std::size_t number) const {
    const std::string name = printable(options_.viewpoints[number].description);
    return name.empty() ? "viewpoint " + std::to_string(number + 1) : name;
}

void Visit::pick(const glm::dvec2& at_px) {
    const std::optional<std::size_t> object =
        compositor_.object_at(static_cast<int>(at_px.x), static_cast<int>(at_px.y));
    panel_.picked = object ? static_cast<int>(*object) : -1;
    if (!object) return;
    panel_.turn_rad = turns_rad_[*object];
    report(names_[*object]);
}

void Visit::on_key(Key command) {
    const std::size_t count = options_.viewpoints.size();
    if (desk_.on_key(command)) return;
    switch (command) {
        case Key::kWalk:
            panel_.mode = NavigationMode::kWalk;
            break;
        case Key::kFly:
            panel_.mode = NavigationMode::kFly;
            break;
        case Key::kExamine:
            panel_.mode = NavigationMode::kExamine;
            visitor_.pivot_distance = compositor_.distance_ahead().value_or(glm::length(middle_ - visitor_.eye));
            break;
        case Key::kNextViewpoint:
            go_to_viewpoint((viewpoint_ + 1) % count);
            break;
        case Key::kPreviousViewpoint:
            go_to_viewpoint((viewpoint_ + count - 1) % count);
            break;
        case Key::kHome:
            go_to_viewpoint(0);
            break;
        case Key::kHelp:
            panel_.show_help = !panel_.show_help;
            break;
        case Key::kPanel:
            panel_.show_panel = !panel_.show_panel;
            break;
        case Key::kWireFrame:
            panel_.wire_frame = !panel_.wire_frame;
            break;
        case Key::kShadows:
            panel_.shadows = !panel_.shadows;
            break;
        case Key::kTrace:
            panel_.traced = !panel_.traced;
            break;
        case Key::kScreenshot:
            panel_.take_screenshot = true;
            break;
        case Key::kPlay:
            if (playback_) playback_->toggle();
            break;
        case Key::kFrameBack:
        case Key::kFrameOn:
            if (!playback_) break;
            playback_->stop();
            playback_->step(command == Key::kFrameOn ? 1 : -1);
            break;
        case Key::kRecord:
            panel_.recording = !panel_.recording;
            break;
        case Key::kQuit:
            window_.close();
            break;
        default:
            break;
    }
}

// Fog, sky and wet or snowy surfaces are parts of the scene, so another weather needs another compositor.
Status Visit::change_weather() {
    desk_.set_scene(playback_->scene_in_weather());
    VisitOptions options = options_;
    options.shadows = panel_.shadows;
    options.exposure_ev = desk_.edits().state().exposure_ev;
    const glm::ivec2 size(compositor_.width(), compositor_.height());
    traced_view_.drop(compositor_);
    RS_ASSIGN_OR_RETURN(FrameCompositor compositor, make_compositor(*desk_.scene(), *showroom_, size, options));
    compositor_ = std::move(compositor);
    for (std::size_t i = 0; i < turns_rad_.size(); ++i) compositor_.turn_object(i, turns_rad_[i]);
    return {};
}

// Advances the sequence; true if another frame of it is shown.
Result<bool> Visit::play(double seconds) {
    if (!playback_) return false;
    if (playback_->take_quit()) window_.close();
    if (playback_->take_weather_change()) {
        RS_TRY(change_weather());
    }
    if (panel_.traced && !playback_->saving()) playback_->stop();
    if (playback_->saved_all()) {
        playback_->end_saving();
        panel_.recording = false;
    }
    if (playback_->saving()) {
        panel_.traced = false;
        panel_.recording = true;
    }
    const bool other = playback_->advance(seconds);
    if (!other) return false;
    RS_TRY(playback_->show(compositor_, *showroom_));
    traced_view_.drop(compositor_);
    return true;
}

void Visit::take_screenshots() {
    recorder_.set_names(panel_.saved);
    if (playback_ && playback_->take_jpeg()) report(recorder_.write_jpeg_screenshot(compositor_.image()));
    if (std::exchange(panel_.take_screenshot, false)) report(recorder_.write_png_screenshot(compositor_.image()));
}

void Visit::record() {
    if (panel_.recording && !recorder_.is_recording()) {
        const double rate = playback_ && playback_->saving() ? playback_->frames_per_second() : kRecordedFrames_per_s;
        const Result<std::string> begun = recorder_.begin_video(compositor_.width(), compositor_.height(), rate);
        report(begun ? *begun : begun.error().message);
        panel_.recording = begun.ok();
        if (!begun && playback_ && playback_->saving()) playback_->end_saving();
    }
    if (!recorder_.is_recording()) return;
    if (!panel_.recording) {
        report(recorder_.end_video());
        return;
    }
    if (Status status = recorder_.add_frame(compositor_.image()); !status) {
        panel_.recording = false;
        if (playback_ && playback_->saving()) playback_->end_saving();
        report(status.error().message);
    }
}

void Visit::refresh_panel(double seconds) {
    frame_seconds_.push_back(seconds);
    if (frame_seconds_.size() > kFramesCounted) frame_seconds_.erase(frame_seconds_.begin());
    const FrameStatistics& statistics = compositor_.statistics();
    panel_.frame_ms = 1e3 * median(frame_seconds_);
    panel_.geometry_ms = 1e3 * statistics.geometry_s;
    panel_.engine_ms = 1e3 * statistics.engine_s;
    panel_.upload_ms = 1e3 * statistics.upload_s;
    panel_.composite_ms = 1e3 * statistics.composite_s;
    panel_.objects.resize(names_.size());
    for (std::size_t i = 0; i < names_.size(); ++i) {
        const NodeStatistics& node = statistics.nodes[i];
        panel_.objects[i] = {names_[i], node.in_view, node.width, node.height, 1e3 * node.engine_s, {}};
        if (!node.in_view && !(*showroom_->nodes())[i].object) panel_.objects[i].absence = showroom_->absence(i);
    }
    panel_.views_by_board = statistics.nodes_by_board;
    panel_.views_by_core = statistics.nodes_rendered - statistics.nodes_by_board;
    const CacheStatistics store = showroom_->statistics();
    panel_.memory_mib = static_cast<double>(store.used_bytes) / (1 << 20);
    panel_.budget_mib = static_cast<double>(store.budget_bytes) / (1 << 20);
    if ((news_seconds_ -= seconds) <= 0) panel_.news.clear();
}

// Loads and drops objects for the camera's position, and reports those that cannot be shown.
Status Visit::poll_streaming(double seconds) {
    const std::optional<glm::dvec3> destination = travel_ ? std::optional(travel_->to.eye) : std::nullopt;
    if (Status status = showroom_->update(visitor_.eye, seconds, destination); !status) return status;
    const std::vector<std::string> warnings = showroom_->take_warnings();
    if (warnings.empty()) return {};
    if (options_.warn) options_.warn(warnings);
    report(warnings.back());
    return {};
}

// Moves the camera; true if an object was turned.
bool Visit::move(double seconds) {
    navigation_.speed = panel_.speed;
    const NavigationInput movement = input_.movement(seconds);
    if (panel_.traced && !panel_.walk_on) {
        travel_.reset();
    } else if (travel_) {
        travel_->t += seconds / kTravelSeconds;
        visitor_ = between(travel_->from, travel_->to, travel_->t);
        if (travel_->t >= 1) travel_.reset();
    } else {
        visitor_ = moved(visitor_, panel_.mode, movement, navigation_);
    }
    if (panel_.picked < 0) return false;
    const auto picked = static_cast<std::size_t>(panel_.picked);
    const bool turned = turns_rad_[picked] != panel_.turn_rad;
    turns_rad_[picked] = panel_.turn_rad;
    compositor_.turn_object(picked, panel_.turn_rad);
    return turned;
}

EditorView Visit::desk_view() {
    return {camera(), [this](const glm::dvec2& at) {
                return compositor_.surface_at(static_cast<int>(at.x), static_cast<int>(at.y));
            }};
}

void Visit::handle_events() {
    for (const Event& event : window_.poll()) {
        const bool of_mouse = std::holds_alternative<WheelEvent>(event) ||
                              (std::holds_alternative<ButtonEvent>(event) && std::get<ButtonEvent>(event).down);
        if (of_mouse && overlay_->captures_mouse()) continue;
        // Keys that were held before a text field was opened are still released.
        const auto* const key = std::get_if<KeyEvent>(&event);
        if (key != nullptr && key->down && overlay_->captures_keys()) continue;
        if (!desk_.on_event(event, desk_view())) input_.take(event);
    }
    for (const Key command : input_.commands()) on_key(command);
    if (const auto next = std::exchange(panel_.next_viewpoint, std::nullopt)) go_to_viewpoint(*next);
}

Status Visit::resize_if_needed(const glm::ivec2& size) {
    if (size.x == compositor_.width() && size.y == compositor_.height()) return {};
    if (recorder_.is_recording()) panel_.recording = false;  // a video has one size
    if (playback_ && playback_->saving()) playback_->end_saving();
    return compositor_.resize(size.x, size.y);
}

// Gives edited lights to both renderers.
Status Visit::apply_light_edits() {
    desk_.update(desk_view());
    if (std::string news = desk_.take_message(); !news.empty()) report(news);
    if (!desk_.take_change()) return {};
    traced_view_.set_lights(lighting_to_trace());
    return compositor_.set_lights(*desk_.scene(), desk_.edits().state().exposure_ev);
}

void Visit::apply_shadow_setting() {
    const Status status = compositor_.set_shadows(panel_.shadows);
    if (status) return;
    panel_.shadows = compositor_.shadows();
    report(status.error().message);
}

// The scene of the sequence's frame, or the one that was loaded, with the edited lights.
Refinement::Lighting Visit::lighting_to_trace() const {
    const double exposure_ev = desk_.edits().state().exposure_ev;
    if (!playback_) return {desk_.scene(), exposure_ev};
    return {std::make_shared<const Scene>(playback_->scene(*desk_.scene())), exposure_ev};
}

// Updates the traced image; true if a frame must be drawn for it, or if light is not traced.
bool Visit::refine(const Camera& here) {
    if (!panel_.traced) {
        traced_view_.stop(compositor_);
        return true;
    }
    const Result<bool> changed = traced_view_.refine(
        here, panel_.method, *showroom_, [this] { return lighting_to_trace(); }, compositor_);
    panel_.passes = traced_view_.passes();
    if (changed) return *changed;
    panel_.traced = false;
    report(changed.error().message);
    return true;
}

Status Visit::show(const glm::ivec2& size) {
    if (!desk_.is_open()) {
        compositor_.show_in_window(size.x, size.y);
        return {};
    }
    if (Status drawn = compositor_.draw_handles(desk_.strokes(camera())); !drawn) return drawn;
    compositor_.handles()->shown().show_in_window(size.x, size.y);
    return {};
}

void Visit::draw_panels() {
    const int picked_before = panel_.picked;
    overlay_->draw(panel_, [this] {
        if (desk_.is_open()) light_panel_.draw(desk_, desk_view());
    });
    if (panel_.picked != picked_before && panel_.picked >= 0) {
        panel_.turn_rad = turns_rad_[static_cast<std::size_t>(panel_.picked)];
    }
}

Result<bool> Visit::step(std::optional<double> seconds) {
    const auto now = std::chrono::steady_clock::now();
    const double passed = seconds.value_or(std::chrono::duration<double>(now - last_).count());
    last_ = now;
    handle_events();
    if (window_.should_close()) return false;
    const glm::ivec2 size = window_.framebuffer_px();
    if (size.x < 1 || size.y < 1) return true;  // the window is minimized
    RS_TRY(resize_if_needed(size));
    RS_TRY(apply_light_edits());
    const bool turned = move(passed);
    RS_ASSIGN_OR_RETURN(const bool played, play(passed));
    if (const std::string folder = playback_ ? playback_->take_folder() : ""; !folder.empty() && options_.open) {
        options_.open(folder);
        return false;
    }
    compositor_.set_wire_frame(panel_.wire_frame);
    apply_shadow_setting();
    RS_TRY(poll_streaming(passed));

    const Camera here = camera();
    if (!playback_) {
        traced_view_.prepare_when_idle(here, passed, *showroom_, names_.size(), [this] { return lighting_to_trace(); });
    }
    // A traced view is drawn again only if it has improved, or if something in it may have changed.
    if (refine(here) || turned || played || !showroom_->settled()) {
        RS_TRY(compositor_.draw(traced_view_.camera_of_image().value_or(here)));
    } else {
        std::this_thread::sleep_for(kPauseWhileTracing);
    }
    if (const auto click = input_.click()) pick(*click);
    take_screenshots();
    record();
    refresh_panel(passed);
    RS_TRY(show(size));
    draw_panels();
    window_.swap();
    return true;
}

Status visit(Window window, const Scene& scene, std::unique_ptr<Showroom> showroom, const VisitOptions& options) {
    RS_ASSIGN_OR_RETURN(const std::unique_ptr<Visit> made,
                        Visit::create(std::move(window), scene, std::move(showroom), options));
    for (;;) {
        RS_ASSIGN_OR_RETURN(const bool goes_on, made->step());
        if (!goes_on) return {};
    }
}

}  // namespace rs::compositor
