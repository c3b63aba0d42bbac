#include "compositor/tools/view_options.hpp"

#include "compositor/displays/stereo_image.hpp"
#include "engine/executors/executor_table.hpp"
#include "rayspace/tool/tool_main.hpp"

namespace rs::compositor {
namespace {

void add_sequence_options(CLI::App& app, ViewArguments& arguments) {
    CLI::Option* sequence =
        app.add_option(
               "--sequence", arguments.sequences,
               "in place of SCENE: maps whose anim/out/frames.json names a base scene and an extended OBJ for "
               "each frame (compositor/sequence/README.md), drawn by Phong's formula; -o takes .mp4, .jpg, .png or a "
               "folder of images. Several go into a folder, each as NAME/sequence.mp4 and NAME/snapshot.jpg")
            ->type_name("FOLDER")
            ->expected(1, 100000);
    app.add_option("--weather", arguments.weather,
                   "of a sequence, in place of its own: words from rain, snow and fog, with commas")
        ->type_name("rain|snow|fog,...")
        ->needs(sequence);
    app.add_option("--seed", arguments.seed, "of the weather: the same gives the same drops and flakes")
        ->check(CLI::Range(0, 1000000000))
        ->needs(sequence)
        ->capture_default_str();
    app.add_option("--visibility", arguments.visibility, "in fog, metres: the distance at which nothing else is seen")
        ->check(CLI::Range(1.0, 100000.0))
        ->needs(sequence)
        ->capture_default_str();
    app.add_option("--frame", arguments.frame, "of a sequence, from 0: which one a .jpg or .png shows")
        ->needs(sequence)
        ->capture_default_str();
    app.add_option("--convert", arguments.convert,
                   "a command that makes a sequence's files of another format: {in} is what --sequence names, {out} "
                   "the folder (or OBJ) to make. Run without a shell")
        ->type_name("'CMD {in} {out}'")
        ->needs(sequence);
}

void add_display_options(CLI::App& app, ViewArguments& arguments) {
    CLI::Option* walls =
        app.add_option(
               "--walls", arguments.walls,
               "in place of one view, those of one who stands before walls: cave, power-wall, tabletop, or a "
               "file of corners in metres (compositor/displays/README.md). With -o FOLDER an image a wall, else "
               "a window a wall. The scene's view says where the room stands; --size: of all walls")
            ->type_name("PRESET|FILE.json");
    app.add_option("--wall", arguments.wall_names, "only these, such as front,left: a machine for each wall")
        ->type_name("NAME,...")
        ->needs(walls);
    std::vector<std::string> forms;
    for (const NamedStereoForm& named : kStereoForms) forms.emplace_back(named.name);
    app.add_option("--stereo", arguments.stereo,
                   "both eyes' images of each wall: folders left and right, side by side, one above the other, or an "
                   "anaglyph for red and cyan glasses")
        ->type_name("[folders|side-by-side|top-bottom|anaglyph]")
        ->expected(0, 1)
        ->default_str("folders")
        ->check(CLI::IsMember(forms))
        ->needs(walls);
    app.add_option("--eye-distance", arguments.eye_distance_m,
                   "between the eyes, metres (0.065, or of the walls' file)")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("M")
        ->needs(walls);
    app.add_option("--heads", arguments.heads,
                   "where the head is in each frame, or the tracker that says so now, in datagrams as opentrack sends "
                   "them over UDP to this port of 127.0.0.1, or of the address that is named: windows follow it; -o "
                   "waits up to 10 s for the first, and draws that one (compositor/displays/README.md)")
        ->type_name("FILE.json|udp:[ADDRESS:]PORT")
        ->needs(walls);
    CLI::Option* quilt =
        app.add_option("--quilt", arguments.quilt,
                       "views from left to right as the tiles of one image, for displays with horizontal parallax; "
                       "-o FILE.png gets the layout into its name")
            ->type_name("COLSxROWS")
            ->excludes(walls);
    app.add_option("--tile-size", arguments.tile_size, "of a quilt's tiles, WxH")->capture_default_str()->needs(quilt);
    app.add_option("--cone", arguments.cone_deg, "over which a quilt's eyes spread, in degrees")
        ->check(CLI::Range(0.01, 170.0))
        ->capture_default_str()
        ->type_name("DEG")
        ->needs(quilt);
}

}  // namespace

void check_sequence_options(const ViewArguments& arguments) {
    if (arguments.sequences.empty()) return;
    if (!arguments.scene.empty() || !arguments.objects.empty() || !arguments.probe.empty()) {
        throw CLI::ValidationError("--sequence takes the place of SCENE, --object and --probe; give one of them");
    }
    if (arguments.sequences.size() > 1 && arguments.output.empty()) {
        throw CLI::ValidationError("several sequences need -o: the folder to write");
    }
}

void add_view_options(CLI::App& app, ViewArguments& arguments, bool& headless) {
    app.add_option(
        "SCENE", arguments.scene,
        "scene: .wrl, .wrl.gz (VRML97, VRML 1.0), .x3d, .x3dv, .gltf, .glb, .obj or .json (compositor/README.md)");
    app.add_option("--object", arguments.objects,
                   "FILE.rso[@X,Y,Z[,TURN_DEG[,SCALE]]]: an object whose foot stands at X,Y,Z, turned about Y; may be "
                   "repeated. Objects without a place stand in a row. Without SCENE they get a floor")
        ->type_name("OBJECT")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("-o,--output", arguments.output, "FILE.png, FILE.mp4 or a folder; without it, a window opens");
    app.add_flag("--headless", headless, "draw without a window or a display; implied by -o");
    app.add_option("--eye", arguments.eye, "viewpoint X,Y,Z; of the scene, or where all is in view")
        ->type_name("X,Y,Z");
    app.add_option("--at", arguments.at, "point looked at")->type_name("X,Y,Z");
    app.add_option("--fov", arguments.fov_deg, "horizontal field of view in degrees (50, or of the scene)")
        ->check(CLI::Range(1.0, 150.0));
    app.add_option("--viewpoint", arguments.viewpoint, "description of one of the scene's viewpoints (the first)")
        ->type_name("NAME");
    app.add_option("--path", arguments.path, "walk along the camera path of a JSON scene file, in place of the scene's")
        ->type_name("FILE.json");
    app.add_option(
           "--renderer", arguments.renderer,
           "of the geometry: raster (OpenGL); toon: a cartoon, in few tones and with lines along edges, in mirrors, "
           "too; "
           "whitted: traced direct light with hard shadows and mirrors; radiosity: and what walls reflect, by virtual "
           "lights, smooth early; path: all light, grainy at first, true at last. In a "
           "window T changes between raster and traced. Objects and blended surfaces are put into the traced image "
           "by depth")
        ->type_name("raster|toon|whitted|radiosity|path")
        ->check(CLI::IsMember({"raster", "toon", "whitted", "radiosity", "path"}))
        ->capture_default_str();
    app.add_option("--lights", arguments.lights,
                   "JSON list of lights, luminaires (IES, EULUMDAT) among them, beside the scene's or in their place "
                   "(compositor/traced/README.md)")
        ->type_name("FILE.json");
    app.add_option("--save-lights", arguments.save_lights,
                   "writes the lights in force as such a list, which replaces those of the scene; with -o also draws")
        ->type_name("FILE.json");
    app.add_option("--probe", arguments.probe,
                   "in place of a view: what light reaches X,Y,Z, as an .exr map that lights an object in "
                   "\"environment\" of a recipe of rs-capture synth as it will stand there")
        ->type_name("X,Y,Z");
    app.add_option("--tile", arguments.tile,
                   "in place of a view: of frame F of the traced image W x H pixels from (X, Y), as a .png, for "
                   "--tiles (workflow/Snakefile does all of it)")
        ->type_name("F:X,Y,WxH");
    app.add_option("--tiles", arguments.tiles, "take the traced images from this folder of tiles F-X-Y.png")
        ->type_name("FOLDER")
        ->check(CLI::ExistingDirectory);
    app.add_option("--plan", arguments.plan, "in place of a view: how many frames of which size it would be, as JSON")
        ->type_name("FILE.json");
    CLI::Option* passes =
        app.add_option("--passes", arguments.passes, "of a traced image: rays through each pixel of a frame (64)")
            ->check(CLI::Range(1, 65536));
    app.add_option("--seconds", arguments.seconds, "in place of --passes: as many as fit, for each frame")
        ->check(CLI::Range(0.01, 86400.0))
        ->excludes(passes);
    app.add_option("--exposure", arguments.exposure_ev, "stops by which lights are brighter (0)")
        ->check(CLI::Range(-40.0, 40.0))
        ->type_name("EV");
    app.add_flag(
        "--soft-shadows", arguments.soft_shadows,
        "whitted, toon: areas light from all over, not from their middle; in toon the soft rim has tones, too");
    app.add_option("--toon-lines", arguments.toon_lines,
                   "toon: how far from an edge its line reaches; 0: no lines (1/3000 of the scene's diagonal)")
        ->check(CLI::Range(0.0, 1e6))
        ->type_name("LENGTH");
    app.add_option("--lens", arguments.lens,
                   "traced images: the opening of the lens in mm (the scene counting metres), or "
                   "f/N of a focal length on 36 mm film; all else than what --focus says is blurred. "
                   "Objects that are put into the image stay sharp")
        ->type_name("MM|f/N");
    app.add_option("--focus", arguments.focus,
                   "distance of what is sharp, along the line of sight: with --lens; with --quilt, of what all "
                   "views agree on (of the largest object in the image, or the middle of the scene)")
        ->check(CLI::Range(1e-6, 1e9))
        ->type_name("DISTANCE");
    app.add_option("--shadows", arguments.shadows,
                   "of raster: lights throw shadows of geometry and objects onto geometry and floors. In a window O "
                   "switches them")
        ->type_name("on|off")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
    app.add_flag("--wire-frame", arguments.wire_frame, "only the edges of the geometry's triangles");
    app.add_option("--object-depth", arguments.object_depth,
                   "how deep objects are: one plane each, or every pixel by itself, so that objects, and objects and "
                   "geometry, reach into each other; boards give no depth")
        ->type_name("plane|pixel")
        ->check(CLI::IsMember({"plane", "pixel"}))
        ->capture_default_str();
    app.add_option("--object-samples", arguments.object_samples,
                   "across a pixel, at most, where an object is so far that its captured pixels are smaller than the "
                   "frame's; fewer are faster and show distant objects grainy")
        ->check(CLI::Range(1, kMostSamplesAcross))
        ->capture_default_str();
    app.add_flag("--upright", arguments.upright,
                 "draw objects for level cameras and look them up in that: much faster, a touch softer where objects "
                 "are far; windows, --streaming and boards always do");
    app.add_option("--size", arguments.size, "size of the frames, WxH")->capture_default_str();
    app.add_option("--orbit", arguments.orbit, "N frames once around the point looked at")
        ->check(CLI::Range(1, 100000));
    app.add_option("--fps", arguments.frames_per_second, "frames per second of an .mp4")
        ->check(CLI::Range(1.0, 240.0))
        ->capture_default_str();
    app.add_option("--samples", arguments.samples, "per pixel, for the edges of geometry")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    app.add_option("--stats", arguments.stats, "with -o: also write the frames' times, by part, as JSON")
        ->check(ends_in({".json"}))
        ->type_name("FILE.json");
    app.add_option("--executor", arguments.executor,
                   "who draws the objects, with the core for what that one cannot draw: " + engine::executor_names() +
                       " (the model of the hardware board: rs-engine simulate --help)")
        ->type_name("NAME")
        ->capture_default_str();
    app.add_option("--memory", arguments.memory_mib,
                   "MiB that objects may take; room by room they come and go (half of the machine's memory)")
        ->type_name("MIB")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 30));
    app.add_flag("--streaming", arguments.streaming,
                 "with -o: walk in real time, objects come when they are read, as a visitor sees it; else every frame "
                 "waits for its objects");
    add_sequence_options(app, arguments);
    add_display_options(app, arguments);
    app.add_flag("-q,--quiet", arguments.quiet, "no progress bar");
    app.footer(
        "Lengths are in the scene's units; an object of scale 1 has radius 1. Y is up.\n"
        "Examples:\n"
        "  rs-view museum.wrl\n"
        "  rs-view --object vase.rso -o shot.png\n"
        "  rs-view --object vase.rso@-1.2,0,0 --object lamp.rso@1.2,0,0,45,0.8 --orbit 120 -o turn.mp4\n"
        "  rs-view world.wrl -o world.png\n"
        "  rs-view hall.wrl --renderer path --lights evening.json --passes 256 -o evening.png\n"
        "  rs-view hall.wrl --renderer toon --passes 16 -o cartoon.png\n"
        "  rs-view hall.wrl --renderer path --lens f/1.4 --focus 2.5 -o portrait.png\n"
        "  rs-view hall.wrl --lights evening.json --probe 0,0.9,0 -o evening.exr\n"
        "  rs-view hall.wrl --save-lights hall_lights.json\n"
        "  rs-view --sequence maps/street --weather rain -o street.mp4\n"
        "  rs-view hall.wrl --walls cave --stereo side-by-side -o walls\n"
        "  rs-view hall.wrl --walls cave --heads udp:0.0.0.0:4242\n"
        "  rs-view hall.wrl --quilt 5x9 -o hall.png\n"
        "  rs-view room.json --eye 0,1.2,6 --at 0,0.8,0 --fov 45 --size 1920x1080 -o room.png");
}

}  // namespace rs::compositor
