#pragma once
// Visit with a window per wall of a display: the room moves through the scene, and the head moves in the room by keys,
// from a list, or by a tracker.
//
//     scene -> one compositor, per wall and eye -> images -> windows, each with its own context
//
// Keys: 1 moves the room along the ground, 2 also vertically, 3 moves the head in the room; page up/down, home:
// viewpoints of the scene; P saves the windows' images; escape quits. Main thread only.

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
    std::vector<Head> heads;  // one pose, or one per frame, repeated
    RoomPose place;           // initial room pose
    /// Tracked head pose in the room; nullopt if unchanged. Called once per frame; poses with an eye behind a wall are
    /// ignored.
    std::function<std::optional<Head>()> tracked = nullptr;
    std::optional<StereoForm> stereo = std::nullopt;
    int samples = 4;
    bool wire_frame = false;
    bool shadows = false;
    double exposure_ev = 0;
    Relighting relighting = Relighting::kOff;
    ObjectDepth object_depth = ObjectDepth::kPlane;
    int object_samples = FrameOptions{}.object_samples;
    std::filesystem::path images = ".";                                   // folder for P
    std::function<void(const std::vector<std::string>&)> warn = nullptr;  // objects that cannot be displayed
    WindowOptions window = {};                                            // except title and size
};

class WallVisit {
public:
    /// Fails without a display, for StereoForm::kFolders, and if an eye is behind a wall.
    static Result<std::unique_ptr<WallVisit>> create(const Scene& scene, std::unique_ptr<Showroom> showroom,
                                                     const WallVisitOptions& options);
    ~WallVisit();

    /// Draws a frame of all walls.
    /// \param seconds since the last frame; measured if not given.
    /// \return false if the visitor quits.
    Result<bool> step(std::optional<double> seconds = std::nullopt);

    [[nodiscard]] std::vector<Window>& windows() { return windows_; }
    [[nodiscard]] const Head& head() const { return head_; }
    [[nodiscard]] const RoomPose& place() const { return place_; }
    /// Last frame by wall, as displayed.
    [[nodiscard]] const std::vector<Image<Rgba8>>& images() const { return images_; }

private:
    WallVisit(std::vector<Window> windows, std::unique_ptr<Showroom> showroom, const Scene& scene,
              const WallVisitOptions& options);

    void on_key(Key command);
    void move(double seconds);
    [[nodiscard]] bool is_before_all_walls(const Head& head) const;
    Result<Image<Rgba8>> draw_eye(const Wall& wall, double offset_m);
    Result<Image<Rgba8>> image_of(const Wall& wall);

    std::vector<Window> windows_;  // the first one's context renders
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
    RoomPose place_;
    std::vector<Image<Rgba8>> images_;
    bool save_requested_ = false;
    bool quits_ = false;
    int shots_ = 0;
    std::chrono::steady_clock::time_point last_;
};

/// Runs until the visitor quits.
Status visit_walls(const Scene& scene, std::unique_ptr<Showroom> showroom, const WallVisitOptions& options);

}  // namespace rs::compositor
