#include "compositor/tools/quilt_views.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <filesystem>

namespace rs::compositor {
namespace {

Result<Image<Rgba8>> drawn_quilt(const QuiltLayout& layout, const std::vector<Camera>& cameras,
                                 const RenderView& render, Progress& progress) {
    Image<Rgba8> quilt(layout.width(), layout.height());
    for (std::size_t view = 0; view < cameras.size(); ++view) {
        const Result<Image<Rgba8>> tile = render(cameras[view]);
        if (!tile) return tile.error();
        place_tile(layout, static_cast<int>(view), *tile, quilt);
        progress.advance();
    }
    return quilt;
}

// The depth of the object that is largest in the image; 0 where none is in it.
double depth_of_largest(const Scene& scene, const Camera& middle) {
    double depth = 0;
    double largest = 0;
    for (const RaySpaceNode& object : scene.objects) {
        const Similarity place = world_from_node(object.chain);
        const glm::dvec3 at = middle.project(place.translation);
        const bool inside = at.z > 0 && at.x >= 0 && at.y >= 0 && at.x <= middle.width && at.y <= middle.height;
        if (!inside || place.scale / at.z <= largest) continue;
        largest = place.scale / at.z;
        depth = at.z;
    }
    return depth;
}

// Where the display shows what is at its own depth.
Result<double> requested_focus(const ViewArguments& arguments, const Scene& scene, const Camera& middle) {
    if (arguments.focus > 0) return arguments.focus;
    if (const double depth = depth_of_largest(scene, middle); depth > 0) return depth;
    const BoundingBox box = bounds_from(scene, 0, 0);
    const double depth = box.empty() ? 0 : glm::dot(box.middle() - middle.centre(), middle.forward());
    if (depth > 0) return depth;
    return Error{"--quilt: nothing that could be in focus is before the camera; give its depth, --focus DIST"};
}

}  // namespace

std::vector<Camera> QuiltViews::cameras() const {
    std::vector<Camera> all;
    for (const auto& frame : frames) all.insert(all.end(), frame.begin(), frame.end());
    return all;
}

Result<PixelSize> requested_tile(const ViewArguments& arguments) {
    return parse_size(arguments.tile_size);
}

Result<QuiltViews> requested_quilt(const ViewArguments& arguments, const Scene& scene,
                                   const std::vector<Camera>& middle) {
    const Result<PixelSize> tile = requested_tile(arguments);
    if (!tile) return tile.error();
    const Result<QuiltLayout> layout = parse_quilt(arguments.quilt, tile->width, tile->height, "--quilt");
    if (!layout) return layout.error();
    QuiltViews views{*layout, {}};
    for (const Camera& camera : middle) {
        const Result<double> focus = requested_focus(arguments, scene, camera);
        if (!focus) return focus.error();
        views.frames.push_back(quilt_cameras(camera, *layout, radians(arguments.cone_deg), *focus));
    }
    return views;
}

Status write_quilts(const QuiltViews& views, const ViewArguments& arguments, const RenderView& render,
                    Progress& progress) {
    if (views.frames.size() == 1) {
        const Result<Image<Rgba8>> quilt = drawn_quilt(views.layout, views.frames.front(), render, progress);
        if (!quilt) return quilt.error();
        return write_png(quilt_path(arguments.output, views.layout), *quilt);
    }
    Result<StagedFolder> staged = StagedFolder::create(arguments.output, "quilts");
    if (!staged) return staged.error();
    for (std::size_t frame = 0; frame < views.frames.size(); ++frame) {
        const Result<Image<Rgba8>> quilt = drawn_quilt(views.layout, views.frames[frame], render, progress);
        if (!quilt) return quilt.error();
        const std::filesystem::path path = staged->temporary_path() / numbered_image_name(frame);
        if (Status status = write_png(quilt_path(path, views.layout), *quilt); !status) return status;
    }
    return staged->commit();
}

}  // namespace rs::compositor
