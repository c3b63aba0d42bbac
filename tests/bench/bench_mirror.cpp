// Compares ray-space objects seen by rays reflected in a mirror, and drawn by the viewer, with the objects' meshes.
//
//     bench_mirror --objects FOLDER [--size 256] [--samples 16] [-o IMAGES]
//
// The mirror is placed so that it shows the viewer camera's view; the mesh in the mirror is the directly visible mesh,
// flipped. Objects that are missing in FOLDER are captured and encoded first, as in bench_truth. Prints for each object
// and direction the PSNR of the viewer's frame, the PSNR of the mirror's image, and their difference, over pixels that
// are not black in all images. With -o, frame, mirror and truth are written side by side.

#include "capture/tracer/integrator/tracer.hpp"
#include "compositor/gl/context.hpp"
#include "compositor/traced/object_primitive.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/compositor/truth_comparison.hpp"
#include "tests/compositor/truth_scene.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace rs::test {
namespace {

constexpr double kDistance = 3.4;  // of the camera, in object radii; the mirror is halfway
constexpr double kElevation_deg = 7;

struct Arguments {
    std::string objects, output;
    int side_px = 256;
    TruthOptions truth;
};

struct MirrorView {
    glm::dvec3 towards;  // from the object to the camera
    Camera camera;
};
MirrorView view_from(double turn_deg, int side_px) {
    const double e = radians(kElevation_deg), a = radians(turn_deg);
    const glm::dvec3 towards(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a));
    return {towards, look_at_camera(kDistance * towards, {0, 0, 0}, radians(38), side_px, side_px)};
}

// Traces the view by a mirror perpendicular to the line of sight, halfway along it.
Result<Image<Rgba8>> in_mirror(const compositor::PlacedObject& placed, const MirrorView& looked, int samples) {
    const glm::dvec3 n = looked.towards, middle = 0.5 * kDistance * n;
    const auto mirrored = [&](const glm::dvec3& v) { return v - 2 * glm::dot(v, n) * n; };
    capture::Scene scene;
    capture::Material mirror;
    mirror.kind = capture::SurfaceKind::mirror;
    mirror.colour = glm::vec3(1);
    scene.materials = {mirror};
    const glm::dvec3 across = 4.0 * looked.camera.right(), up = 4.0 * glm::cross(n, looked.camera.right());
    capture::Mesh glass;
    for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        glass.positions.emplace_back(middle + static_cast<double>(s) * across + static_cast<double>(t) * up);
    }
    glass.triangles = {{0, 2, 1}, {0, 3, 2}};
    scene.meshes = {glass};
    scene.primitives = {std::make_shared<compositor::ObjectPrimitive>(placed, 1.0F)};
    const Result<capture::Tracer> tracer = capture::Tracer::create(std::move(scene));
    if (!tracer) return tracer.error();

    const glm::dmat4& from = looked.camera.world_from_camera;
    Camera behind = looked.camera;
    behind.world_from_camera =
        glm::dmat4(glm::dvec4(-mirrored(glm::dvec3(from[0])), 0), glm::dvec4(mirrored(glm::dvec3(from[1])), 0),
                   glm::dvec4(mirrored(glm::dvec3(from[2])), 0),
                   glm::dvec4(mirrored(looked.camera.centre() - middle) + middle, 1));
    capture::RenderOptions options;
    options.method = capture::RenderMethod::kWhitted;
    options.samples_per_pixel = samples;
    const Image<Rgba8> seen = capture::to_srgb8(tracer->render(behind, options).image);
    Image<Rgba8> turned(seen.width(), seen.height());
    for (int y = 0; y < seen.height(); ++y) {
        for (int x = 0; x < seen.width(); ++x) {
            const Rgba8 p = seen(seen.width() - 1 - x, y);
            turned(x, y) = {p.r, p.g, p.b, 255};
        }
    }
    return turned;
}

bool black(Rgba8 p) {
    return p.r == 0 && p.g == 0 && p.b == 0;
}

struct Sums {
    double frame = 0, mirror = 0, pixels = 0;
    [[nodiscard]] double db(double sum) const { return 10 * std::log10(255.0 * 255 * 3 * pixels / sum); }
};

Status compare(const std::string& name, const Arguments& arguments) {
    auto object = read_object(std::filesystem::path(arguments.objects) / (name + ".rso"));
    if (!object) return object.error();
    auto viewable = compositor::make_viewable(std::move(*object));
    if (!viewable) return viewable.error();
    const compositor::PlacedObject placed{std::make_shared<const compositor::ViewableObject>(std::move(*viewable)), {}};
    Result<capture::SceneFile> recipe = object_of_recipe(name);
    if (!recipe) return recipe.error();
    auto traced = traced_object(std::move(*recipe));
    if (!traced) return traced.error();
    compositor::Scene nothing;
    nothing.background.sky = {glm::vec3(0)};
    nothing.navigation.headlight = false;
    compositor::FrameOptions frame;
    frame.width = frame.height = arguments.side_px;
    auto comparison = TruthComparison::create(nothing, {placed}, {{*traced, {}}}, frame);
    if (!comparison) return comparison.error();

    Sums all;
    for (const double turn_deg : {3.0, 123.0, 243.0}) {
        const MirrorView looked = view_from(turn_deg, arguments.side_px);
        const Result<TruthDifference> direct = comparison->compare(looked.camera, arguments.truth);
        if (!direct) return direct.error();
        const Result<Image<Rgba8>> mirror = in_mirror(placed, looked, arguments.truth.samples);
        if (!mirror) return mirror.error();
        const Image<Rgba8>& truth = direct->truth.image;
        Sums sums;
        Image<Rgba8> sheet(3 * truth.width(), truth.height());
        for (int y = 0; y < truth.height(); ++y) {
            for (int x = 0; x < truth.width(); ++x) {
                const Rgba8 a = direct->frame(x, y), b = (*mirror)(x, y), t = truth(x, y);
                sheet(x, y) = a;
                sheet(x + truth.width(), y) = b;
                sheet(x + 2 * truth.width(), y) = t;
                if (black(a) && black(b) && black(t)) continue;
                const auto square = [&](Rgba8 p) {
                    return std::pow(p.r - t.r, 2.0) + std::pow(p.g - t.g, 2.0) + std::pow(p.b - t.b, 2.0);
                };
                sums.frame += square(a);
                sums.mirror += square(b);
                sums.pixels += 1;
            }
        }
        all = {all.frame + sums.frame, all.mirror + sums.mirror, all.pixels + sums.pixels};
        std::printf("%-10s %6.0f deg %8.2f dB direct %8.2f dB in the mirror %+6.2f\n", name.c_str(), turn_deg,
                    sums.db(sums.frame), sums.db(sums.mirror), sums.db(sums.mirror) - sums.db(sums.frame));
        std::fflush(stdout);
        if (arguments.output.empty()) continue;
        std::filesystem::create_directories(arguments.output);
        const std::string file = name + "-" + std::to_string(static_cast<int>(turn_deg)) + ".png";
        if (Status written = write_png(std::filesystem::path(arguments.output) / file, sheet); !written) return written;
    }
    std::printf("%-10s        all %8.2f dB direct %8.2f dB in the mirror %+6.2f\n", name.c_str(), all.db(all.frame),
                all.db(all.mirror), all.db(all.mirror) - all.db(all.frame));
    return {};
}

Status run_bench(const Arguments& arguments) {
    const Result<gl::Context> context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    std::filesystem::create_directories(arguments.objects);
    for (const std::string& name : truth_object_names()) {
        if (!std::filesystem::exists(std::filesystem::path(arguments.objects) / (name + ".rso"))) {
            Result<capture::SceneFile> object = object_of_recipe(name);
            if (!object) return object.error();
            ProgressBar bar(false);
            if (Status made = write_captured_object(name, std::move(*object), {}, arguments.objects, &bar); !made) {
                return made;
            }
        }
        if (Status compared = compare(name, arguments); !compared) return compared;
    }
    return {};
}

}  // namespace
}  // namespace rs::test

int main(int argc, char** argv) {
    CLI::App app("Ray-space objects in a mirror, compared with their meshes", "bench_mirror");
    rs::test::Arguments arguments;
    app.add_option("--objects", arguments.objects, "folder of the objects; missing ones are captured first")
        ->required();
    app.add_option("-o,--output", arguments.output, "folder for frame, mirror and truth");
    app.add_option("--size", arguments.side_px, "width and height of the images, px")->capture_default_str();
    app.add_option("--samples", arguments.truth.samples, "samples per pixel")->capture_default_str();
    app.add_option("--paths", arguments.truth.paths_per_sample, "paths per sample of the truth that hits an object")
        ->capture_default_str();
    std::function<rs::Status()> run;
    app.callback([&] { run = [&] { return rs::test::run_bench(arguments); }; });
    return rs::tool_main(app, argc, argv, run);
}
