#include "capture/posed/posed_set.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/photos/segmentation/turn_silhouette.hpp"
#include "capture/posed/undistortion.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::capture {
namespace {

HullView hull_view_of(const Image<Rgba8>& image, const Camera& camera) {
    cv::Mat1b alpha, reduced;
    cv::extractChannel(mat_view(image.view()), alpha, 3);
    HullView view{hull_camera(camera), {}};
    cv::resize(alpha, reduced, {view.camera.width, view.camera.height}, 0, 0, cv::INTER_AREA);
    cv::threshold(reduced, view.mask, 127, 255, cv::THRESH_BINARY);
    return view;
}

// Rotation from the world of the cameras' file to the set: Y up, the first camera beside the axis above +Z.
glm::dmat3 set_from_world(const glm::dvec3& up, const glm::dvec3& centre, std::span<const Camera> cameras) {
    constexpr double kMinBeside = 0.05;  // of its distance
    glm::dvec3 z(0);
    for (const Camera& camera : cameras) {
        const glm::dvec3 off = camera.centre() - centre;
        z = off - glm::dot(off, up) * up;
        if (glm::length(z) > kMinBeside * glm::length(off)) break;
    }
    if (!(glm::length(z) > 0)) z = glm::cross(std::abs(up.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), up);
    z = glm::normalize(z);
    return glm::transpose(glm::dmat3(glm::cross(up, z), up, z));
}

nlohmann::json numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// JSON must be UTF-8, file names need not be.
std::string utf8_name(const std::string& name) {
    return nlohmann::json::parse(nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

Result<PosedImage> write_posed_image(const PosedCamera& posed, Image<Rgba8> foreground, const std::string& name,
                                     const std::filesystem::path& file) {
    TurnSilhouette silhouette(foreground.width(), foreground.height());
    silhouette.add(foreground);
    PosedImage written;
    if (silhouette.visible().empty()) return written;
    RS_ASSIGN_OR_RETURN(written.camera, undistorted_camera(posed, silhouette.visible(), name));
    written.was_distorted = !posed.distortion.is_pinhole();
    const Image<Rgba8> image = undistorted(posed, written.camera, std::move(foreground));
    HullView hull = hull_view_of(image, written.camera);
    if (cv::countNonZero(hull.mask) == 0) return written;
    written.hull = std::move(hull);
    RS_TRY(write_png(file, image));
    return written;
}

Rig posed_rig(std::span<const Camera> cameras, std::span<const std::string> names, const ObjectFrame& object) {
    const glm::dmat3 turn = set_from_world(object.up, object.origin, cameras);
    Rig rig;
    rig.object_radius = 1;
    rig.extras["posed"] = true;
    rig.extras["axis_note"] = "Y is up, the origin is the middle of the object's bounding cylinder";
    nlohmann::json& made = rig.extras["photo_import"];
    made["up"] = numbers(object.up);
    made["origin"] = numbers(object.origin);
    made["radius"] = object.radius;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        RigView view;
        view.camera = cameras[i];
        // Matrices from files are rotations within 1e-3; those of the set are within rounding.
        const glm::dmat3 rotation =
            glm::mat3_cast(glm::normalize(glm::quat_cast(turn * glm::dmat3(cameras[i].world_from_camera))));
        const glm::dvec3 centre = turn * (cameras[i].centre() - object.origin) / object.radius;
        view.camera.world_from_camera = glm::dmat4(rotation);
        view.camera.world_from_camera[3] = glm::dvec4(centre, 1);
        view.file_path = set_image_name(i);
        view.extras["source_file"] = utf8_name(names[i]);
        rig.views.push_back(std::move(view));
    }
    return rig;
}

}  // namespace rs::capture
