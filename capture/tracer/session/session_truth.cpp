#include "capture/tracer/session/session_truth.hpp"

#include <utility>

namespace rs::capture {

namespace {

const char* name_of(PlateSurface surface) {
    switch (surface) {
        case PlateSurface::none:
            return "none";
        case PlateSurface::plain:
            return "plain";
        case PlateSurface::rings:
            return "rings";
        case PlateSurface::speckled:
            return "speckled";
    }
    return "";
}

nlohmann::json turntable_json(const SessionPlan& plan, const Plate& plate, const PhotoOptions& options,
                              double dimming) {
    const Lens& lens = plan.model.lens;
    const CameraPose& pose = plan.model.pose;
    nlohmann::json json = {{"f_px", lens.f_px},
                           {"cx", lens.cx},
                           {"cy", lens.cy},
                           {"k1", lens.k1},
                           {"k2", lens.k2},
                           {"pan_rad", pose.pan_rad},
                           {"tilt_rad", pose.tilt_rad},
                           {"roll_rad", pose.roll_rad},
                           {"angles_rad", plan.model.angles_rad},
                           {"distance", plan.distance},
                           {"camera_height", plan.camera_height},
                           {"counter_clockwise", options.session.counter_clockwise},
                           {"exposures", plan.exposures},
                           {"dimming", dimming},
                           {"noise_codes", options.noise_codes},
                           {"jpeg_quality", options.jpeg_quality},
                           {"spp", options.samples_per_pixel},
                           {"seed", options.session.seed}};
    json["plate"] = {{"surface", name_of(plate.surface)},
                     {"radius", plate.radius},
                     {"top", plate.top},
                     {"thickness", plate.thickness}};
    if (plate.board) {
        nlohmann::json corners = nlohmann::json::array();
        for (const glm::dvec3& corner : plate.board->corners) corners.push_back({corner.x, corner.y, corner.z});
        json["board"] = {{"corners", std::move(corners)},
                         {"width_px", plate.board->picture.width()},
                         {"height_px", plate.board->picture.height()}};
    }
    return json;
}

}  // namespace

Rig truth_rig(const SessionPlan& plan, const Plate& plate, double object_radius, const PhotoOptions& options,
              double dimming, const std::vector<std::string>& photo_of_view, std::span<const PicturePlace> places) {
    Rig rig;
    rig.object_radius = object_radius;
    rig.foot_height = plate.top;
    for (std::size_t i = 0; i < photo_of_view.size(); ++i) {
        RigView view;
        view.camera = pinhole_of(plan, i);
        view.file_path = photo_of_view[i];
        rig.views.push_back(std::move(view));
    }
    rig.extras["turntable"] = turntable_json(plan, plate, options, dimming);
    if (!places.empty()) {
        nlohmann::json& listed = rig.extras["turntable"]["places"] = nlohmann::json::array();
        for (const PicturePlace& place : places) {
            listed.push_back({{"scale", place.scale}, {"shift_px", {place.shift_px.x, place.shift_px.y}}});
        }
    }
    return rig;
}

}  // namespace rs::capture
