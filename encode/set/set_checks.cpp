#include "encode/set/set_checks.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/geometry/rig_conventions.hpp"
#include "rayspace/geometry/rig_lens.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace rs::encode {
namespace {

using nlohmann::json;

bool is_nonzero(const json& value) {
    return (value.is_boolean() && value.get<bool>()) || (value.is_number() && value.get<double>() != 0);
}

// Reason why the lens is not a pinhole without distortion; nullopt if it is one.
std::optional<std::string> lens_fault(const json& file, const json& frame) {
    const StatedLens lens = stated_lens(file, frame);
    if (lens.kind != LensKind::kPinhole) return lens.stated + " is not a pinhole";
    for (const std::string_view key : kDistortionKeys) {
        if (is_nonzero(stated_key(file, frame, key))) return "lens distortion: " + std::string(key) + " is not 0";
    }
    return std::nullopt;
}

Status check_lenses(const Rig& rig, const std::filesystem::path& file) {
    const std::string where = file.string();
    if (rig.views.empty()) return Error{where + ": has no frames; a capture set needs at least one image"};
    constexpr const char* kUndistort = "; undistort the images first";
    if (const auto fault = lens_fault(rig.extras, json::object())) return Error{where + ": " + *fault + kUndistort};
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        if (const auto fault = lens_fault(json::object(), rig.views[i].extras)) {
            return Error{where + ": frame " + std::to_string(i) + ": " + *fault + kUndistort};
        }
    }
    return {};
}

Status check_alpha(const Rig& rig, const std::filesystem::path& file) {
    for (const RigView& view : rig.views) {
        if (!mask_path(view).empty()) return {};
        // Missing images are reported when they are read.
        const auto info = read_image_info(image_path(file.parent_path(), view));
        if (!info || info->has_alpha) return {};
    }
    return Error{
        file.string() +
        ": its images have no alpha channel, so the object cannot be told from the background; add \"mask_path\" "
        "to the frames or alpha to the images, or import the photos by rs-capture import"};
}

}  // namespace

void remove_repeated_frames(Rig& rig, const std::filesystem::path& file, std::vector<std::string>& warnings) {
    std::map<std::string, std::size_t> first_of;  // index in `kept`
    std::vector<RigView> kept;
    std::vector<std::string> repeated, shared;
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        RigView& view = rig.views[i];
        const auto [known, is_new] = first_of.try_emplace(view.file_path, kept.size());
        const std::string place = "frame " + std::to_string(i) + " (" + printable(view.file_path) + ")";
        if (!is_new && kept[known->second].camera.world_from_camera == view.camera.world_from_camera) {
            repeated.push_back(place);
            continue;
        }
        if (!is_new) shared.push_back(place);
        kept.push_back(std::move(view));
    }
    rig.views = std::move(kept);
    const auto warn = [&](const std::vector<std::string>& places, const std::string& fault) {
        if (places.empty()) return;
        warnings.push_back(file.string() + ": " + std::to_string(places.size()) +
                           (places.size() == 1 ? " frame has" : " frames have") +
                           " the image of an earlier frame and " + fault + ": " + listed(places, 3));
    };
    warn(repeated, "its camera; left out");
    warn(shared, "another camera; correct one of them");
}

bool is_posed(const Rig& rig) {
    const auto stated = rig.extras.find(kPosedKey);
    if (stated != rig.extras.end() && stated->is_boolean()) return stated->get<bool>();
    const auto elevation_rad = [&](int view) {
        const glm::dvec3 centre = rig.views[static_cast<std::size_t>(view)].camera.centre();
        return std::atan2(centre.y, std::hypot(centre.x, centre.z));
    };
    const std::vector<ViewRing> rings = find_rings(rig);
    const auto is_apart = [](const ViewRing& lower, const ViewRing& upper) {
        return upper.elevation_rad - lower.elevation_rad > radians(kRingStep_deg);
    };
    if (std::ranges::adjacent_find(rings, is_apart) != rings.end()) return true;
    return std::ranges::any_of(rings, [&](const ViewRing& ring) {
        const auto [low, high] = std::ranges::minmax(ring.views, {}, elevation_rad);
        return elevation_rad(high) - elevation_rad(low) > radians(kRingSpread_deg);
    });
}

Status check_posed_views(const Rig& rig, const std::filesystem::path& file) {
    RS_TRY(check_lenses(rig, file));
    return check_alpha(rig, file);
}

Status check_views(const Rig& rig, const std::filesystem::path& file) {
    const std::string where = file.string();
    RS_TRY(check_lenses(rig, file));
    const Camera& first = rig.views.front().camera;
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        const RigView& view = rig.views[i];
        if (view.camera.width != first.width || view.camera.height != first.height) {
            return Error{image_path(file.parent_path(), view).string() + ": is " + std::to_string(view.camera.width) +
                         "x" + std::to_string(view.camera.height) + " pixels, but the first image is " +
                         std::to_string(first.width) + "x" + std::to_string(first.height) +
                         "; all images of an object must have one size"};
        }
        if (std::abs(std::asin(std::clamp(view.camera.forward().y, -1.0, 1.0))) > radians(kSteepestPitch_deg)) {
            return Error{
                where + ": the camera of frame " + std::to_string(i) +
                " looks up or down by more than 60 degrees; such an image cannot be made upright, leave it out"};
        }
    }
    return check_alpha(rig, file);
}

std::string mask_path(const RigView& view) {
    const auto found = view.extras.find("mask_path");
    return found != view.extras.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace rs::encode
