#include "compositor/window/wall_visit.hpp"

#include "compositor/window/visit.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kHeadSpeed_m_per_s = 0.3;

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
      head_(options.heads.front()),
      place_(options.place),
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
    RS_ASSIGN_OR_RETURN(FrameCompositor compositor,
                        FrameCompositor::create(scene, showroom->engine(), showroom->nodes(),
                                                {.width = first.width,
                                                 .height = first.height,
                                                 .samples = options.samples,
                                                 .wire_frame = options.wire_frame,
                                                 .shadows = options.shadows,
                                                 .exposure_ev = options.exposure_ev,
                                                 .relighting = options.relighting,
                                                 .object_depth = options.object_depth,
                                                 .object_samples = options.object_samples,
                                                 .upright_images = true}));
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
        if (is_before_all_walls(*tracked)) head_ = *tracked;
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

Result<Image<Rgba8>> WallVisit::draw_eye(const Wall& wall, double offset_m) {
    RS_ASSIGN_OR_RETURN(const Camera camera, wall_camera(wall, head_.eye(offset_m), place_));
    return compositor_->compose(camera);
}

Result<Image<Rgba8>> WallVisit::image_of(const Wall& wall) {
    if (wall.width != compositor_->width() || wall.height != compositor_->height()) {
        RS_TRY(compositor_->resize(wall.width, wall.height));
    }
    if (!options_.stereo) return draw_eye(wall, 0);
    const double half = options_.display.eye_distance_m / 2;
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> left, draw_eye(wall, -half));
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> right, draw_eye(wall, half));
    return stereo_image(*options_.stereo, left, right);
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
    RS_TRY(showroom_->update(place_.in_scene(head_.position), passed));
    if (const std::vector<std::string> warnings = showroom_->take_warnings(); !warnings.empty() && options_.warn) {
        options_.warn(warnings);
    }
    windows_.front().make_current();
    images_.clear();
    for (const Wall& wall : options_.display.walls) {
        RS_ASSIGN_OR_RETURN(Image<Rgba8> image, image_of(wall));
        images_.push_back(std::move(image));
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
        for (std::size_t i = 0; i < images_.size(); ++i) {
            int number = shots_;
            const std::string prefix = "wall-" + options_.display.walls[i].name;
            const auto path = free_name(options_.images, prefix, ".png", number);
            RS_TRY(write_png(path, images_[i]));
        }
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
