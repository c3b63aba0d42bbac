#include "encode/build.hpp"

#include "encode/raymap/captured_view.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/geometry/ring_axes.hpp"
#include "rayspace/light/capture_irradiance.hpp"
#include "rayspace/object/yuv.hpp"

#include <cmath>

namespace rs::encode {
namespace {

Status check_options(const PlaneMapOptions& map, std::size_t rings) {
    if (map.planes < kMinPlanes || map.planes > kMaxPlanes) {
        return Error{"--planes " + std::to_string(map.planes) + ": must be " + std::to_string(kMinPlanes) + ".." +
                     std::to_string(kMaxPlanes)};
    }
    if (map.x_cells < 1 || map.x_cells > kMaxMapSide || map.u_cells < 1 || map.u_cells > kMaxMapSide) {
        return Error{"--cells " + std::to_string(map.x_cells) + "x" + std::to_string(map.u_cells) +
                     ": both must be 1.." + std::to_string(kMaxMapSide)};
    }
    if (rings > static_cast<std::size_t>(kMaxRings)) {
        return Error{"the cameras form " + std::to_string(rings) + " rings of different elevation, more than " +
                     std::to_string(kMaxRings) + "; a capture set is one or a few turns about the Y axis"};
    }
    return {};
}

Rig in_object_radii(Rig rig) {
    for (RigView& view : rig.views) {
        view.camera.world_from_camera[3] = glm::dvec4(view.camera.centre() / rig.object_radius, 1);
    }
    return rig;
}

// Cameras in the axes of their rings.
Rig in_ring_axes(Rig rig, const std::vector<ViewRing>& rings) {
    for (const ViewRing& ring : rings) {
        for (const int v : ring.views) {
            Camera& camera = rig.views[static_cast<std::size_t>(v)].camera;
            camera = rs::in_ring_axes(camera, ring.rotation);
        }
    }
    return rig;
}

// The ground height in object radii, q20; nullopt if it is implausibly far away.
std::optional<std::int32_t> foot_of(const Rig& rig) {
    constexpr double kMaxHeight_radii = 128;
    if (!rig.foot_height) return std::nullopt;
    const double foot = *rig.foot_height / rig.object_radius;
    if (!(std::abs(foot) <= kMaxHeight_radii)) return std::nullopt;
    return static_cast<std::int32_t>(std::lround(std::ldexp(foot, 20)));
}

Status check_irradiance(const CaptureSet& set) {
    const auto found = set.upright.extras.find(kCaptureIrradianceKey);
    if (found == set.upright.extras.end()) return {};
    const std::string where = (set.folder / kRigFileName).string() + ": " + kCaptureIrradianceKey;
    const Result<IrradianceHarmonics> irradiance = irradiance_from_json(*found, where);
    return irradiance ? Status() : irradiance.error();
}

Status read_all_images(const CaptureSet& set, RaySpaceObject& object, Progress* progress) {
    const int count = static_cast<int>(set.upright.views.size());
    return for_each_in_parallel(count, "images", progress, [&](int i) -> Status {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, read_upright_image(set, i));
        object.images[static_cast<std::size_t>(i)] = planar_from_rgba(image);
        return {};
    });
}

}  // namespace

std::string to_string(MapKind kind) {
    return kind == MapKind::kPlane ? "plane" : "shape";
}

std::optional<MapKind> parse_map_kind(const std::string& name) {
    for (const MapKind kind : {MapKind::kPlane, MapKind::kShape}) {
        if (name == to_string(kind)) return kind;
    }
    return std::nullopt;
}

PlaneMapOptions default_plane_map(MapKind kind) {
    PlaneMapOptions map;
    if (kind == MapKind::kShape) map.x_cells = map.u_cells = 128;
    return map;
}

Result<BuiltObject> build_object(const CaptureSet& set, const BuildOptions& options, Progress* progress) {
    RS_CHECK(!set.posed);  // with_rings() comes first
    const std::vector<ViewRing> rings = set.rings.empty() ? find_rings(set.upright) : set.rings;
    RS_TRY(check_options(options.map, rings.size()));
    if (set.captured.views.size() < 2) {
        return Error{set.folder.string() +
                     ": has one frame; an object needs photos from several sides, 24 or more for a whole turn"};
    }
    RS_TRY(check_irradiance(set));

    BuiltObject built;
    RaySpaceObject& object = built.object;
    object.name = options.name;
    object.units_per_radius = set.upright.object_radius;
    object.foot_q20 = foot_of(set.upright);
    object.rig_json = compact_json(rig_to_json(set.upright));
    object.width = set.width;
    object.height = set.height;

    const Rig rig = in_ring_axes(in_object_radii(set.upright), rings);
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        Result<CapturedView> view = captured_view(rig.views[i].camera, options.map.planes);
        if (!view) {
            return Error{set.file.string() + ": the camera of frame " + std::to_string(i) +
                         " cannot be stored: " + view.error().message};
        }
        object.views.push_back(std::move(*view));
    }
    if (progress != nullptr) progress->start("RS map", static_cast<std::int64_t>(rings.size()));
    for (const ViewRing& ring : rings) {
        object.rings.push_back(make_plane_map(rig, ring, options.map));
        object.rings.back().rotation = ring.rotation;
        const double cells = cells_between_views(rig, ring, options.map);
        if (cells > 0 && cells < 2) {
            built.warnings.push_back(
                "the RS map has fewer than 2 cells of u between neighbouring views, so a captured "
                "pose may show a neighbouring view; increase the cells of u (--cells)");
        }
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
    if (rings.size() > 1) {
        built.warnings.push_back("the cameras form " + std::to_string(rings.size()) +
                                 " rings; each view is rendered from the two nearest ones");
    }
    object.images.resize(object.views.size());
    const bool has_shape = options.raymap == MapKind::kShape;
    if (options.raw_images && !has_shape) {
        RS_TRY(read_all_images(set, object, progress));
    }
    if (has_shape) {
        RS_ASSIGN_OR_RETURN(ShapeMapOutput shapes,
                            add_shape_maps({.set = set, .rig = rig, .rings = rings, .keep_images = options.raw_images},
                                           options.shape, object, progress));
        built.warnings.insert(built.warnings.end(), shapes.warnings.begin(), shapes.warnings.end());
        built.depths = std::move(shapes.samples);
        built.completed = std::move(shapes.completed);
    }
    return built;
}

}  // namespace rs::encode
