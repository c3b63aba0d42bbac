#include "encode/capture_set.hpp"

#include "encode/upright_resampling.hpp"
#include "rayspace/conventions.hpp"
#include "rayspace/picture_io.hpp"
#include "rayspace/ray_space.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rs::encode {
namespace {

constexpr double kSteepestPitch_rad = radians(60);

Result<Image<Rgba8>> read_captured_picture(const CaptureSet& set, int view) {
    const RigView& captured = set.captured.views[static_cast<std::size_t>(view)];
    const std::filesystem::path path = picture_path(set.folder, captured);
    Result<Image<Rgba8>> picture = read_picture(path);
    if (!picture) return picture;
    if (picture->width() != captured.camera.width || picture->height() != captured.camera.height) {
        return Error{path.string() + ": is " + std::to_string(picture->width()) + "x" +
                     std::to_string(picture->height()) + " pixels, but its frame in " + kRigFileName + " says " +
                     std::to_string(captured.camera.width) + "x" + std::to_string(captured.camera.height) +
                     "; make them agree"};
    }
    return picture;
}

// The names of lens distortion in rigs of NeRF tools; an object's pictures must be free of it.
std::string distortion_in(const nlohmann::json& extras) {
    for (const char* key : {"k1", "k2", "k3", "k4", "p1", "p2"}) {
        const auto found = extras.find(key);
        if (found != extras.end() && found->is_number() && found->get<double>() != 0) return key;
    }
    return "";
}

Status check_views(const CaptureSet& set) {
    const std::string where = (set.folder / kRigFileName).string();
    if (set.captured.views.empty()) return Error{where + ": holds no frames; a capture set needs at least one picture"};
    const Camera& first = set.captured.views.front().camera;
    for (std::size_t i = 0; i < set.captured.views.size(); ++i) {
        const RigView& view = set.captured.views[i];
        const std::filesystem::path path = picture_path(set.folder, view);
        if (view.camera.width != first.width || view.camera.height != first.height) {
            return Error{path.string() + ": is " + std::to_string(view.camera.width) + "x" +
                         std::to_string(view.camera.height) + " pixels, but the first picture is " +
                         std::to_string(first.width) + "x" + std::to_string(first.height) +
                         "; all pictures of an object must have one size"};
        }
        std::string distortion = distortion_in(set.captured.extras);
        if (distortion.empty()) distortion = distortion_in(view.extras);
        if (!distortion.empty()) {
            return Error{where + ": frame " + std::to_string(i) + " has lens distortion (" + distortion +
                         " is not 0); undistort the pictures first"};
        }
        if (std::abs(std::asin(std::clamp(view.camera.forward().y, -1.0, 1.0))) > kSteepestPitch_rad) {
            return Error{
                where + ": the camera of frame " + std::to_string(i) +
                " looks up or down by more than 60 degrees; such a picture cannot be made upright, leave it out"};
        }
    }
    return {};
}

// Reads every picture once and hands it to `use`, on all threads; the first error ends it.
Status for_each_picture(const CaptureSet& set, const char* label, Progress* progress,
                        const std::function<void(int, const Image<Rgba8>&)>& use) {
    const int count = static_cast<int>(set.captured.views.size());
    std::vector<std::optional<Error>> errors(static_cast<std::size_t>(count));
    std::atomic<bool> failed = false;
    if (progress != nullptr) progress->start(label, count);
    tbb::parallel_for(0, count, [&](int i) {
        if (failed) return;
        const Result<Image<Rgba8>> picture = read_captured_picture(set, i);
        if (!picture) {
            errors[static_cast<std::size_t>(i)] = picture.error();
            failed = true;
            return;
        }
        use(i, *picture);
        if (progress != nullptr) progress->advance();
    });
    if (progress != nullptr) progress->finish();
    for (const auto& error : errors) {
        if (error) return *error;
    }
    return {};
}

// Upright cameras of one size that see all that any picture shows of the object.
Status plan_upright_cameras(CaptureSet& set, const std::vector<PixelBox>& occupied) {
    PixelBox all;  // relative to the principal point
    for (std::size_t i = 0; i < set.captured.views.size(); ++i) {
        Camera upright = upright_camera(set.captured.views[i].camera);
        upright.fl_x = upright.fl_y = set.captured.views.front().camera.fl_x;
        upright.cx = upright.cy = 0;
        set.upright.views[i].camera = upright;
        if (!occupied[i].empty()) all.include(box_seen_by(upright, set.captured.views[i].camera, occupied[i]));
    }
    if (all.empty()) all = {0, 0, 1, 1};
    constexpr double kMargin_px = 2;
    const double left = std::floor(all.x0 - kMargin_px);
    const double top = std::floor(all.y0 - kMargin_px);
    // Even sizes: chroma is stored at half of them.
    const auto even = [](double size) { return 2 * static_cast<int>(std::ceil(size / 2)); };
    const double right = all.x1 + kMargin_px;
    const double bottom = all.y1 + kMargin_px;
    if (right - left > kMaxPictureSide_px || bottom - top > kMaxPictureSide_px) {
        return Error{(set.folder / kRigFileName).string() +
                     ": made upright, the pictures would be wider or higher than " +
                     std::to_string(kMaxPictureSide_px) + " pixels; crop the pictures or photograph from less above"};
    }
    set.width = even(right - left);
    set.height = even(bottom - top);
    for (RigView& view : set.upright.views) {
        view.camera.width = set.width;
        view.camera.height = set.height;
        view.camera.cx = -left;
        view.camera.cy = -top;
    }
    return {};
}

// The largest distance from Y of the vertical planes that bound the silhouettes: the radius of a cylinder that holds
// the visual hull.
double radius_from_silhouettes(const Rig& upright, const std::vector<PixelBox>& occupied) {
    double radius = 0;
    for (std::size_t i = 0; i < upright.views.size(); ++i) {
        if (occupied[i].empty()) continue;
        const Camera& camera = upright.views[i].camera;
        for (const double x : {occupied[i].x0, occupied[i].x1}) {
            const glm::dvec3 ray = camera.ray(x, camera.cy);
            const double across = ray.x * camera.centre().z - ray.z * camera.centre().x;
            radius = std::max(radius, std::abs(across) / std::hypot(ray.x, ray.z));
        }
    }
    return radius;
}

Status check_distances(const CaptureSet& set) {
    for (std::size_t i = 0; i < set.upright.views.size(); ++i) {
        const glm::dvec3 centre = set.upright.views[i].camera.centre();
        const double distance = std::hypot(centre.x, centre.z);
        if (distance < 1.2 * set.upright.object_radius || glm::length(centre) > 200 * set.upright.object_radius) {
            return Error{(set.folder / kRigFileName).string() + ": the camera of frame " + std::to_string(i) + " is " +
                         std::to_string(distance / set.upright.object_radius) +
                         " object radii from the Y axis, outside of 1.2..200; check object_radius (" +
                         std::to_string(set.upright.object_radius) +
                         ") and that the turntable's axis is the Y axis of the rig"};
        }
    }
    return {};
}

}  // namespace

Result<CaptureSet> open_capture_set(const std::filesystem::path& path, Progress* progress) {
    CaptureSet set;
    set.folder = std::filesystem::is_directory(path) ? path : path.parent_path();
    Result<Rig> rig = read_rig(path);
    if (!rig) return rig.error();
    set.captured = std::move(*rig);
    set.upright = set.captured;
    if (const Status status = check_views(set); !status) return status.error();
    set.width = set.captured.views.front().camera.width;
    set.height = set.captured.views.front().camera.height;
    set.resampled = !std::all_of(set.captured.views.begin(), set.captured.views.end(),
                                 [](const RigView& view) { return is_upright(view.camera); });

    if (set.resampled || set.captured.object_radius <= 0) {
        std::vector<PixelBox> occupied(set.captured.views.size());
        const Status status = for_each_picture(set, "measuring", progress, [&](int i, const Image<Rgba8>& picture) {
            occupied[static_cast<std::size_t>(i)] = occupied_box(picture);
        });
        if (!status) return status.error();
        if (set.resampled) {
            if (const Status planned = plan_upright_cameras(set, occupied); !planned) return planned.error();
            for (std::size_t i = 0; i < occupied.size(); ++i) {
                if (occupied[i].empty()) continue;
                occupied[i] = box_seen_by(set.upright.views[i].camera, set.captured.views[i].camera, occupied[i]);
            }
        }
        if (set.upright.object_radius <= 0) {
            set.upright.object_radius = radius_from_silhouettes(set.upright, occupied);
            if (set.upright.object_radius <= 0) {
                return Error{path.string() +
                             ": every picture is transparent; is the backdrop setting of the import right?"};
            }
        }
    }
    if (const Status status = check_distances(set); !status) return status.error();
    return set;
}

Result<Image<Rgba8>> read_upright_picture(const CaptureSet& set, int view) {
    Result<Image<Rgba8>> picture = read_captured_picture(set, view);
    if (!picture || !set.resampled) return picture;
    const auto i = static_cast<std::size_t>(view);
    return resampled_picture(set.upright.views[i].camera, set.captured.views[i].camera, *picture);
}

}  // namespace rs::encode
