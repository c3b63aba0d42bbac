#include "compositor/tools/frame_output.hpp"

#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/tool/tool_main.hpp"

namespace rs::compositor {
namespace {

Status write_folder(const FrameOutput& output, const std::vector<Camera>& cameras, const RenderView& render,
                    Progress& progress) {
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output.path, "composited views", output.force));
    const Rig rig = make_rig_of_views(cameras);
    for (const RigView& view : rig.views) {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> frame, render(view.camera));
        RS_TRY(write_png(staged.temporary_path() / view.file_path, frame));
        progress.advance();
    }
    if (output.writes_cameras) RS_TRY(write_rig(staged.temporary_path() / kRigFileName, rig));
    return staged.commit();
}

}  // namespace

void add_stats_option(CLI::App& command, std::optional<std::string>& stats) {
    command.add_option("--stats", stats, "write the frames' times, by part, as JSON")
        ->check(ends_in({".json"}))
        ->type_name("FILE.json");
}

Status check_frame_count(const std::string& output, OutputKind kind, std::size_t frames) {
    if (kind != OutputKind::image || frames == 1) return {};
    return Error{output + ": " + std::to_string(frames) +
                 " frames do not fit one image; give a folder or an .mp4 to -o"};
}

Status write_frames(const FrameOutput& output, const std::vector<Camera>& cameras, const RenderView& render,
                    Progress& progress) {
    if (output.kind == OutputKind::video)
        return write_view_video(output.path, output.frames_per_second, cameras, render, progress);
    if (output.kind == OutputKind::folder) return write_folder(output, cameras, render, progress);
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> frame, render(cameras.front()));
    return write_png(output.path, frame);
}

}  // namespace rs::compositor
