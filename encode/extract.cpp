#include "encode/build.hpp"
#include "rayspace/file_output.hpp"
#include "rayspace/picture_io.hpp"
#include "rayspace/yuv.hpp"

#include <tbb/parallel_for.h>

#include <cstdio>
#include <optional>

namespace rs::encode {

Status extract_pictures(const RaySpaceObject& object, const std::filesystem::path& folder, Progress* progress) {
    Result<Rig> rig = rig_from_json(object.rig_json, object.name + " (its rig)");
    if (!rig) return rig.error();
    if (rig->views.size() != object.pictures.size()) {
        return Error{object.name + ": its rig has " + std::to_string(rig->views.size()) + " views for " +
                     std::to_string(object.pictures.size()) + " pictures; the object is damaged, encode it again"};
    }
    Result<StagedFolder> staged = StagedFolder::create(folder, kRigFileName);
    if (!staged) return staged.error();

    const int count = static_cast<int>(object.pictures.size());
    for (int i = 0; i < count; ++i) {
        char name[32];
        std::snprintf(name, sizeof name, "%04d.png", i);
        rig->views[static_cast<std::size_t>(i)].file_path = name;
        rig->views[static_cast<std::size_t>(i)].depth_file_path.clear();
    }
    std::vector<std::optional<Error>> errors(object.pictures.size());
    if (progress != nullptr) progress->start("pictures", count);
    tbb::parallel_for(0, count, [&](int i) {
        const auto n = static_cast<std::size_t>(i);
        const Image<Rgba8> picture = rgba_from_planar(object.pictures[n]);
        const Status status = write_png(staged->temporary_path() / rig->views[n].file_path, picture);
        if (!status) errors[n] = status.error();
        if (progress != nullptr) progress->advance();
    });
    if (progress != nullptr) progress->finish();
    for (const auto& error : errors) {
        if (error) return *error;
    }
    if (const Status status = write_rig(staged->temporary_path() / kRigFileName, *rig); !status) return status;
    return staged->commit();
}

}  // namespace rs::encode
