#include "encode/build.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/object/yuv.hpp"
#include "rayspace/output/view_output.hpp"

namespace rs::encode {

Status extract_images(const RaySpaceObject& object, const std::filesystem::path& folder, Progress* progress,
                      bool force) {
    if (object.rig_json.empty()) {
        return Error{object.name + ": contains no rig, which a capture set needs; encode the object again"};
    }
    RS_ASSIGN_OR_RETURN(Rig rig, rig_from_json(object.rig_json, object.name + " (its rig)"));
    if (rig.views.size() != object.images.size()) {
        return Error{object.name + ": its rig has " + std::to_string(rig.views.size()) + " views for " +
                     std::to_string(object.images.size()) + " images; the object is damaged, encode it again"};
    }
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(folder, "images out of an object", force));

    const int count = static_cast<int>(object.images.size());
    for (int i = 0; i < count; ++i) {
        rig.views[static_cast<std::size_t>(i)].file_path = numbered_image_name(static_cast<std::size_t>(i));
        rig.views[static_cast<std::size_t>(i)].depth_file_path.clear();
    }
    Status written = for_each_in_parallel(count, "images", progress, [&](int i) {
        const auto n = static_cast<std::size_t>(i);
        return write_png(staged.temporary_path() / rig.views[n].file_path, rgba_from_planar(object.images[n]));
    });
    if (!written) return written;
    RS_TRY(write_rig(staged.temporary_path() / kRigFileName, rig));
    return staged.commit();
}

}  // namespace rs::encode
