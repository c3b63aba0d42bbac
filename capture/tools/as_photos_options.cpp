#include "capture/tools/as_photos_options.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

namespace rs::capture {

CLI::Validator range(double low, double high) {
    const CLI::Validator is_number(
        [](const std::string& text) {
            return std::isnan(std::strtod(text.c_str(), nullptr)) ? "'" + text + "' is not a number" : std::string();
        },
        "");
    return CLI::Range(low, high) & is_number;
}

const char* const kAsPhotosExamples = R"(
  rs-capture synth spot.json --as-photos -o spot-photos --k1 -0.12
  rs-capture synth spot.json --as-photos -o printed --board board.png --board-width 2 --disc plain
  rs-capture synth spot.json --as-photos -o shop --recentred --disc none --photo-backdrop white
     photos of a turntable: photos/000.jpg etc., and truth/ with the exact cameras
     (36 views of 640x512, elevation 20 degrees, at the distance where everything fits in))";

std::vector<std::filesystem::path> input_files(const AsPhotosOptions& options) {
    std::vector<std::filesystem::path> files;
    if (!options.photos.board.empty()) files.push_back(options.photos.board);
    if (!is_procedural_backdrop(options.photos.backdrop)) files.emplace_back(options.photos.backdrop);
    return files;
}

void add_as_photos_options(CLI::App& synth, AsPhotosOptions& options) {
    PhotoOptions& photos = options.photos;
    SessionOptions& session = photos.session;
    CLI::Option* as_photos =
        synth.add_flag("--as-photos", options.is_enabled,
                       "Render photos of a turntable before a backdrop, with noise, as JPEG, and the ground truth");
    const auto number = [&](const char* name, double& value, const char* what, double low, double high) {
        return synth.add_option(name, value, std::string("Photos: ") + what)
            ->check(range(low, high))
            ->capture_default_str()
            ->needs(as_photos);
    };
    number("--k1", session.k1, "Radial distortion of the lens (Brown)", -1, 1)->type_name("K");
    number("--k2", session.k2, "Second term of the radial distortion", -1, 1)->type_name("K");
    number("--aim-error", session.aim_error_deg, "Largest error of the camera's pan, tilt and roll", 0, 10)
        ->type_name("DEG");
    number("--step-error", session.step_error_deg, "Standard deviation of the steps from view to view", 0, 30)
        ->type_name("DEG");
    number("--exposure-drift", session.exposure_drift, "Largest relative change of the exposure", 0, 0.9)
        ->type_name("X");
    number("--noise", photos.noise_codes, "Standard deviation of the noise, in 8-bit sRGB codes", 0, 100)
        ->type_name("CODES");
    synth.add_option("--jpeg", photos.jpeg_quality, "Photos: JPEG quality; 0 = PNG")
        ->check(CLI::Range(0, 100))
        ->capture_default_str()
        ->type_name("Q")
        ->needs(as_photos);
    static const std::map<std::string, DiscSurface> kSurfaces = {{"none", DiscSurface::none},
                                                                 {"plain", DiscSurface::plain},
                                                                 {"rings", DiscSurface::rings},
                                                                 {"speckled", DiscSurface::speckled}};
    synth
        .add_option_function<std::string>(
            "--disc", [&photos](const std::string& name) { photos.disc = kSurfaces.at(name); },
            "Photos: turntable disc; rings look the same at every angle, speckles do not")
        ->check(CLI::IsMember({"plain", "rings", "speckled", "none"}))
        ->default_str("rings")
        ->needs(as_photos);
    CLI::Option* board =
        synth.add_option("--board", photos.board, "Photos: an image on the disc, off-centre, that turns with it")
            ->type_name("FILE")
            ->needs(as_photos);
    number("--board-width", photos.board_width, "Width of --board in object radii", 0.01, 100)
        ->type_name("W")
        ->needs(board);
    synth
        .add_option("--photo-backdrop", photos.backdrop,
                    "Photos: wall, blue, white, or an image that is stretched to the frame")
        ->capture_default_str()
        ->type_name("FILE|wall|blue|white")
        ->needs(as_photos);
    synth
        .add_flag("--recentred", photos.recentred,
                  "Photos: shifted and scaled individually, so that the object fills the frame, as shops do")
        ->needs(as_photos);
    synth
        .add_flag("--counter-clockwise", session.counter_clockwise,
                  "Photos: the object turns counter-clockwise, seen from above")
        ->needs(as_photos);
}

}  // namespace rs::capture
