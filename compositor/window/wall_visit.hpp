#pragma once
// A visit with a window for each wall of a display: the room is driven through the scene, and the head moves in the
// room, by keys, by a list or by a tracker.
//
//     scene -> one compositor, wall by wall and eye by eye -> images -> the windows, each with a context of its own
//
// Keys: 1 drives the room along the ground, 2 also up and down, 3 moves the head in the room; page up and down, home:
// the scene's viewpoints; P writes what the windows show; escape leaves. For the main thread only.

#include "compositor/displays/stereo_image.hpp"
#include "compositor/displays/walls_file.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/viewer/views/navigation.hpp"
#include "compositor/window/visitor_input.hpp"
#include "compositor/window/window.hpp"
#include "rayspace/base/result.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct WallVisitOptions {
    WallDisplay display;      // windows have the walls' sizes
    std::vector<Head> heads;  // one, or one for each frame, again and again
    RoomPlace place;          // where the visit begins
    // Where a tracker has the head, in the room; nothing where it says nothing new. Asked once a frame; a head whose
    // eyes are not before all walls is passed over.
    std::function<std::optional<Head>()> tracked = nullptr;
    std::optional<StereoForm> stereo = std::nullopt;
    int samples = 4;
    double exposure_ev = 0;
    ObjectDepth object_depth = ObjectDepth::kPlane;
    int object_samples = FrameOptions{}.object_samples;
    std::filesystem::path images = ".";                                   // where P writes to
    std::function<void(const std::vector<std::string>&)> warn = nullptr;  // of objects that cannot be shown
    WindowOptions window = {};                                            // but for title and size
};

class WallVisit {
public:
    // Fails without a display, for StereoForm::kFolders, and where an eye is behind a wall.
    static Result<std::unique_ptr<WallVisit>> create(const Scene& scene, std::unique_ptr<Showroom> showroom,
                                                     const WallVisitOptions& options);
    ~WallVisit();

    // A frame of all walls. False when the visitor wants to leave. `seconds`: since the last frame, as a clock on the
    // wall says if not given.
    Result<bool> step(std::optional<double> seconds = std::nullopt);

    [[nodiscard]] std::vector<Window>& windows() { return windows_; }
    [[nodiscard]] const Head& head() const { return head_; }
    [[nodiscard]] const RoomPlace& place() const { return place_; }
    // Of the last frame, by wall, as the windows show them.
    [[nodiscard]] const std::vector<Image<Rgba8>>& images() const { return images_; }

private:
    WallVisit(std::vector<Window> windows, std::unique_ptr<Showroom> showroom, const Scene& scene,
              const WallVisitOptions& options);

    void obey(Key command);
    void move(double seconds);
    [[nodiscard]] bool sees_all_walls(const Head& head) const;
    Result<Image<Rgba8>> drawn(const Wall& wall, double offset_m);
    Result<Image<Rgba8>> image_of(const Wall& wall);

    std::vector<Window> windows_;  // the first one's context draws
    std::unique_ptr<Showroom> showroom_;
    std::optional<FrameCompositor> compositor_;
    WallVisitOptions options_;
    std::vector<Viewpoint> viewpoints_;
    std::size_t viewpoint_ = 0;
    NavigationSettings navigation_;
    VisitorInput input_;
    bool moves_head_ = false;
    NavigationMode mode_ = NavigationMode::kWalk;
    Head head_;
    std::size_t next_head_ = 0;
    RoomPlace place_;
    std::vector<Image<Rgba8>> images_;
    bool takes_images_ = false;
    bool leaves_ = false;
    int shots_ = 0;
    std::chrono::steady_clock::time_point last_;
};

// Until the visitor leaves.
Status visit_walls(const Scene& scene, std::unique_ptr<Showroom> showroom, const WallVisitOptions& options);

}  // namespace rs::compositor
