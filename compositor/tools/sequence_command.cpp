#include "compositor/gl/context.hpp"
#include "compositor/lighting/light_warnings.hpp"
#include "compositor/playback/sequence_player.hpp"
#include "compositor/sequence/converter.hpp"
#include "compositor/sequence/frames_file.hpp"
#include "compositor/tools/camera_options.hpp"
#include "compositor/tools/commands.hpp"
#include "compositor/tools/drawing_options.hpp"
#include "compositor/tools/frame_output.hpp"
#include "compositor/tools/scene_options.hpp"
#include "compositor/tools/sharing_options.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "compositor/tools/window_content.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/tool/tool_main.hpp"

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
constexpr int kDefaultPassesOfFrame = 16;

struct SequenceOptions {
    std::vector<std::string> folders;
    std::optional<std::string> output;  // a window if not given
    std::optional<std::string> lights;
    std::size_t frame = 0;  // of a single image
    std::optional<double> frames_per_second;
    ViewOptions view;
    std::string size = "1280x720";
    std::optional<std::string> weather;  // rain, snow, fog; the sequence's own if not given
    std::uint32_t seed = Weather{}.seed;
    double visibility_m = Weather{}.visibility;
    std::optional<std::string> convert;  // CMD {in} {out}
    RendererOptions renderer;
    int passes = kDefaultPassesOfFrame;
    double shutter = 0;
    int shutter_samples = 8;
    DrawingOptions drawing;
    bool upright = false;
    ExecutorOptions executor;
    SharingOptions sharing;
    std::optional<std::string> stats;
    bool force = false;
    bool quiet = false;
};

enum class SequenceOutput { kVideo, kImage, kFolder };

Result<SequenceOutput> output_of_sequence(const std::string& output) {
    const std::string ending = lower_case_extension(output);
    if (ending == ".mp4") return SequenceOutput::kVideo;
    if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") return SequenceOutput::kImage;
    const Result<OutputKind> kind = output_kind(output);
    if (!kind) return Error{output + ": sequences are written as .mp4, .jpg or .png; give such a name, or a folder"};
    return SequenceOutput::kFolder;
}

// The weather of --weather; nullopt for the sequence's own.
Result<std::optional<Weather>> requested_weather(const SequenceOptions& options) {
    if (!options.weather) return std::optional<Weather>();
    RS_ASSIGN_OR_RETURN(Weather weather, parse_weather(*options.weather));
    weather.seed = options.seed;
    weather.visibility = options.visibility_m;
    return std::optional<Weather>(weather);
}

// Files that the options name and the command reads.
std::vector<fs::path> input_files(const SequenceOptions& options) {
    std::vector<fs::path> files(options.folders.begin(), options.folders.end());
    files.emplace_back(options.renderer.toon_style.value_or(""));
    files.emplace_back(options.lights.value_or(""));
    return files;
}

Result<PlayerOptions> player_options(const SequenceOptions& options, const engine::ExecutorTraits& executor) {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(const TracedOptions tracing, traced_options(options.renderer));
    RS_ASSIGN_OR_RETURN(const std::optional<Weather> weather, requested_weather(options));
    PlayerOptions player;
    RS_ASSIGN_OR_RETURN(player.frame,
                        frame_options(options.drawing, options.renderer, size, options.upright || !executor.tilted));
    player.frame.time_parts = options.stats.has_value();
    if (options.renderer.method()) player.tracing = tracing;
    player.passes = options.passes;
    player.shutter = options.shutter;
    player.shutter_samples = options.shutter_samples;
    player.weather = weather;
    player.memory_bytes = options.executor.memory_mib << 20;
    return player;
}

// The camera of --viewpoint, --eye and --at for all frames; nullopt if none of them is given. A missing eye or point
// looked at is that of the sequence's first camera.
Result<std::optional<Camera>> fixed_camera(const ViewOptions& view, const Sequence& sequence, PixelSize size) {
    if (!view.viewpoint && !view.eye && !view.at) return std::optional<Camera>();
    const SequenceCamera first = own_or_framing_camera(sequence, 0, static_cast<double>(size.width) / size.height);
    Scene scene = sequence.scene;
    scene.camera = CameraPath{};
    scene.camera->fov_x_rad = first.fov_x_rad;
    scene.camera->keys = {first.pose};
    const auto no_objects = [] { return Result<std::vector<PlacedObject>>(std::vector<PlacedObject>()); };
    RS_ASSIGN_OR_RETURN(const std::vector<Camera> cameras,
                        requested_cameras(view, MotionOptions{}, scene, no_objects, size));
    return std::optional<Camera>(cameras.front());
}

// Applies --lights and --fov.
Status change_sequence(const SequenceOptions& options, PixelSize size, Sequence& sequence) {
    if (options.lights) {
        RS_TRY(add_lights_of_file(sequence.scene, *options.lights));
        print_warnings(light_warnings(sequence.scene));
    }
    if (options.view.fov_deg) {
        set_field_of_view(sequence, radians(*options.view.fov_deg), static_cast<double>(size.width) / size.height);
    }
    return {};
}

// A sequence and its player.
struct OpenSequence {
    std::optional<ConvertedScene> converted;  // owns the files that --convert made
    fs::path files;                           // its folder or file
    std::shared_ptr<const Sequence> sequence;
    std::optional<Camera> camera;  // of all frames; nullopt: the sequence's cameras
    std::optional<SequencePlayer> player;
};

Result<OpenSequence> open_sequence(const SequenceOptions& options, const std::string& folder) {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    OpenSequence opened;
    fs::path files = folder;
    if (options.convert) {
        RS_ASSIGN_OR_RETURN(ConvertedScene converted, convert_scene(*options.convert, folder));
        files = converted.path;
        opened.converted.emplace(std::move(converted));
    }
    RS_ASSIGN_OR_RETURN(Sequence sequence, read_sequence(files));
    opened.files = files;
    if (opened.converted) sequence.name = fs::path(folder).stem().string();
    print_warnings(sequence.scene.warnings);
    RS_TRY(change_sequence(options, size, sequence));
    RS_ASSIGN_OR_RETURN(opened.camera, fixed_camera(options.view, sequence, size));
    opened.sequence = std::make_shared<const Sequence>(std::move(sequence));
    return opened;
}

Status start_player(const SequenceOptions& options, OpenSequence& opened) {
    RS_ASSIGN_OR_RETURN(ObjectExecutor created, create_executor(options.executor, options.drawing.object_depth));
    RS_ASSIGN_OR_RETURN(PlayerOptions player_settings, player_options(options, created.traits));
    player_settings.camera = opened.camera;
    RS_ASSIGN_OR_RETURN(SequencePlayer player,
                        SequencePlayer::create(opened.sequence, player_settings, std::move(created.executor)));
    opened.player.emplace(std::move(player));
    return {};
}

Status check_video(const OpenSequence& opened, const std::string& folder) {
    if (opened.sequence->frames.size() >= 2) return {};
    return Error{printable(folder) + ": has 1 frame, and a video needs 2 or more; give a .jpg or .png to -o"};
}

std::vector<Camera> cameras_of(const OpenSequence& opened) {
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < opened.player->frames(); ++i) cameras.push_back(opened.player->camera(i));
    return cameras;
}

Status write_video(const SequenceOptions& options, OpenSequence& opened, const std::string& output,
                   Progress& progress) {
    const double rate = options.frames_per_second.value_or(opened.sequence->frames_per_second);
    const std::vector<Camera> cameras = cameras_of(opened);
    std::size_t number = 0;
    const auto render = [&](const Camera&) { return opened.player->frame(number++); };
    progress.start("compositing", static_cast<std::int64_t>(cameras.size()));
    Status status = write_view_video(output, rate, cameras, render, progress);
    progress.finish();
    return status;
}

Status write_images(OpenSequence& opened, const std::string& output, bool force, Progress& progress) {
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output, "frames of a sequence", force));
    const Rig rig = make_rig_of_views(cameras_of(opened));
    progress.start("compositing", static_cast<std::int64_t>(rig.views.size()));
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> frame, opened.player->frame(i));
        const fs::path file = staged.temporary_path() / rig.views[i].file_path;
        RS_TRY(write_png(file, frame));
        progress.advance();
    }
    progress.finish();
    RS_TRY(write_rig(staged.temporary_path() / kRigFileName, rig));
    return staged.commit();
}

Status write_image(OpenSequence& opened, std::size_t number, const std::string& output) {
    if (number >= opened.sequence->frames.size()) {
        return Error{"--frame " + std::to_string(number) + ": the sequence has frames 0.." +
                     std::to_string(opened.sequence->frames.size() - 1)};
    }
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> frame, opened.player->frame(number));
    if (lower_case_extension(output) == ".png") return write_png(output, frame);
    return write_jpeg(output, frame, kJpegQuality);
}

Status render_sequence(const SequenceOptions& options) {
    const std::string& output = *options.output;
    RS_ASSIGN_OR_RETURN(const SequenceOutput kind, output_of_sequence(output));
    const std::string& folder = options.folders.front();
    RS_ASSIGN_OR_RETURN(OpenSequence opened, open_sequence(options, folder));
    if (kind == SequenceOutput::kVideo) {
        RS_TRY(check_video(opened, folder));
    }
    RS_TRY(check_outputs({}, opened.sequence->scene,
                         {.outputs = {output, options.stats.value_or("")}, .inputs = input_files(options)}));
    RS_ASSIGN_OR_RETURN(const gl::Context context, gl::Context::create_surfaceless());
    RS_TRY(start_player(options, opened));
    ProgressBar progress(options.quiet);
    Status status = kind == SequenceOutput::kVideo    ? write_video(options, opened, output, progress)
                    : kind == SequenceOutput::kFolder ? write_images(opened, output, options.force, progress)
                                                      : write_image(opened, options.frame, output);
    print_warnings(opened.player->take_warnings());
    if (status && options.stats) status = write_file(*options.stats, opened.player->times_as_json());
    opened.player.reset();
    return status;
}

// Writes NAME/sequence.mp4 and NAME/snapshot.jpg into the output folder, or nothing if it fails. Returns a summary.
Result<std::string> render_into_folder(const SequenceOptions& options, const std::string& folder,
                                       std::set<std::string>& names) {
    RS_ASSIGN_OR_RETURN(OpenSequence opened, open_sequence(options, folder));
    RS_TRY(check_video(opened, folder));
    std::string name = opened.sequence->name.empty() ? "sequence" : opened.sequence->name;
    for (int i = 2; names.contains(name); ++i) name = opened.sequence->name + "-" + std::to_string(i);
    names.insert(name);
    const fs::path target = fs::path(*options.output) / name;
    RS_TRY(refuse_overwriting_inputs(target, input_files(options)));
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(target, "videos of a sequence", options.force));
    RS_TRY(start_player(options, opened));
    ProgressBar progress(options.quiet);
    const fs::path temporary = staged.temporary_path();
    Status status = write_video(options, opened, (temporary / "sequence.mp4").string(), progress);
    if (status) status = write_image(opened, options.frame, (temporary / "snapshot.jpg").string());
    print_warnings(opened.player->take_warnings());
    opened.player.reset();
    if (!status) return status.error();
    RS_TRY(staged.commit());
    return std::to_string(opened.sequence->frames.size()) + " frames -> " + (target / "sequence.mp4").string();
}

// Renders several sequences, with a line on stdout for each; goes on after a failure and reports failures at the end.
Status render_sequences(const SequenceOptions& options) {
    const std::string& output = *options.output;
    RS_ASSIGN_OR_RETURN(const SequenceOutput kind, output_of_sequence(output));
    if (kind != SequenceOutput::kFolder) {
        return Error{output + ": " + std::to_string(options.folders.size()) +
                     " sequences do not fit one file; give a folder to -o"};
    }
    RS_ASSIGN_OR_RETURN(const gl::Context context, gl::Context::create_surfaceless());
    std::error_code error;
    const bool created = fs::create_directories(output, error);
    std::set<std::string> names;
    std::vector<std::string> failures;
    for (const std::string& folder : options.folders) {
        const auto begin = std::chrono::steady_clock::now();
        const Result<std::string> summary = render_into_folder(options, folder, names);
        if (!summary) failures.push_back(summary.error().message);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        std::printf("%s: %s (%.1f s)\n", printable(folder).c_str(), summary ? printable(*summary).c_str() : "failed",
                    seconds.count());
        std::fflush(stdout);
    }
    if (created && failures.size() == options.folders.size()) fs::remove(output, error);
    if (failures.empty()) return {};
    for (const std::string& failure : failures)
        std::fprintf(stderr, "rs-view: failed: %s\n", printable(failure).c_str());
    return Error{std::to_string(failures.size()) + " of " + std::to_string(options.folders.size()) +
                 " sequences failed; see above"};
}

// Machines that share a sequence must have the same frames.json, or extended OBJ.
Result<SharingPeers> peers_of(const SharingOptions& options, const OpenSequence& opened) {
    if (!options.is_given()) return SharingPeers();
    RS_ASSIGN_OR_RETURN(const SequenceFiles files, find_sequence(opened.files));
    return sharing_peers(options, files.file, {});
}

Result<WindowContent> content_of_sequence(const SequenceOptions& options, const std::string& folder) {
    RS_ASSIGN_OR_RETURN(const OpenSequence opened, open_sequence(options, folder));
    const std::shared_ptr<const Sequence>& sequence = opened.sequence;
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(ObjectExecutor created, create_executor(options.executor, options.drawing.object_depth));
    RS_ASSIGN_OR_RETURN(const std::optional<Weather> weather, requested_weather(options));
    WindowContent content;
    content.title = sequence->name.empty() ? "sequence" : sequence->name;
    VisitOptions& visit = content.visit;
    RS_ASSIGN_OR_RETURN(visit.sharing, peers_of(options.sharing, opened));
    RS_ASSIGN_OR_RETURN(visit.tracing, traced_options(options.renderer));
    visit.scene_name = content.title;
    visit.sequence = sequence;
    visit.weather = weather ? weather : sequence->weather;
    RS_ASSIGN_OR_RETURN(visit.frame, frame_options(options.drawing, options.renderer, size, true));
    visit.traced = options.renderer.method().has_value();
    visit.viewpoints = {viewpoint_of(opened.camera.value_or(camera_of(*sequence, 0, size.width, size.height)))};
    visit.follows_sequence = !opened.camera;
    if (options.lights) visit.lights = *options.lights;
    visit.executor = created.traits.name;
    content.scene = visit.weather ? apply_weather(sequence->scene, *visit.weather) : sequence->scene;
    content.showroom = std::make_unique<Showroom>(
        content.scene, ShowroomOptions{.memory_bytes = options.executor.memory_mib << 20}, std::move(created.executor));
    return content;
}

Status show_sequence(const SequenceOptions& options) {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(WindowContent content, content_of_sequence(options, options.folders.front()));
    auto window = Window::create({.title = content.title, .width = size.width, .height = size.height});
    if (!window) return Error{window.error().message + "; give -o to write an image or a video"};
    const WindowSettings settings{options.size, options.renderer, options.drawing, options.executor};
    return show_contents(std::move(*window), std::move(content), [&](const std::string& file) {
        return is_sequence(file) ? content_of_sequence(options, file) : scene_content(settings, file);
    });
}

// Refuses options that apply to another kind of output.
void check_output_options(const CLI::App& command, const SequenceOptions& options) {
    if (options.folders.size() > 1) {
        if (!options.stats) return;
        throw CLI::ValidationError("--stats needs a single sequence; run the command once for each");
    }
    const Result<SequenceOutput> kind = output_of_sequence(*options.output);
    if (!kind) return;  // reported later
    if (*kind != SequenceOutput::kImage && command.count("--frame") > 0)
        throw CLI::ValidationError("--frame needs -o FILE.jpg or FILE.png");
    if (*kind != SequenceOutput::kVideo && command.count("--fps") > 0)
        throw CLI::ValidationError("--fps needs -o FILE.mp4");
}

void check_sequence_options(const CLI::App& command, const SequenceOptions& options) {
    check_sharing_options(options.sharing, !options.output);
    check_focus_option(command);
    if (!options.weather) {
        for (const char* const name : {"--seed", "--visibility"}) {
            if (command.count(name) > 0) throw CLI::ValidationError(std::string(name) + " needs --weather");
        }
    }
    if (command.count("--shutter-samples") > 0 && options.shutter == 0)
        throw CLI::ValidationError("--shutter-samples needs --shutter");
    if (options.output) {
        check_renderer_options(command, options.renderer);
        check_output_options(command, options);
        return;
    }
    if (options.folders.size() > 1) throw CLI::ValidationError("several sequences need -o: the folder to write");
    for (const char* const name : {"--frame", "--fps", "--convert", "--passes", "--shutter", "--toon-objects",
                                   "--upright", "--stats", "--force", "--quiet"}) {
        if (command.count(name) == 0) continue;
        throw CLI::ValidationError(std::string(name) + " needs -o: the video, image or folder to write");
    }
}

}  // namespace

Result<WindowContent> sequence_content(const WindowSettings& settings, const std::string& folder) {
    SequenceOptions options;
    options.size = settings.size;
    options.renderer = settings.renderer;
    options.drawing = settings.drawing;
    options.executor = settings.executor;
    return content_of_sequence(options, folder);
}

void add_sequence_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<SequenceOptions>();
    CLI::App* command = app.add_subcommand(
        "sequence", "Play or render frames of extended OBJ over a base scene (compositor/sequence/README.md)");
    command
        ->add_option("FOLDER", options->folders,
                     "folder with anim/out/frames.json, the frames.json itself, or one extended OBJ")
        ->type_name("")
        ->required();
    hide_help_option(*command);
    add_lights_option(*command, options->lights);
    command
        ->add_option("-o,--output", options->output,
                     ".mp4, .jpg, .png, or a folder; of several sequences a folder of NAME/sequence.mp4")
        ->type_name("OUTPUT");
    command->add_option("--frame", options->frame, "number of the frame that a .jpg or .png shows, from 0")
        ->type_name("N")
        ->capture_default_str();
    command->add_option("--fps", options->frames_per_second, "frames per second of an .mp4 (default: sequence's)")
        ->check(CLI::Range(1.0, 240.0).description(""))
        ->type_name("RATE");
    add_view_options(*command, options->view);
    command->get_option("--viewpoint")
        ->description("camera at this viewpoint of the base scene, in place of the sequence's");
    command->get_option("--eye")->description("fixed camera, in place of the sequence's");
    command->get_option("--at")->description("point that the fixed camera looks at");
    command->get_option("--fov")->description("horizontal field of view, 1..150 degrees (default: sequence's)");
    add_size_option(*command, options->size);
    command
        ->add_option("--weather", options->weather,
                     "rain, snow, fog or rain,fog (default: sequence's own); drops and flakes vary with --seed N")
        ->type_name("NAME,...");
    // --seed and --shutter-samples are shown with other options, because the help would not fit on a screen otherwise.
    command->add_option("--seed", options->seed, "seed of the drops and flakes of --weather")
        ->check(CLI::Range(0, 1000000000).description(""))
        ->type_name("N")
        ->group("");
    command->add_option("--visibility", options->visibility_m, "distance in metres at which fog hides everything")
        ->check(CLI::Range(1.0, 100000.0).description(""))
        ->type_name("M")
        ->capture_default_str();
    command
        ->add_option("--convert", options->convert,
                     "command that converts FOLDER {in} to a sequence or an OBJ {out}; run without a shell")
        ->type_name("'CMD {in} {out}'");
    add_renderer_options(*command, options->renderer);
    add_lens_options_in_one_line(*command, options->renderer);
    command->add_option("--passes", options->passes, "traced: rays per pixel of a frame, 1..65536")
        ->check(CLI::Range(1, 65536).description(""))
        ->type_name("N")
        ->capture_default_str();
    command
        ->add_option(
            "--shutter", options->shutter,
            "blur motion over this part, 0..1, of the time between frames: mean of --shutter-samples (8) images")
        ->check(CLI::Range(0.0, 1.0).description(""))
        ->type_name("PART")
        ->capture_default_str();
    command->add_option("--shutter-samples", options->shutter_samples, "images that --shutter averages, 2..256")
        ->check(CLI::Range(2, 256).description(""))
        ->type_name("N")
        ->group("");
    add_drawing_options(*command, options->drawing);
    add_upright_option(*command, options->upright);
    add_executor_options(*command, options->executor);
    add_sharing_options(*command, options->sharing);
    add_stats_option(*command, options->stats);
    command->add_flag("--force", options->force, kForceHelp);
    command->add_flag("-q,--quiet", options->quiet, "no progress bar");
    command->footer("Example: rs-view sequence maps/street --weather rain -o street.mp4");
    command->callback([command, options, &run] {
        check_sequence_options(*command, *options);
        run = [options] {
            if (!options->output) return show_sequence(*options);
            return options->folders.size() == 1 ? render_sequence(*options) : render_sequences(*options);
        };
    });
}

}  // namespace rs::compositor
