#include "capture/posed/set_export.hpp"

#include "capture/posed/cameras/camera_file.hpp"
#include "capture/posed/cameras/colmap_model.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

// Names of the images in the exported folder, all PNG: those of the set without their folders if these differ, else
// numbers.
std::vector<std::string> exported_names(const Rig& rig) {
    std::vector<std::string> names;
    std::set<std::string> distinct;
    for (const RigView& view : rig.views) {
        names.push_back(fs::path(view.file_path).stem().string() + ".png");
        distinct.insert(names.back());
    }
    if (distinct.size() == names.size()) return names;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string number = std::to_string(i);
        names[i] = std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number + ".png";
    }
    return names;
}

Status check_exportable(const Rig& rig, const std::string& where) {
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        const std::string place = where + ": frame " + std::to_string(i);
        RS_ASSIGN_OR_RETURN(const LensDistortion lens, lens_distortion_of(rig.extras, rig.views[i].extras, place));
        if (!lens.is_pinhole()) {
            return Error{place + " has lens distortion; undistort the photos by rs-capture import --known"};
        }
    }
    return {};
}

// Writes the image and the mask of a view.
Status export_view(const fs::path& source, const Camera& camera, const fs::path& image_file, const fs::path& mask_file,
                   const std::optional<Rgba8>& background) {
    RS_ASSIGN_OR_RETURN(const ImageInfo info, read_image_info(source));
    if (!info.has_alpha) {
        return Error{source.string() + ": has no alpha; import the photos by rs-capture import, which segments them"};
    }
    RS_ASSIGN_OR_RETURN(Image<Rgba8> image, read_image(source));
    if (image.width() != camera.width || image.height() != camera.height) {
        return Error{source.string() + ": has another size than its camera; correct w and h in transforms.json"};
    }
    Image<Rgba8> mask(image.width(), image.height());
    std::ranges::transform(image.pixels(), mask.pixels().begin(), [](const Rgba8& pixel) {
        const auto code = static_cast<std::uint8_t>(pixel.a >= 128 ? 255 : 0);
        return Rgba8{code, code, code, 255};
    });
    if (background) {
        for (Rgba8& pixel : image.pixels()) pixel = over(pixel, *background);
    }
    RS_TRY(write_png(image_file, image));
    return write_png(mask_file, mask);
}

Status write_colmap(const fs::path& folder, const Rig& rig, const std::vector<std::string>& names) {
    std::vector<PosedCamera> cameras;
    for (std::size_t i = 0; i < rig.views.size(); ++i) cameras.push_back({names[i], {}, rig.views[i].camera, {}});
    const ColmapText model = colmap_text_of(cameras);
    RS_TRY(write_file(folder / "sparse" / "0" / "cameras.txt", model.cameras));
    RS_TRY(write_file(folder / "sparse" / "0" / "images.txt", model.images));
    return write_file(folder / "sparse" / "0" / "points3D.txt", model.points);
}

Status write_nerfstudio(const fs::path& folder, const Rig& rig, const std::vector<std::string>& names) {
    Rig written;
    written.object_radius = rig.object_radius;
    written.extras["camera_model"] = "OPENCV";
    for (const char* const key : {"k1", "k2", "p1", "p2"}) written.extras[key] = 0;
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        RigView view;
        view.camera = rig.views[i].camera;
        view.file_path = "images/" + names[i];
        view.extras["mask_path"] = "masks/" + names[i];
        written.views.push_back(std::move(view));
    }
    return write_rig(folder / kRigFileName, written);
}

}  // namespace

Result<std::size_t> export_set(const ExportOptions& options, Progress* progress) {
    RS_TRY(refuse_overwriting_inputs(options.output, {options.set}));
    RS_ASSIGN_OR_RETURN(const Rig rig, read_rig(options.set));
    const fs::path file = rig_file(options.set);
    RS_TRY(check_exportable(rig, file.string()));
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(options.output, "exported photos", options.force));
    const fs::path folder = staged.temporary_path();
    const bool is_colmap = options.format == ExportFormat::kColmap;
    for (const char* const inner : {"images", "masks", is_colmap ? "sparse/0" : "images"}) {
        std::error_code failure;
        fs::create_directories(folder / inner, failure);
        if (failure) return Error{options.output.string() + ": cannot be written (" + failure.message() + ")"};
    }
    const std::vector<std::string> names = exported_names(rig);
    RS_TRY(for_each_in_parallel(static_cast<int>(rig.views.size()), "exporting", progress, [&](int view) -> Status {
        const auto i = static_cast<std::size_t>(view);
        return export_view(image_path(file.parent_path(), rig.views[i]), rig.views[i].camera,
                           folder / "images" / names[i], folder / "masks" / (names[i] + (is_colmap ? ".png" : "")),
                           options.background);
    }));
    RS_TRY(is_colmap ? write_colmap(folder, rig, names) : write_nerfstudio(folder, rig, names));
    RS_TRY(staged.commit());
    return rig.views.size();
}

}  // namespace rs::capture
