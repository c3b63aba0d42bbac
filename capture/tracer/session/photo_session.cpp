#include "capture/tracer/session/photo_session.hpp"

#include "capture/tracer/integrator/sampler.hpp"
#include "capture/tracer/integrator/tracer.hpp"
#include "capture/tracer/session/capture_set.hpp"
#include "capture/tracer/session/coverage.hpp"
#include "capture/tracer/session/sensor.hpp"
#include "capture/tracer/session/still_backdrop.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

const char* name_of(DiscSurface surface) {
    switch (surface) {
        case DiscSurface::none:
            return "none";
        case DiscSurface::plain:
            return "plain";
        case DiscSurface::rings:
            return "rings";
        case DiscSurface::speckled:
            return "speckled";
    }
    return "";
}

namespace fs = std::filesystem;

// Circles about the axis through the outermost vertices at each height, and the disc's.
std::vector<AxisCircle> visible_circles(const Scene& object, const Turntable& turntable) {
    constexpr double kBands_per_unit = 100;
    std::map<int, AxisCircle> widest;  // [height band]
    for (const Mesh& mesh : object.meshes) {
        for (const glm::vec3& p : mesh.positions) {
            const auto y = static_cast<double>(p.y);
            const double radius = std::hypot(static_cast<double>(p.x), static_cast<double>(p.z));
            AxisCircle& circle = widest[static_cast<int>(std::floor(y * kBands_per_unit))];
            if (radius >= circle.radius) circle = {radius, y};
        }
    }
    std::vector<AxisCircle> circles;
    for (const auto& [band, circle] : widest) circles.push_back(circle);
    if (turntable.reach() > 0)
        circles.insert(circles.end(), {{turntable.reach(), turntable.top}, {turntable.reach(), turntable.bottom()}});
    return circles;
}

Result<Image<RgbaF>> make_backdrop(const PhotoOptions& options, const SessionPlan& plan, const Turntable& turntable) {
    const Lens& lens = plan.model.lens;
    if (options.backdrop == "wall") return wall_backdrop(plan, turntable, options.session.seed);
    if (options.backdrop == "blue") return uniform_backdrop(lens, {0.04F, 0.12F, 0.45F});
    if (options.backdrop == "white") return uniform_backdrop(lens, glm::vec3(0.88F));
    RS_ASSIGN_OR_RETURN(Image<RgbaF> image, read_image_linear(options.backdrop));
    return image_backdrop(lens, std::move(image));
}

// Factor on the lights that avoids clipping of bright parts of object and disc, metered in a small first view.
double meter_dimming(const Tracer& tracer, const SessionPlan& plan, const PhotoOptions& options) {
    constexpr int kCoarse = 8;
    constexpr float kBright = 0.85F;  // linear; limit for 99 % of the pixels
    RayImage rays = lens_rays(plan, 0);
    rays.width = std::max(1, rays.width / kCoarse);
    rays.height = std::max(1, rays.height / kCoarse);
    rays.ray = [whole = rays.ray](double x, double y) { return whole(x * kCoarse, y * kCoarse); };
    RenderOptions render;
    render.samples_per_pixel = 16;
    render.seed = options.session.seed;
    render.threads = options.threads;
    std::vector<float> brightest;
    const Rendering metered = tracer.render(rays, render);
    for (const RgbaF& p : metered.image.pixels()) {
        if (p.a > 0) brightest.push_back(std::max({p.r, p.g, p.b}));
    }
    if (brightest.empty()) return 1;
    const auto at = brightest.begin() + static_cast<std::ptrdiff_t>(brightest.size() * 99 / 100);
    std::nth_element(brightest.begin(), at, brightest.end());
    return *at > kBright ? static_cast<double>(kBright / *at) : 1.0;
}

// Composites `front`, multiplied by `dimming`, over the backdrop.
Image<RgbaF> composite_over(const Image<RgbaF>& front, double dimming, const Image<RgbaF>& backdrop) {
    const auto factor = static_cast<float>(dimming);
    Image<RgbaF> result(front.width(), front.height());
    for (std::size_t i = 0; i < result.pixels().size(); ++i) {
        const RgbaF& f = front.pixels()[i];
        const RgbaF& b = backdrop.pixels()[i];
        const auto mix = [&](float of_front, float of_back) { return of_front * factor * f.a + of_back * (1 - f.a); };
        result.pixels()[i] = {mix(f.r, b.r), mix(f.g, b.g), mix(f.b, b.b), 1};
    }
    return result;
}

Image<Rgba8> to_grey_image(const Image<float>& shares) {
    Image<Rgba8> image(shares.width(), shares.height());
    for (std::size_t i = 0; i < shares.pixels().size(); ++i) {
        const auto code = static_cast<std::uint8_t>(std::lround(shares.pixels()[i] * 255.0F));
        image.pixels()[i] = {code, code, code, 255};
    }
    return image;
}

double mean_of(const Image<float>& shares) {
    double sum = 0;
    for (const float share : shares.pixels()) sum += static_cast<double>(share);
    return sum / static_cast<double>(shares.pixels().size());
}

bool touches_edge(const Image<float>& shares) {
    for (int y = 0; y < shares.height(); ++y) {
        const bool whole_row = y == 0 || y == shares.height() - 1;
        for (int x = 0; x < shares.width(); x += whole_row ? 1 : std::max(1, shares.width() - 1)) {
            if (shares(x, y) > 0) return true;
        }
    }
    return false;
}

// Data shared by all views.
struct Session {
    SessionPlan plan;
    Turntable turntable;
    Image<RgbaF> backdrop;
    Tracer tracer;         // of object, disc and board
    RayScene silhouettes;  // of the object alone
    double dimming;        // of the scene's lights
};

nlohmann::json turntable_json(const Session& session, const PhotoOptions& options) {
    const SessionPlan& plan = session.plan;
    const Turntable& turntable = session.turntable;
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
                           {"dimming", session.dimming},
                           {"noise_codes", options.noise_codes},
                           {"jpeg_quality", options.jpeg_quality},
                           {"spp", options.samples_per_pixel},
                           {"seed", options.session.seed}};
    json["plate"] = {{"surface", name_of(turntable.surface)},
                     {"radius", turntable.radius},
                     {"top", turntable.top},
                     {"thickness", turntable.thickness}};
    if (turntable.board) {
        nlohmann::json corners = nlohmann::json::array();
        for (const glm::dvec3& corner : turntable.board->corners) corners.push_back({corner.x, corner.y, corner.z});
        json["board"] = {{"corners", std::move(corners)},
                         {"width_px", turntable.board->image.width()},
                         {"height_px", turntable.board->image.height()}};
    }
    return json;
}

// Ground-truth rig. `photo_of_view` are the photos' paths relative to transforms.json. `places` is empty without
// recentring.
Rig truth_rig(const Session& session, double object_radius, const PhotoOptions& options,
              const std::vector<std::string>& photo_of_view, std::span<const ImagePlacement> places) {
    Rig rig;
    rig.object_radius = object_radius;
    rig.foot_height = session.turntable.top;
    for (std::size_t i = 0; i < photo_of_view.size(); ++i) {
        RigView view;
        view.camera = pinhole_camera(session.plan, i);
        view.file_path = photo_of_view[i];
        rig.views.push_back(std::move(view));
    }
    rig.extras["turntable"] = turntable_json(session, options);
    if (!places.empty()) {
        nlohmann::json& listed = rig.extras["turntable"]["places"] = nlohmann::json::array();
        for (const ImagePlacement& place : places) {
            listed.push_back({{"scale", place.scale}, {"shift_px", {place.shift_px.x, place.shift_px.y}}});
        }
    }
    return rig;
}

struct View {
    Image<Rgba8> photo;
    Image<float> alpha;
    ImagePlacement place;
};

View take_photo(Session& session, std::size_t view, const PhotoOptions& options, Progress* progress) {
    RayImage rays = lens_rays(session.plan, view);
    ImagePlacement place;
    if (options.recentred) {
        place = recentring_placement(trace_coverage(session.silhouettes, rays, options.threads));
        rays = apply_placement(std::move(rays), place);
    }
    RenderOptions render;
    render.samples_per_pixel = options.samples_per_pixel;
    render.filtered = options.filtered;
    render.seed = options.session.seed;
    render.threads = options.threads;
    session.tracer.turn_lights(-session.plan.model.angles_rad[view]);
    const Rendering traced = session.tracer.render(rays, render, progress);
    const Sensor sensor{session.plan.exposures[view], options.noise_codes,
                        mix_bits(options.session.seed) + static_cast<std::uint64_t>(view)};
    const Image<RgbaF> light = composite_over(
        traced.image, session.dimming, options.recentred ? apply_placement(session.backdrop, place) : session.backdrop);
    return {expose(light, sensor), trace_coverage(session.silhouettes, rays, options.threads), place};
}

Status make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return Error{folder.string() + ": cannot be made: " + error.message()};
    return {};
}

}  // namespace

bool is_procedural_backdrop(const std::string& name) {
    return name == "wall" || name == "blue" || name == "white";
}

Result<CaptureSetSummary> write_photo_session(const Scene& object, double object_radius, const PhotoOptions& options,
                                              const fs::path& folder, Progress* progress) {
    using Clock = std::chrono::steady_clock;
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(folder, "traced photographs", options.force));

    Turntable turntable = fit_turntable(object, object_radius, options.disc, options.session.seed);
    if (!options.board.empty()) {
        RS_ASSIGN_OR_RETURN(Image<RgbaF> image, read_image_linear(options.board));
        lay_board(turntable, std::move(image), options.board_width * object_radius);
    }
    RS_ASSIGN_OR_RETURN(SessionPlan plan, plan_session(options.session, visible_circles(object, turntable)));
    RS_ASSIGN_OR_RETURN(Image<RgbaF> backdrop, make_backdrop(options, plan, turntable));
    Scene whole = object;
    add_turntable(whole, turntable);
    RS_ASSIGN_OR_RETURN(Tracer tracer, Tracer::create(std::move(whole)));
    RS_ASSIGN_OR_RETURN(RayScene silhouettes, RayScene::create(object));
    const double dimming = meter_dimming(tracer, plan, options);
    Session session{std::move(plan),   std::move(turntable),   std::move(backdrop),
                    std::move(tracer), std::move(silhouettes), dimming};

    const auto views = session.plan.model.angles_rad.size();
    if (progress != nullptr) {
        progress->start("rendering " + std::to_string(views) + " photos",
                        static_cast<std::int64_t>(views) * Tracer::step_count(lens_rays(session.plan, 0)));
    }
    const fs::path photos = staged.temporary_path() / "photos";
    const fs::path truth = staged.temporary_path() / "truth";
    for (const fs::path& inner : {photos, truth / "alpha"}) {
        RS_TRY(make_folder(inner));
    }

    CaptureSetSummary summary;
    std::vector<std::string> names;
    std::vector<ImagePlacement> places;
    for (std::size_t i = 0; i < views; ++i) {
        const Clock::time_point begun = Clock::now();
        const View view = take_photo(session, i, options, progress);
        summary.render_s += std::chrono::duration<double>(Clock::now() - begun).count();
        if (options.recentred) places.push_back(view.place);
        summary.mean_coverage += mean_of(view.alpha) / static_cast<double>(views);
        summary.clipped_views += touches_edge(view.alpha) ? 1 : 0;
        ++summary.views;

        const std::string name = view_number(i) + (options.jpeg_quality > 0 ? ".jpg" : ".png");
        names.push_back("../photos/" + name);
        Status written = options.jpeg_quality > 0 ? write_jpeg(photos / name, view.photo, options.jpeg_quality)
                                                  : write_png(photos / name, view.photo);
        if (written) written = write_png(truth / "alpha" / (view_number(i) + ".png"), to_grey_image(view.alpha));
        if (!written) return written.error();
    }
    if (!(summary.mean_coverage > 0)) {
        return Error{folder.string() + ": no view shows the object; check the distance or the mesh"};
    }
    const Rig rig = truth_rig(session, object_radius, options, names, places);
    RS_TRY(write_rig(truth / kRigFileName, rig));
    RS_TRY(staged.commit());
    if (progress != nullptr) progress->finish();
    return summary;
}

}  // namespace rs::capture
