#include "encode/set/capture_set.hpp"

#include "encode/set/set_checks.hpp"
#include "encode/set/upright_resampling.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_reference.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/geometry/rig_conventions.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace rs::encode {
namespace {

// Multiplies alpha by the mask's luma: white is the object, as in nerfstudio's data.
Status apply_mask(const CaptureSet& set, const RigView& view, Image<Rgba8>& image) {
    const std::string reference = mask_path(view);
    if (reference.empty()) return {};
    const auto path = resolve_reference(reference, set.folder);
    if (!path) return Error{set.file.string() + ": mask_path '" + printable(reference) + "' is not a local file"};
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> mask, read_image(*path));
    if (mask.width() != image.width() || mask.height() != image.height()) {
        return Error{path->string() + ": is " + std::to_string(mask.width()) + "x" + std::to_string(mask.height()) +
                     " pixels, its image " + std::to_string(image.width()) + "x" + std::to_string(image.height()) +
                     "; make them agree"};
    }
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const Rgba8& m = mask.pixels()[i];
        const int luma = (m.r + 2 * m.g + m.b + 2) / 4;
        std::uint8_t& alpha = image.pixels()[i].a;
        alpha = static_cast<std::uint8_t>((alpha * luma + 127) / 255);
    }
    return {};
}

Result<Image<Rgba8>> read_captured_image(const CaptureSet& set, int view) {
    const RigView& captured = set.captured.views[static_cast<std::size_t>(view)];
    const std::filesystem::path path = image_path(set.folder, captured);
    Result<Image<Rgba8>> image = read_image(path);
    if (!image) return image;
    if (image->width() != captured.camera.width || image->height() != captured.camera.height) {
        return Error{path.string() + ": is " + std::to_string(image->width()) + "x" + std::to_string(image->height()) +
                     " pixels, but its frame in " + set.file.filename().string() + " states " +
                     std::to_string(captured.camera.width) + "x" + std::to_string(captured.camera.height) +
                     "; make them agree"};
    }
    RS_TRY(apply_mask(set, captured, *image));
    return image;
}

// Upright cameras with one focal length; their principal points are set by frame_upright_cameras.
void make_cameras_upright(Rig& rig) {
    const double fl_px = rig.views.front().camera.fl_x;
    for (RigView& view : rig.views) {
        view.camera = upright_camera(view.camera);
        view.camera.fl_x = view.camera.fl_y = fl_px;
        view.camera.cx = view.camera.cy = 0;
    }
}

// Bounding box of each image's visible pixels, in pixels of its upright camera.
Result<std::vector<PixelBox>> measure_images(const CaptureSet& set, Progress* progress) {
    std::vector<PixelBox> occupied(set.captured.views.size());
    const int count = static_cast<int>(occupied.size());
    RS_TRY(for_each_in_parallel(count, "measuring", progress, [&](int i) -> Status {
        const auto n = static_cast<std::size_t>(i);
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, read_captured_image(set, i));
        const Camera& captured = set.captured.views[n].camera;
        const auto box = set.resampled ? project_occupied_box(set.upright.views[n].camera, captured, image)
                                       : find_occupied_box(image);
        if (!box) {
            return Error{
                image_path(set.folder, set.captured.views[n]).string() +
                ": shows pixels beyond straight up or down, which an upright image cannot contain; leave it out"};
        }
        occupied[n] = *box;
        return {};
    }));
    return occupied;
}

// Sets one frame size for all upright cameras, large enough for all visible pixels; `occupied` is moved along.
Status frame_upright_cameras(CaptureSet& set, std::vector<PixelBox>& occupied) {
    PixelBox all{0, 0, 1, 1};  // not empty even if every image is
    bool first = true;
    for (const PixelBox& box : occupied) {
        if (box.empty()) continue;
        if (std::exchange(first, false)) all = box;
        all.include(box.x0, box.y0);
        all.include(box.x1, box.y1);
    }
    constexpr double kMargin_px = 2;
    const double left = std::floor(all.x0 - kMargin_px);
    const double top = std::floor(all.y0 - kMargin_px);
    const double width = all.x1 + kMargin_px - left;
    const double height = all.y1 + kMargin_px - top;
    if (width > kMaxImageSide_px - 1 || height > kMaxImageSide_px - 1) {
        return Error{set.file.string() + ": made upright, the images would be wider or higher than " +
                     std::to_string(kMaxImageSide_px) + " pixels; crop the images or capture from a lower elevation"};
    }
    // Even sizes, since chroma is stored at half of them.
    const auto even = [](double size) { return 2 * static_cast<int>(std::ceil(size / 2)); };
    set.width = even(width);
    set.height = even(height);
    for (std::size_t i = 0; i < occupied.size(); ++i) {
        Camera& camera = set.upright.views[i].camera;
        camera.width = set.width;
        camera.height = set.height;
        camera.cx = -left;
        camera.cy = -top;
        if (!occupied[i].empty()) occupied[i] = occupied[i].moved(-left, -top);
    }
    return {};
}

// The largest distance from the Y axis of the vertical planes that bound the silhouettes: the radius of a cylinder that
// contains the visual hull.
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
            return Error{set.file.string() + ": the camera of frame " + std::to_string(i) + " is " +
                         std::to_string(distance / set.upright.object_radius) + " object radii from the Y axis and " +
                         std::to_string(glm::length(centre) / set.upright.object_radius) +
                         " from the origin, outside of 1.2..200; check object_radius (" +
                         std::to_string(set.upright.object_radius) +
                         ") and that the turntable's axis is the Y axis of the rig"};
        }
    }
    return {};
}

}  // namespace

Result<CaptureSet> open_capture_set(const std::filesystem::path& path, Progress* progress) {
    CaptureSet set;
    set.file = rig_file(path);
    set.folder = set.file.parent_path();
    RS_ASSIGN_OR_RETURN(Rig rig, read_rig(path));
    for (const std::string& message : apply_rig_conventions(rig)) {
        set.warnings.push_back(set.file.string() + ": " + message);
    }
    remove_repeated_frames(rig, set.file, set.warnings);
    set.posed = is_posed(rig);
    if (set.posed) {
        RS_TRY(check_posed_views(rig, set.file));
        set.captured = std::move(rig);
        set.upright = set.captured;
        return set;
    }
    RS_TRY(check_views(rig, set.file));
    set.captured = std::move(rig);
    set.upright = set.captured;
    set.width = set.captured.views.front().camera.width;
    set.height = set.captured.views.front().camera.height;
    set.resampled = !std::all_of(set.captured.views.begin(), set.captured.views.end(),
                                 [](const RigView& view) { return is_upright(view.camera); });

    if (set.resampled) make_cameras_upright(set.upright);
    if (set.resampled || set.captured.object_radius <= 0) {
        RS_ASSIGN_OR_RETURN(std::vector<PixelBox> occupied, measure_images(set, progress));
        if (set.resampled) {
            RS_TRY(frame_upright_cameras(set, occupied));
        }
        if (set.upright.object_radius <= 0) {
            set.upright.object_radius = radius_from_silhouettes(set.upright, occupied);
            if (set.upright.object_radius <= 0) {
                return Error{path.string() + ": every image is transparent; check the backdrop setting of the import"};
            }
        }
    }
    RS_TRY(check_distances(set));
    const auto memory_bytes =
        static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::int64_t>(::sysconf(_SC_PAGE_SIZE));
    RS_TRY(check_memory(set, memory_bytes));
    return set;
}

Status check_memory(const CaptureSet& set, std::int64_t memory_bytes) {
    const std::int64_t needed_bytes =
        kEncodingBytesPerPixel * set.width * set.height * static_cast<std::int64_t>(set.upright.views.size());
    if (needed_bytes <= memory_bytes) return {};
    const auto gigabytes = [](std::int64_t bytes) {
        char text[32];
        std::snprintf(text, sizeof text, "%.1f", static_cast<double>(bytes) / 1e9);
        return std::string(text);
    };
    const Camera& captured = set.captured.views.front().camera;
    std::string why;
    if (set.resampled) {
        why = " (enlarged from " + std::to_string(captured.width) + "x" + std::to_string(captured.height) +
              " to be upright)";
    }
    return Error{set.file.string() + ": " + std::to_string(set.upright.views.size()) + " images of " +
                 std::to_string(set.width) + "x" + std::to_string(set.height) + why + " take about " +
                 gigabytes(needed_bytes) + " GB of memory, and this machine has " + gigabytes(memory_bytes) +
                 "; leave out the steepest views, or make the images smaller"};
}

std::string name_of(const CaptureSet& set) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(set.folder)).filename().string();
}

Result<Image<Rgba8>> read_upright_image(const CaptureSet& set, int view) {
    if (const auto found = set.completed.find(view); found != set.completed.end()) return Image<Rgba8>(found->second);
    const auto i = static_cast<std::size_t>(view);
    if (!set.synthesized.empty() && set.synthesized[i] != nullptr) return set.synthesized[i]->image();
    Result<Image<Rgba8>> image = read_captured_image(set, view);
    if (!image || !set.resampled) return image;
    return resample_image(set.upright.views[i].camera, set.captured.views[i].camera, *image);
}

CaptureSet select_views(const CaptureSet& set, std::span<const int> views) {
    RS_CHECK(!views.empty());
    CaptureSet chosen = set;
    const auto choose = [&](const Rig& from, Rig& to) {
        to.views.clear();
        for (const int view : views) {
            RS_CHECK(view >= 0 && static_cast<std::size_t>(view) < from.views.size());
            to.views.push_back(from.views[static_cast<std::size_t>(view)]);
        }
    };
    choose(set.captured, chosen.captured);
    choose(set.upright, chosen.upright);
    chosen.synthesized.clear();
    for (const int view : views) {
        if (!set.synthesized.empty()) chosen.synthesized.push_back(set.synthesized[static_cast<std::size_t>(view)]);
    }
    chosen.completed.clear();
    for (std::size_t n = 0; n < views.size(); ++n) {
        const auto found = set.completed.find(views[n]);
        if (found != set.completed.end()) chosen.completed.emplace(static_cast<int>(n), found->second);
    }
    return chosen;
}

}  // namespace rs::encode
