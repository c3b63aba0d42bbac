#include "compositor/window/wall_visit.hpp"

#include "compositor/window/visit.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kHeadSpeed_m_per_s = 0.3;
constexpr double kStill_m = 0.01;  // noise of trackers, which would begin each traced image again
constexpr std::chrono::milliseconds kPauseBetweenImages(10);

// Head pose in the scene.
Visitor as_visitor(const Head& head, const RoomPose& place) {
    return {.eye = place.in_scene(head.position), .heading_rad = place.heading_rad + head.heading_rad};
}

// Room pose around a head with this pose in the scene.
RoomPose place_around(const Visitor& visitor, const Head& head, double units_per_metre) {
    RoomPose place;
    place.units_per_metre = units_per_metre;
    place.heading_rad = visitor.heading_rad - head.heading_rad;
    place.position = visitor.eye - units_per_metre * place.turned(head.position);
    return place;
}

}  // namespace

WallVisit::WallVisit(std::vector<Window> windows, std::unique_ptr<Showroom> showroom, const Scene& scene,
                     const WallVisitOptions& options)
    : windows_(std::move(windows)),
      showroom_(std::move(showroom)),
      options_(options),
      viewpoints_(scene.viewpoints),
      lights_(scene, options.frame.exposure_ev, "lights.json"),
      sharing_(options.sharing),
      object_count_(scene.objects.size()),
      head_(options.heads.front()),
      place_(options.place),
      traced_(options.traced),
      traced_walls_(std::make_shared<const Scene>(scene), options.tracing),
      last_(std::chrono::steady_clock::now()) {
    navigation_.speed = scene.navigation.speed;
}

WallVisit::~WallVisit() {
    windows_.front().make_current();
    compositor_.reset();
    // In reverse order of creation: GLFW then ends without a current context.
    while (!windows_.empty()) windows_.pop_back();
}

Result<std::unique_ptr<WallVisit>> WallVisit::create(const Scene& scene, std::unique_ptr<Showroom> showroom,
                                                     const WallVisitOptions& options) {
    RS_CHECK(!options.display.walls.empty() && !options.heads.empty());
    if (options.stereo == StereoForm::kFolders) {
        return Error{"--stereo folders is for -o; in windows give side-by-side, top-bottom or anaglyph"};
    }
    std::vector<Window> windows;
    for (const Wall& wall : options.display.walls) {
        WindowOptions window = options.window;
        window.title = wall.name;
        window.width = wall.width * (options.stereo == StereoForm::kSideBySide ? 2 : 1);
        window.height = wall.height * (options.stereo == StereoForm::kTopBottom ? 2 : 1);
        // Only one window waits for vertical synchronisation.
        window.vertical_sync = options.window.vertical_sync && windows.size() + 1 == options.display.walls.size();
        RS_ASSIGN_OR_RETURN(Window opened, Window::create(window));
        windows.push_back(std::move(opened));
    }
    windows.front().make_current();
    const Wall& first = options.display.walls.front();
    FrameOptions frame = options.frame;
    frame.width = first.width;
    frame.height = first.height;
    RS_ASSIGN_OR_RETURN(FrameCompositor compositor,
                        FrameCompositor::create(scene, showroom->engine(), showroom->nodes(), frame));
    std::unique_ptr<WallVisit> visit(new WallVisit(std::move(windows), std::move(showroom), scene, options));
    visit->compositor_.emplace(std::move(compositor));
    return visit;
}

void WallVisit::on_key(Key command) {
    const auto go_to = [&](std::size_t number) {
        viewpoint_ = number;
        const Viewpoint& there = viewpoints_[number];
        Camera camera;
        camera.world_from_camera = there.world_from_camera;
        place_ = place_of(camera, head_, place_.units_per_metre);
    };
    const std::size_t count = viewpoints_.size();
    switch (command) {
        case Key::kWalk:
        case Key::kFly:
        case Key::kExamine:
            moves_head_ = command == Key::kExamine;
            mode_ = command == Key::kFly ? NavigationMode::kFly : NavigationMode::kWalk;
            break;
        case Key::kNextViewpoint:
            if (count > 0) go_to((viewpoint_ + 1) % count);
            break;
        case Key::kPreviousViewpoint:
            if (count > 0) go_to((viewpoint_ + count - 1) % count);
            break;
        case Key::kHome:
            head_ = options_.heads.front();
            place_ = options_.place;
            break;
        case Key::kTrace:
            traced_ = !traced_;
            break;
        case Key::kScreenshot:
            save_requested_ = true;
            break;
        case Key::kQuit:
            quits_ = true;
            break;
        default:
            break;
    }
}

bool WallVisit::is_before_all_walls(const Head& head) const {
    const double half = options_.stereo ? options_.display.eye_distance_m / 2 : 0;
    return std::all_of(options_.display.walls.begin(), options_.display.walls.end(), [&](const Wall& wall) {
        return wall_camera(wall, head.eye(-half), place_).ok() && wall_camera(wall, head.eye(half), place_).ok();
    });
}

void WallVisit::move(double seconds) {
    const NavigationInput movement = input_.movement(seconds);
    if (options_.heads.size() > 1) {
        head_ = options_.heads[next_head_];
        next_head_ = (next_head_ + 1) % options_.heads.size();
    }
    if (const std::optional<Head> tracked = options_.tracked ? options_.tracked() : std::nullopt) {
        const bool is_still = traced_ && glm::distance(tracked->position, head_.position) < kStill_m;
        if (!is_still && is_before_all_walls(*tracked)) head_ = *tracked;
    }
    if (!moves_head_) {
        const double speed = navigation_.speed;
        const Visitor there = moved(as_visitor(head_, place_), mode_, movement, {.speed = speed});
        place_ = place_around(there, head_, place_.units_per_metre);
        return;
    }
    const Visitor in_room{.eye = head_.position, .heading_rad = head_.heading_rad, .pitch_rad = head_.pitch_rad};
    const Visitor there = moved(in_room, NavigationMode::kWalk, movement, {.speed = kHeadSpeed_m_per_s});
    Head head = head_;
    head.position = there.eye;
    head.heading_rad = there.heading_rad;
    head.pitch_rad = there.pitch_rad;
    if (is_before_all_walls(head)) head_ = head;  // walls block the head
}

// Takes over the leader's view.
Status WallVisit::follow() {
    const std::string note = sharing_.take_note();
    if (note != shared_note_ && !note.empty() && options_.warn) options_.warn({note});
    shared_note_ = note;
    if (!sharing_.follows()) return {};
    RS_ASSIGN_OR_RETURN(const SharedView* const view, sharing_.receive(lights_));
    if (view == nullptr) return {};
    const bool has_own_heads = options_.tracked || options_.heads.size() > 1;
    if (view->room) {
        place_ = view->room->place;
        if (!has_own_heads && is_before_all_walls(view->room->head)) head_ = view->room->head;
    } else {
        Camera camera;
        camera.world_from_camera = view->world_from_camera;
        place_ = place_of(camera, options_.display.head, place_.units_per_metre);
    }
    compositor_->set_wire_frame(view->wire_frame);
    if (std::exchange(options_.frame.shadows, view->shadows) != view->shadows) {
        const Status set = compositor_->set_shadows(view->shadows);
        if (!set && options_.warn) options_.warn({set.error().message});
    }
    traced_ = view->renderer > 0;
    if (traced_) traced_walls_.set_method(kTracedMethods[view->renderer - 1U].method);
    for (std::size_t i = 0; i < std::min(object_count_, view->turns_rad.size()); ++i) {
        compositor_->turn_object(i, view->turns_rad[i]);
    }
    if (!lights_.take_change()) return {};
    const double exposure_ev = lights_.edits().state().exposure_ev;
    traced_walls_.set_scene(lights_.scene(), exposure_ev);
    return compositor_->set_lights(*lights_.scene(), exposure_ev);
}

void WallVisit::share() {
    if (!sharing_.leads()) return;
    Viewpoint here;
    const Visitor visitor = as_visitor(head_, place_);
    sharing_.publish({.world_from_camera = viewpoint_of(visitor, here).world_from_camera,
                      .room = SharedView::Room{place_, head_},
                      .renderer = traced_ ? shared_number(options_.tracing.method) : std::uint8_t{0},
                      .exposure_ev = options_.frame.exposure_ev,
                      .shadows = options_.frame.shadows,
                      .wire_frame = options_.frame.wire_frame},
                     lights_);
}

// Cameras of all walls, with two eyes left and right.
Result<std::vector<Camera>> WallVisit::cameras() const {
    const double half = options_.stereo ? options_.display.eye_distance_m / 2 : 0;
    std::vector<Camera> cameras;
    for (const Wall& wall : options_.display.walls) {
        for (std::size_t eye = 0; eye < eyes(); ++eye) {
            RS_ASSIGN_OR_RETURN(const Camera camera, wall_camera(wall, head_.eye(eye == 0 ? -half : half), place_));
            cameras.push_back(camera);
        }
    }
    return cameras;
}

// Updates the traced images; true if the walls must be drawn for them, or if light is not traced.
bool WallVisit::refine(const std::vector<Camera>& cameras) {
    if (!traced_) {
        traced_walls_.stop();
        return true;
    }
    const Result<bool> changed = traced_walls_.refine(cameras, *showroom_);
    if (changed) return *changed;
    traced_ = false;
    traced_walls_.stop();
    if (options_.warn) options_.warn({changed.error().message});
    return true;
}

Result<Image<Rgba8>> WallVisit::draw_eye(const std::vector<Camera>& cameras, std::size_t number) {
    compositor_->set_traced(traced_walls_.image(number));
    return compositor_->compose(cameras[number]);
}

Result<Image<Rgba8>> WallVisit::image_of(const std::vector<Camera>& cameras, std::size_t wall) {
    const Camera& first = cameras[wall * eyes()];
    if (first.width != compositor_->width() || first.height != compositor_->height()) {
        RS_TRY(compositor_->resize(first.width, first.height));
    }
    if (!options_.stereo) return draw_eye(cameras, wall);
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> left, draw_eye(cameras, 2 * wall));
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> right, draw_eye(cameras, 2 * wall + 1));
    return stereo_image(*options_.stereo, left, right);
}

Status WallVisit::draw(const std::vector<Camera>& cameras) {
    windows_.front().make_current();
    images_.clear();
    for (std::size_t i = 0; i < windows_.size(); ++i) {
        RS_ASSIGN_OR_RETURN(Image<Rgba8> image, image_of(cameras, i));
        images_.push_back(std::move(image));
    }
    return {};
}

Status WallVisit::save_images() {
    for (std::size_t i = 0; i < images_.size(); ++i) {
        int number = shots_;
        const std::string prefix = "wall-" + options_.display.walls[i].name;
        const auto path = free_name(options_.images, prefix, ".png", number);
        RS_TRY(write_png(path, images_[i]));
    }
    return {};
}

Result<bool> WallVisit::step(std::optional<double> seconds) {
    const auto now = std::chrono::steady_clock::now();
    const double passed = seconds.value_or(std::chrono::duration<double>(now - last_).count());
    last_ = now;
    for (Window& window : windows_) {
        for (const Event& event : window.poll()) input_.take(event);
        quits_ = quits_ || window.should_close();
    }
    for (const Key command : input_.commands()) on_key(command);
    if (quits_) return false;
    move(passed);
    RS_TRY(follow());
    share();
    RS_TRY(showroom_->update(place_.in_scene(head_.position), passed));
    if (const std::vector<std::string> warnings = showroom_->take_warnings(); !warnings.empty() && options_.warn) {
        options_.warn(warnings);
    }
    RS_ASSIGN_OR_RETURN(const std::vector<Camera> here, cameras());
    if (refine(here) || images_.empty() || !showroom_->settled()) {
        RS_TRY(draw(here));
    } else {
        std::this_thread::sleep_for(kPauseBetweenImages);
    }
    for (std::size_t i = 0; i < windows_.size(); ++i) {
        const glm::ivec2 size = windows_[i].framebuffer_px();
        if (size.x < 1 || size.y < 1) continue;  // minimised
        windows_[i].make_current();
        gl::show_in_window(images_[i].view(), size.x, size.y);
        windows_[i].swap();
    }
    windows_.front().make_current();
    if (std::exchange(save_requested_, false)) {
        RS_TRY(save_images());
    }
    return true;
}

Status visit_walls(const Scene& scene, std::unique_ptr<Showroom> showroom, const WallVisitOptions& options) {
    RS_ASSIGN_OR_RETURN(const auto visit, WallVisit::create(scene, std::move(showroom), options));
    for (;;) {
        RS_ASSIGN_OR_RETURN(const bool goes_on, visit->step());
        if (!goes_on) return {};
    }
}

}  // namespace rs::compositor
