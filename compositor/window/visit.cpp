#include "compositor/window/visit.hpp"

#include "compositor/scene/light/lights_file.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "compositor/viewer/views/object_scene.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/input_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kTravelSeconds = 1;
constexpr double kNewsSeconds = 3;
constexpr double kErrorSeconds = 10;
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
      desk_(scene, options.frame.exposure_ev, options.lights),
      recorder_({.folder = options.images.string()}),
      sharing_(options.sharing),
      last_(std::chrono::steady_clock::now()) {
    navigation_.speed = scene.navigation.speed;
    if (const BoundingBox bounds = bounds_of(scene); !bounds.empty()) middle_ = bounds.middle();
    for (const RaySpaceNode& node : scene.objects) {
        names_.push_back(node.description.empty() ? node.file.stem().string() : node.description);
    }
    turns_rad_.resize(names_.size());
    visitor_ = visitor_at(options_.viewpoints.front(), middle_);
    panel_.mode = mode_ = mode_of(scene.navigation);
    panel_.speed = navigation_.speed;
    panel_.wire_frame = options.frame.wire_frame;
    panel_.shadows = options.frame.shadows;
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
    FrameOptions frame = options.frame;
    frame.width = size.x;
    frame.height = size.y;
    return FrameCompositor::create(scene, showroom.engine(), showroom.nodes(), frame);
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
    if (followed_) return camera_at(*followed_, compositor_.width(), compositor_.height());
    if (playback_) {
        if (const auto camera = playback_->camera(compositor_.width(), compositor_.height())) return *camera;
    }
    const Viewpoint here = viewpoint_of(visitor_, options_.viewpoints[viewpoint_]);
    return camera_at(here, compositor_.width(), compositor_.height());
}

void Visit::report(const std::string& news) {
    panel_.news = printable(news);
    news_seconds_ = kNewsSeconds;
}

void Visit::report(const Error& error) {
    report(error.message);
    news_seconds_ = kErrorSeconds;
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
    if (!object) {
        end_examining();
        return;
    }
    panel_.turn_rad = turns_rad_[*object];
    report(names_[*object]);
    panel_.mode = NavigationMode::kExamine;
    if (mode_ == panel_.mode) examine();
    apply_mode();
}

std::optional<glm::dvec3> Visit::centre_of_picked() const {
    if (panel_.picked < 0) return std::nullopt;
    const DisplayedNode& node = (*showroom_->nodes())[static_cast<std::size_t>(panel_.picked)];
    if (node.object) {
        const UprightExtent& extent = node.object->object->extent;
        return node.object->world_from_object.point({0, (extent.bottom + extent.top) / 2, 0});
    }
    if (!node.placeholder) return std::nullopt;
    return node.placeholder->world_from_object.point({0, (node.placeholder->bottom + node.placeholder->top) / 2, 0});
}

// Follows a mode that was selected by key, click or panel.
void Visit::apply_mode() {
    if (panel_.mode == mode_) return;
    const NavigationMode before = std::exchange(mode_, panel_.mode);
    if (mode_ != NavigationMode::kExamine) {
        before_examining_.reset();
        return;
    }
    before_examining_ = {before, visitor_.eye.y};
    examine();
}

// Turns to the picked object, which becomes the pivot; without one the surface ahead is.
void Visit::examine() {
    const std::optional<glm::dvec3> centre = centre_of_picked();
    if (!centre) {
        visitor_.pivot_distance = compositor_.distance_ahead().value_or(glm::length(middle_ - visitor_.eye));
    } else if (!is_frozen()) {
        begin_travel(facing(visitor_, *centre));
    }
}

// Returns to the mode before examine; a walk goes on at its height.
void Visit::end_examining() {
    panel_.picked = -1;
    if (!before_examining_) return;
    const BeforeExamining before = *before_examining_;
    panel_.mode = before.mode;
    apply_mode();
    travel_.reset();
    if (before.mode != NavigationMode::kWalk || visitor_.eye.y == before.eye_height || is_frozen()) return;
    Visitor to = visitor_;
    to.eye.y = before.eye_height;
    begin_travel(to);
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
            if (mode_ == panel_.mode) examine();
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
            if (dialog_.is_open()) {
                dialog_.close();
            } else if (!panel_.unconfirmed.empty()) {
                panel_.unconfirmed.clear();
            } else if (before_examining_) {
                end_examining();
            } else {
                window_.close();
            }
            break;
        default:
            break;
    }
}

// Fog, sky and wet or snowy surfaces are parts of the scene, so another weather needs another compositor.
Status Visit::change_weather() {
    desk_.set_scene(playback_->scene_in_weather());
    RS_ASSIGN_OR_RETURN(FrameCompositor compositor, compositor_of(*desk_.scene(), *showroom_));
    take_compositor(std::move(compositor));
    return {};
}

// A compositor with the current settings.
Result<FrameCompositor> Visit::compositor_of(const Scene& scene, Showroom& showroom) const {
    VisitOptions options = options_;
    options.frame.shadows = panel_.shadows;
    options.frame.exposure_ev = desk_.edits().state().exposure_ev;
    return make_compositor(scene, showroom, {compositor_.width(), compositor_.height()}, options);
}

void Visit::take_compositor(FrameCompositor compositor) {
    traced_view_.drop(compositor_);
    compositor_ = std::move(compositor);
    for (std::size_t i = 0; i < turns_rad_.size(); ++i) compositor_.turn_object(i, turns_rad_[i]);
}

void Visit::drop(const DropEvent& event) {
    for (const std::string& file : event.paths) take_file(file, event.at_px);
}

// Adds an object, loads lights, or opens a scene or sequence.
void Visit::take_file(const std::string& file, const glm::dvec2& at_px) {
    if (is_object_file(file) && options_.load_objects) {
        if (const Status added = add_object(file, at_px); !added) report(added.error());
    } else if (lower_case_extension(file) == ".json" && read_light_list(file)) {
        load_lights(file);
    } else {
        request_open(file);
    }
}

void Visit::load_lights(const std::string& file) {
    const std::string before = std::exchange(desk_.profile, file);
    const Status loaded = desk_.load();
    if (loaded) return;
    desk_.profile = before;
    report(loaded.error());
}

// The surface under the pointer, else the point of the ground plane at the height of the floor or the origin.
std::optional<glm::dvec3> Visit::ground_at(const glm::dvec2& at_px) {
    if (const auto seen = compositor_.surface_at(static_cast<int>(at_px.x), static_cast<int>(at_px.y))) {
        return seen->place;
    }
    const std::optional<Floor>& floor = desk_.scene()->floor;
    const double height = floor ? floor->height : 0;
    const Camera here = camera();
    const glm::dvec3 ray = here.ray(at_px.x, at_px.y);
    const double distance = (height - here.centre().y) / ray.y;
    if (!(distance > 0) || !(distance < 100 * std::max(std::abs(here.centre().y - height), 1.0))) return std::nullopt;
    return here.centre() + distance * ray;
}

// Stands an object on the surface at a pixel, in its own size. Changes nothing on failure.
Status Visit::add_object(const std::string& file, const glm::dvec2& at_px) {
    RS_ASSIGN_OR_RETURN(const double radius, own_radius(file));
    const std::optional<glm::dvec3> place = ground_at(at_px);
    if (!place) return Error{file + ": there is no surface under the pointer; drop it onto a floor or a table"};
    Scene scene = *desk_.scene();
    RaySpaceNode node;
    node.file = file;
    node.chain = {{.translation = *place, .scale = radius}};
    scene.objects.push_back(std::move(node));
    RS_ASSIGN_OR_RETURN(std::unique_ptr<Showroom> showroom, options_.load_objects(scene));
    RS_ASSIGN_OR_RETURN(FrameCompositor compositor, compositor_of(scene, *showroom));
    desk_.set_scene(scene);
    names_.push_back(std::filesystem::path(file).stem().string());
    turns_rad_.push_back(0);
    take_compositor(std::move(compositor));
    showroom_ = std::move(showroom);
    report(names_.back() + ": added");
    return {};
}

// Opens the file after the next frame, or once the loss of edited lights is confirmed.
void Visit::request_open(std::string file) {
    if (!options_.open) {
        report(Error{file + ": cannot be opened in this window; start rs-view with it"});
    } else if (desk_.has_unsaved_edits() && std::exchange(panel_.unconfirmed, file) != file) {
        report("edited lights are not saved; opening the file discards them");
    } else {
        panel_.unconfirmed.clear();
        report("opening " + file);
        opening_ = std::move(file);
    }
}

// Opens the requested file, which a frame has announced; false if it takes the place of the scene.
bool Visit::open_requested() {
    if (opening_.empty()) return true;
    const Status opened = options_.open(std::exchange(opening_, {}));
    if (opened) return false;
    report(opened.error());
    return true;
}

// Requests of toolbar, panels and file list.
void Visit::poll_panels() {
    if (std::exchange(panel_.choose_file, false)) dialog_.open(FileUse::kOpen, dialog_.folder());
    if (std::exchange(panel_.choose_folder, false)) dialog_.open(FileUse::kFolder, panel_.saved.folder);
    if (desk_.take_profile_request()) dialog_.open(FileUse::kLightList, desk_.profile);
    if (const auto choice = dialog_.take_choice()) take_choice(*choice);
    if (std::exchange(panel_.confirmed, false)) request_open(panel_.unconfirmed);
    if (playback_) {
        if (const std::string folder = playback_->take_folder(); !folder.empty()) request_open(folder);
    }
}

void Visit::take_choice(const FileDialog::Choice& choice) {
    switch (choice.use) {
        case FileUse::kLightList:
            desk_.profile = choice.path;
            break;
        case FileUse::kFolder:
            panel_.saved.folder = choice.path;
            break;
        case FileUse::kOpen:
            // Objects take the place of the scene; dropped ones are added to it.
            if (lower_case_extension(choice.path) == ".json" && read_light_list(choice.path)) {
                load_lights(choice.path);
            } else {
                request_open(choice.path);
            }
            break;
    }
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

// Takes over the leader's view; true if an object was turned. Keys that would change it have no effect.
Result<bool> Visit::follow() {
    if (const std::string note = sharing_.take_note(); !note.empty()) report(note);
    if (!sharing_.follows()) return false;
    RS_ASSIGN_OR_RETURN(const SharedView* const view, sharing_.receive(desk_));
    if (view == nullptr) return false;
    followed_ = options_.viewpoints.front();
    followed_->world_from_camera = view->world_from_camera;
    if (view->field_of_view_rad > 0) followed_->field_of_view_rad = view->field_of_view_rad;
    travel_.reset();
    visitor_ = visitor_at(*followed_, middle_);  // loads the objects around it
    panel_.shadows = view->shadows;
    panel_.wire_frame = view->wire_frame;
    panel_.traced = view->renderer > 0;
    if (panel_.traced) panel_.method = kTracedMethods[view->renderer - 1U].method;
    if (playback_) {
        playback_->stop();
        playback_->step(static_cast<int>(view->frame) - static_cast<int>(playback_->frame()));
        playback_->set_weather(view->weather);
    }
    panel_.picked = -1;
    bool turned = false;
    for (std::size_t i = 0; i < std::min(turns_rad_.size(), view->turns_rad.size()); ++i) {
        if (turns_rad_[i] == view->turns_rad[i]) continue;
        turns_rad_[i] = view->turns_rad[i];
        compositor_.turn_object(i, turns_rad_[i]);
        turned = true;
    }
    return turned;
}

void Visit::share() {
    if (!sharing_.leads()) return;
    const Viewpoint here = viewpoint_of(camera());
    SharedView view{.world_from_camera = here.world_from_camera,
                    .field_of_view_rad = here.field_of_view_rad,
                    .exposure_ev = desk_.edits().state().exposure_ev,
                    .shadows = panel_.shadows,
                    .wire_frame = panel_.wire_frame};
    if (panel_.traced) view.renderer = shared_number(panel_.method);
    if (playback_) {
        view.frame = static_cast<std::uint32_t>(playback_->frame());
        view.weather = playback_->weather();
    }
    view.turns_rad = turns_rad_;
    view.turns_rad.resize(std::min(turns_rad_.size(), kMaxSharedTurns));
    sharing_.publish(view, desk_);
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
    if (is_frozen()) {
        travel_.reset();
    } else if (travel_) {
        travel_->t += seconds / kTravelSeconds;
        visitor_ = between(travel_->from, travel_->to, travel_->t);
        if (travel_->t >= 1) travel_.reset();
    } else {
        visitor_ = moved(visitor_, mode_, movement, navigation_);
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
        if (const auto* const dropped = std::get_if<DropEvent>(&event)) drop(*dropped);
        // Keys that were held before a text field was opened are still released.
        const auto* const key = std::get_if<KeyEvent>(&event);
        if (key != nullptr && key->down && overlay_->captures_keys()) continue;
        if (!desk_.on_event(event, desk_view())) input_.take(event);
    }
    for (const Key command : input_.commands()) on_key(command);
    if (const auto next = std::exchange(panel_.next_viewpoint, std::nullopt)) go_to_viewpoint(*next);
    apply_mode();
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
        dialog_.draw();
    });
    if (panel_.picked != picked_before && panel_.picked >= 0) {
        panel_.turn_rad = turns_rad_[static_cast<std::size_t>(panel_.picked)];
        if (mode_ == NavigationMode::kExamine) examine();
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
    const bool turned_here = move(passed);
    RS_ASSIGN_OR_RETURN(const bool turned_there, follow());
    const bool turned = turned_here || turned_there;
    RS_TRY(apply_light_edits());
    RS_ASSIGN_OR_RETURN(const bool played, play(passed));
    compositor_.set_wire_frame(panel_.wire_frame);
    apply_shadow_setting();
    share();
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
    const bool goes_on = open_requested();
    poll_panels();
    return goes_on;
}

Result<Window> visit(Window window, const Scene& scene, std::unique_ptr<Showroom> showroom,
                     const VisitOptions& options) {
    RS_ASSIGN_OR_RETURN(std::unique_ptr<Visit> made,
                        Visit::create(std::move(window), scene, std::move(showroom), options));
    for (;;) {
        RS_ASSIGN_OR_RETURN(const bool goes_on, made->step());
        if (!goes_on) return Visit::leave(std::move(made));
    }
}

}  // namespace rs::compositor
