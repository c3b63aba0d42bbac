#include "compositor/tools/view_options.hpp"

#include "engine/executors/executor_table.hpp"

namespace rs::compositor {

void add_view_options(CLI::App& app, ViewArguments& arguments, bool& headless) {
    app.add_option("SCENE", arguments.scene,
                   "scene: .wrl, .wrl.gz (VRML97), .gltf, .glb, .obj or .json (compositor/README.md)");
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
           "window T changes between raster and traced. Objects and blended surfaces are put into the traced picture "
           "by depth")
        ->type_name("raster|toon|whitted|radiosity|path")
        ->check(CLI::IsMember({"raster", "toon", "whitted", "radiosity", "path"}))
        ->capture_default_str();
    app.add_option("--lights", arguments.lights,
                   "JSON list of lights, luminaires (IES, EULUMDAT) among them, beside the scene's or in their place "
                   "(compositor/README.md)")
        ->type_name("FILE.json");
    app.add_option("--probe", arguments.probe,
                   "in place of a view: what light reaches X,Y,Z, as an .exr map that lights an object in "
                   "\"environment\" of a recipe of rs-capture synth as it will stand there")
        ->type_name("X,Y,Z");
    CLI::Option* passes =
        app.add_option("--passes", arguments.passes, "of a traced picture: rays through each pixel of a frame (64)")
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
    CLI::Option* lens =
        app.add_option("--lens", arguments.lens,
                       "traced pictures: the opening of the lens in mm (the scene counting metres), or "
                       "f/N of a focal length on 36 mm film; all else than what --focus says is blurred. "
                       "Objects that are put into the picture stay sharp")
            ->type_name("MM|f/N");
    app.add_option("--focus", arguments.focus, "with --lens: distance of what is sharp, along the line of sight")
        ->check(CLI::Range(1e-6, 1e9))
        ->type_name("DISTANCE")
        ->needs(lens);
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
        "  rs-view room.json --eye 0,1.2,6 --at 0,0.8,0 --fov 45 --size 1920x1080 -o room.png");
}

}  // namespace rs::compositor
