#include "compositor/tools/sequence_run.hpp"

#include "compositor/gl/context.hpp"
#include "compositor/playback/sequence_player.hpp"
#include "compositor/sequence/converter.hpp"
#include "compositor/tools/requested_scene.hpp"
#include "compositor/tools/requested_tracing.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;

constexpr int kJpegQuality = 92;
constexpr int kUsualPassesOfAFrame = 16;

enum class Kind { kVideo, kImage, kFolder };

Result<Kind> kind_of_output(const std::string& output) {
    const std::string ending = lower_case_extension(output);
    if (ending == ".mp4") return Kind::kVideo;
    if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") return Kind::kImage;
    const Result<OutputKind> kind = output_kind(output);
    if (!kind) return Error{output + ": sequences are written as .mp4, .jpg or .png; give such a name, or a folder"};
    return Kind::kFolder;
}

Result<PlayerOptions> player_options(const ViewArguments& arguments) {
    const Result<PixelSize> size = parse_size(arguments.size);
    if (!size) return size.error();
    PlayerOptions options;
    options.frame = {.width = size->width,
                     .height = size->height,
                     .samples = arguments.samples,
                     .wire_frame = arguments.wire_frame,
                     .shadows = arguments.shadows == "on",
                     .exposure_ev = arguments.exposure_ev,
                     .object_depth = arguments.object_depth == "pixel" ? ObjectDepth::kPixel : ObjectDepth::kPlane,
                     .object_samples = arguments.object_samples,
                     .upright_images = arguments.upright};
    const Result<TracedOptions> tracing = requested_tracing(arguments);
    if (!tracing) return tracing.error();
    if (requested_method(arguments)) options.tracing = *tracing;
    options.passes = arguments.passes > 0 ? arguments.passes : kUsualPassesOfAFrame;
    options.memory_bytes = arguments.memory_mib << 20;
    if (arguments.weather.empty()) return options;
    Result<Weather> weather = parse_weather(arguments.weather);
    if (!weather) return weather.error();
    weather->seed = arguments.seed;
    weather->visibility = arguments.visibility;
    options.weather = *weather;
    return options;
}

// A sequence with what draws it.
struct Playing {
    std::optional<Converted> converted;  // the files, where they were made for us
    std::shared_ptr<const Sequence> sequence;
    std::optional<SequencePlayer> player;
};

Result<Playing> open_sequence(const ViewArguments& arguments, const std::string& folder) {
    Playing playing;
    fs::path files = folder;
    if (!arguments.convert.empty()) {
        Result<Converted> converted = convert_scene(arguments.convert, folder);
        if (!converted) return converted.error();
        files = converted->path;
        playing.converted.emplace(std::move(*converted));
    }
    Result<Sequence> sequence = read_sequence(files);
    if (!sequence) return sequence.error();
    if (playing.converted) sequence->name = fs::path(folder).stem().string();
    print_warnings(sequence->scene.warnings);
    playing.sequence = std::make_shared<const Sequence>(std::move(*sequence));
    return playing;
}

Status start_player(const ViewArguments& arguments, Playing& playing) {
    const Result<PlayerOptions> options = player_options(arguments);
    if (!options) return options.error();
    Result<SequencePlayer> player = SequencePlayer::create(playing.sequence, *options);
    if (!player) return player.error();
    playing.player.emplace(std::move(*player));
    return {};
}

Status check_video(const Playing& playing, const std::string& folder) {
    if (playing.sequence->frames.size() >= 2) return {};
    return Error{printable(folder) + ": has 1 frame, and a video needs 2 or more; give a .jpg or .png to -o"};
}

std::vector<Camera> cameras_of(const Playing& playing) {
    const FrameCompositor& compositor = playing.player->compositor();
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < playing.sequence->frames.size(); ++i) {
        cameras.push_back(camera_of(*playing.sequence, i, compositor.width(), compositor.height()));
    }
    return cameras;
}

Status write_video(const ViewArguments& arguments, Playing& playing, const std::string& output, Progress& progress) {
    const double rate =
        arguments.frames_per_second_given ? arguments.frames_per_second : playing.sequence->frames_per_second;
    const std::vector<Camera> cameras = cameras_of(playing);
    std::size_t number = 0;
    const auto render = [&](const Camera&) { return playing.player->frame(number++); };
    progress.start("compositing", static_cast<std::int64_t>(cameras.size()));
    Status status = write_view_video(output, rate, cameras, render, progress);
    progress.finish();
    return status;
}

Status write_images(Playing& playing, const std::string& output, Progress& progress) {
    Result<StagedFolder> staged = StagedFolder::create(output, "frames of a sequence");
    if (!staged) return staged.error();
    const Rig rig = rig_of_views(cameras_of(playing));
    progress.start("compositing", static_cast<std::int64_t>(rig.views.size()));
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        const Result<Image<Rgba8>> frame = playing.player->frame(i);
        if (!frame) return frame.error();
        const fs::path file = staged->temporary_path() / rig.views[i].file_path;
        if (Status status = write_png(file, *frame); !status) return status;
        progress.advance();
    }
    progress.finish();
    if (Status status = write_rig(staged->temporary_path() / kRigFileName, rig); !status) return status;
    return staged->commit();
}

Status write_frame(Playing& playing, std::size_t number, const std::string& output) {
    if (number >= playing.sequence->frames.size()) {
        return Error{"--frame " + std::to_string(number) + ": the sequence has frames 0.." +
                     std::to_string(playing.sequence->frames.size() - 1)};
    }
    const Result<Image<Rgba8>> frame = playing.player->frame(number);
    if (!frame) return frame.error();
    if (lower_case_extension(output) == ".png") return write_png(output, *frame);
    return write_jpeg(output, *frame, kJpegQuality);
}

Status run_one(const ViewArguments& arguments) {
    const Result<Kind> kind = kind_of_output(arguments.output);
    if (!kind) return kind.error();
    const std::string& folder = arguments.sequences.front();
    Result<Playing> playing = open_sequence(arguments, folder);
    if (!playing) return playing.error();
    if (*kind == Kind::kVideo) {
        if (Status status = check_video(*playing, folder); !status) return status;
    }
    Result<gl::Context> context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    if (Status status = start_player(arguments, *playing); !status) return status;
    ProgressBar progress(arguments.quiet);
    Status status = *kind == Kind::kVideo    ? write_video(arguments, *playing, arguments.output, progress)
                    : *kind == Kind::kFolder ? write_images(*playing, arguments.output, progress)
                                             : write_frame(*playing, arguments.frame, arguments.output);
    print_warnings(playing->player->take_warnings());
    playing->player.reset();
    return status;
}

// NAME/sequence.mp4 and NAME/snapshot.jpg; nothing of them where it fails.
Status render_into(const ViewArguments& arguments, const std::string& folder, std::set<std::string>& names,
                   std::string& told) {
    Result<Playing> playing = open_sequence(arguments, folder);
    if (!playing) return playing.error();
    if (Status status = check_video(*playing, folder); !status) return status;
    std::string name = playing->sequence->name.empty() ? "sequence" : playing->sequence->name;
    for (int i = 2; names.contains(name); ++i) name = playing->sequence->name + "-" + std::to_string(i);
    names.insert(name);
    Result<StagedFolder> staged = StagedFolder::create(fs::path(arguments.output) / name, "videos of a sequence");
    if (!staged) return staged.error();
    if (Status status = start_player(arguments, *playing); !status) return status;
    ProgressBar progress(arguments.quiet);
    const fs::path place = staged->temporary_path();
    Status status = write_video(arguments, *playing, (place / "sequence.mp4").string(), progress);
    if (status) status = write_frame(*playing, arguments.frame, (place / "snapshot.jpg").string());
    print_warnings(playing->player->take_warnings());
    playing->player.reset();
    if (!status) return status;
    told = std::to_string(playing->sequence->frames.size()) + " frames -> " +
           (fs::path(arguments.output) / name / "sequence.mp4").string();
    return staged->commit();
}

Status run_batch(const ViewArguments& arguments) {
    const Result<Kind> kind = kind_of_output(arguments.output);
    if (!kind) return kind.error();
    if (*kind != Kind::kFolder) {
        return Error{arguments.output + ": " + std::to_string(arguments.sequences.size()) +
                     " sequences do not fit one file; give a folder to -o"};
    }
    Result<gl::Context> context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    std::error_code error;
    const bool made = fs::create_directories(arguments.output, error);
    std::set<std::string> names;
    std::vector<std::string> failures;
    for (const std::string& folder : arguments.sequences) {
        const auto begin = std::chrono::steady_clock::now();
        std::string told;
        const Status status = render_into(arguments, folder, names, told);
        if (!status) failures.push_back(status.error().message);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        std::printf("%s: %s (%.1f s)\n", printable(folder).c_str(), status ? printable(told).c_str() : "failed",
                    seconds.count());
        std::fflush(stdout);
    }
    if (made && failures.size() == arguments.sequences.size()) fs::remove(arguments.output, error);
    if (failures.empty()) return {};
    for (const std::string& failure : failures)
        std::fprintf(stderr, "rs-view: failed: %s\n", printable(failure).c_str());
    return Error{std::to_string(failures.size()) + " of " + std::to_string(arguments.sequences.size()) +
                 " sequences failed; see above"};
}

}  // namespace

Status run_sequences(const ViewArguments& arguments) {
    return arguments.sequences.size() == 1 ? run_one(arguments) : run_batch(arguments);
}

}  // namespace rs::compositor
