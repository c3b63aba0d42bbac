// Whitted ray tracing of the halls, compared with bare Embree packets in the same run.
//
//     bench_traced [--scene hall|great-hall] [--width PX] [--height PX] [--frames N] [--threads N]
//     bench_traced --table [--up-to PX] [--period S] [--threads N]
//
// Prints wall and CPU milliseconds per frame of:
//   - Whitted, whole frames; its rays one by one and in packets
//   - bare Embree on the same camera and shadow rays, as lists that are packed on the fly, and as prepared packets
//   - Whitted on a scene of instances only, and on a grid of 16x16 pixels
//   - moving 1000 instances
// Ratios are of CPU time, which depends less on other load.
//
// --table prints instead the frames per second of each traced renderer at 32x32 to 4096x4096 pixels, in the form of
// tables 4.1 and 4.2 of the paper on the architecture visualizer: its scenes of 150 220 and 66 450 triangles, which
// the halls replace, by six periods after one that is skipped. Columns are renderers instead of graphics cards. A
// frame has one sample per pixel, without filter and display.

#include "capture/tracer/integrator/tracer.hpp"
#include "capture/tracer/integrator/whitted.hpp"
#include "capture/tracer/packets/packet.hpp"
#include "capture/tracer/rays/ray_scene.hpp"
#include "capture/tracer/scene/scene_transform.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/light/light.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/scenes/hall.hpp"
#include "tests/bench/stopwatch.hpp"

#include <CLI/CLI.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

struct Arguments {
    std::string scene = "hall";
    int width = 512;
    int height = 512;
    int frames = 9;
    int threads = 0;
    bool table = false;
    int up_to_px = 4096;
    double period_s = 1;
};

// Materials as rs-view reads them from glTF: a specular coat over a diffuse surface.
Scene scene_of(const synthetic::Model& model) {
    Scene scene;
    scene.name = model.name;
    std::map<std::string, int> images;
    for (const auto& [file, image] : model.images) {
        images[file] = static_cast<int>(scene.textures.size());
        Texture texture;
        texture.pixels = Image<RgbaF>(image.width(), image.height());
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const Rgba8 p = image(x, y);
                texture.pixels(x, y) = {linear_from_srgb8(p.r), linear_from_srgb8(p.g), linear_from_srgb8(p.b), 1};
            }
        }
        scene.textures.push_back(std::move(texture));
    }
    for (const synthetic::ModelMaterial& source : model.materials) {
        Material material;
        material.name = source.name;
        material.kind = SurfaceKind::glossy;
        material.colour = source.colour;
        material.roughness = source.roughness;
        if (!source.image.empty()) material.texture = images[source.image];
        scene.materials.push_back(material);
    }
    for (const synthetic::ModelGroup& group : model.groups) scene.parts.push_back({group.name, group.meshes});
    for (const synthetic::ModelNode& node : model.nodes) {
        scene.instances.push_back({node.group, glm::dmat4(node.world_from_group)});
    }
    const nlohmann::json list = nlohmann::json::parse(model.lights);
    for (const auto& light : list["lights"]) {
        const auto triple = [&](const char* key) {
            return glm::dvec3(light[key][0].get<double>(), light[key][1].get<double>(), light[key][2].get<double>());
        };
        const glm::vec3 colour(triple("colour"));
        if (light["kind"] == "directional") {
            scene.lights.push_back(directional_light(glm::normalize(triple("aim")),
                                                     static_cast<float>(light["lux"].get<double>() / 179) * colour));
        } else {
            scene.lights.push_back(
                point_light(triple("location"), static_cast<float>(light["candela"].get<double>() / 179) * colour));
        }
    }
    return scene;
}

struct Cost {
    double wall_ms, cpu_ms;
};
// Minimum over the frames.
Cost measure(const char* what, int frames, const std::function<void()>& frame) {
    std::vector<double> wall_ms, cpu_ms;
    for (int i = 0; i < frames; ++i) {
        const bench::Stopwatch watch;
        frame();
        cpu_ms.push_back(watch.cpu_ms());
        wall_ms.push_back(watch.wall_ms());
    }
    std::ranges::sort(wall_ms);
    std::ranges::sort(cpu_ms);
    std::printf("%-40s %8.2f ms, median %8.2f; CPU %8.2f, median %8.2f\n", what, wall_ms.front(),
                wall_ms[wall_ms.size() / 2], cpu_ms.front(), cpu_ms[cpu_ms.size() / 2]);
    std::fflush(stdout);
    return {wall_ms.front(), cpu_ms.front()};
}

// Rays of a tile of 16x16 pixels, in the order in which Whitted traces them: camera rays in squares of 4x4, then the
// shadow rays from their hits, light by light.
struct TileRays {
    std::vector<RayScene::Ray> camera;
    std::vector<RayScene::Ray> shadow_rays;
};
std::vector<TileRays> rays_of_frame(const RayScene& rays, const Scene& scene, const Camera& camera) {
    std::vector<TileRays> tiles;
    for (int top = 0; top < camera.height; top += 16) {
        for (int left = 0; left < camera.width; left += 16) {
            TileRays rays_of_tile;
            for (int i = 0; i < 256; ++i) {
                const int x = left + i / 16 % 4 * 4 + i % 4, y = top + i / 64 * 4 + i / 4 % 4;
                if (x >= camera.width || y >= camera.height) continue;
                rays_of_tile.camera.push_back({glm::vec3(camera.centre()),
                                               glm::vec3(glm::normalize(camera.ray(x + 0.5, y + 0.5))), 0,
                                               std::numeric_limits<float>::infinity()});
            }
            for (const Light& light : scene.lights) {
                for (const RayScene::Ray& ray : rays_of_tile.camera) {
                    SurfacePoint point;
                    if (!rays.intersect(ray.origin, ray.direction, 0, point)) continue;
                    const glm::vec3 from = point.lifted_position + point.geometric_normal * rays.step_off();
                    const bool far = light.kind == LightKind::kDirectional;
                    const glm::vec3 way = far ? glm::vec3(-light.towards) : glm::vec3(light.location) - from;
                    const float length = glm::length(way);
                    if (!(glm::dot(way, point.shading_normal) > 0)) continue;
                    rays_of_tile.shadow_rays.push_back(
                        {from, way / length, 0, far ? std::numeric_limits<float>::infinity() : length * (1 - 1e-4F)});
                }
            }
            tiles.push_back(std::move(rays_of_tile));
        }
    }
    return tiles;
}

// The same rays as Embree packets.
struct Packets {
    std::vector<std::pair<MaskLanes, RayHitLanes>> camera;
    std::vector<std::pair<MaskLanes, RayLanes>> shadow_rays;
};
void fill(std::span<const RayScene::Ray> rays, MaskLanes& active, RayLanes& lanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
        const RayScene::Ray& ray = rays[std::min(i, rays.size() - 1)];
        active[i] = i < rays.size() ? -1 : 0;
        lanes.origin.set(i, ray.origin);
        lanes.direction.set(i, ray.direction);
        lanes.reach[i] = ray.reach;
        lanes.mask[i] = ~0U;
    }
}
Packets packets_of(const TileRays& rays_of_tile) {
    Packets packets;
    const auto part = [](const std::vector<RayScene::Ray>& rays, std::size_t first) {
        return std::span(rays).subspan(first, std::min(kLanes, rays.size() - first));
    };
    for (std::size_t i = 0; i < rays_of_tile.camera.size(); i += kLanes) {
        auto& [mask, ray_hit] = packets.camera.emplace_back();
        fill(part(rays_of_tile.camera, i), mask, ray_hit.ray);
        ray_hit.hit.mesh.of.fill(~0U);
        ray_hit.hit.instance.of.fill(~0U);
    }
    for (std::size_t i = 0; i < rays_of_tile.shadow_rays.size(); i += kLanes) {
        auto& [mask, ray] = packets.shadow_rays.emplace_back();
        fill(part(rays_of_tile.shadow_rays, i), mask, ray);
    }
    return packets;
}

Status run(const Arguments& arguments) {
    const synthetic::Model model = arguments.scene == "hall" ? synthetic::make_hall() : synthetic::make_great_hall();
    const Scene instanced = scene_of(model);
    const Scene flat = flattened(instanced);
    const Camera camera = look_at_camera(glm::dvec3(model.views[0].eye), glm::dvec3(model.views[0].at), radians(60),
                                         arguments.width, arguments.height);
    RS_ASSIGN_OR_RETURN(Tracer tracer, Tracer::create(flat));
    RS_ASSIGN_OR_RETURN(Tracer of_instances, Tracer::create(instanced));
    RS_ASSIGN_OR_RETURN(const RayScene rays, RayScene::create(flat));
    std::printf("%s, %lld triangles, %dx%d, %zu lights\n", model.name.c_str(),
                static_cast<long long>(synthetic::triangle_count(model)), arguments.width, arguments.height,
                flat.lights.size());
    RenderOptions options;
    options.method = RenderMethod::kWhitted;
    options.samples_per_pixel = 1;
    options.ambient = glm::vec3(0.1F);
    options.threads = arguments.threads;
    const std::vector<TileRays> tiles = rays_of_frame(rays, flat, camera);
    std::size_t count = 0;
    for (const TileRays& rays_of_tile : tiles) count += rays_of_tile.camera.size() + rays_of_tile.shadow_rays.size();

    const Cost whitted = measure("Whitted", arguments.frames, [&] { (void)tracer.render(camera, options); });
    const LightSet lights(flat, flat.environment, {0.5F * (rays.upper() + rays.lower()), glm::length(rays.upper())});
    const std::vector<SurfaceModel> models = make_surface_models(flat.materials);
    const LightTransport transport(flat, rays, lights, models);
    const WhittedTracer alone(transport, IrradianceMap(lights.environment()), options.ambient, 8);
    const auto of_rays = [&](bool packets) {
        return measure(packets ? "its rays, in packets" : "its rays, one by one", arguments.frames, [&] {
            for_each_index(static_cast<std::int64_t>(tiles.size()), arguments.threads, [&](std::int64_t i) {
                std::vector<CameraRay> many;
                for (const RayScene::Ray& ray : tiles[static_cast<std::size_t>(i)].camera) {
                    many.push_back({ray.origin, ray.direction, 0, Sampler(0, 0)});
                }
                std::vector<RadianceSample> samples(many.size());
                if (packets) {
                    alone.trace_many(many, samples);
                } else {
                    alone.Integrator::trace_many(many, samples);
                }
            });
        });
    };
    const Cost single = of_rays(false), packets = of_rays(true);
    const Cost bare = measure("bare Embree, packets, the same rays", arguments.frames, [&] {
        for_each_index(static_cast<std::int64_t>(tiles.size()), arguments.threads, [&](std::int64_t i) {
            const TileRays& rays_of_tile = tiles[static_cast<std::size_t>(i)];
            std::vector<RayScene::Hit> hits(rays_of_tile.camera.size());
            std::vector<std::uint8_t> hidden(rays_of_tile.shadow_rays.size());
            rays.intersect_many(rays_of_tile.camera, hits);
            rays.occluded_many(rays_of_tile.shadow_rays, hidden);
        });
    });
    std::vector<Packets> made;
    for (const TileRays& rays_of_tile : tiles) made.push_back(packets_of(rays_of_tile));
    const Cost beforehand = measure("bare Embree, prepared packets", arguments.frames, [&] {
        for_each_index(static_cast<std::int64_t>(made.size()), arguments.threads, [&](std::int64_t i) {
            const Packets& tile = made[static_cast<std::size_t>(i)];
            for (const auto& [mask, ray_hit] : tile.camera) {
                RayHitLanes found = ray_hit;
                rays.intersect(mask, found);
            }
            for (const auto& [mask, ray] : tile.shadow_rays) {
                RayLanes found = ray;
                rays.occluded(mask, found);
            }
        });
    });
    const Cost instances =
        measure("Whitted, all instances", arguments.frames, [&] { (void)of_instances.render(camera, options); });
    Camera coarse = camera;
    coarse.width = 1280 / 16;
    coarse.height = 720 / 16;
    coarse.fl_x = coarse.fl_y = coarse.fl_x * coarse.width / camera.width;
    coarse.cx = coarse.width / 2.0;
    coarse.cy = coarse.height / 2.0;
    measure("a grid of 16x16 pixels of 1280x720", arguments.frames, [&] { (void)tracer.render(coarse, options); });

    Scene movers = flat;
    movers.parts = {{"chair", model.groups[3].meshes}};
    for (int i = 0; i < 1000; ++i) movers.instances.push_back({0});
    RS_ASSIGN_OR_RETURN(Tracer moving, Tracer::create(movers));
    int step = 0;
    measure("1000 instances moved", arguments.frames, [&] {
        ++step;
        for (std::size_t i = 0; i < 1000; ++i) {
            const auto place = static_cast<double>(i);
            (void)moving.move(i, glm::translate(glm::dmat4(1), {0.02 * place, 0.1 * step, 0.003 * place}));
        }
        moving.commit();
    });
    std::printf("%.1f frames/s; %.2f rays per pixel; %.2f Mray/s per core\n", 1000 / whitted.wall_ms,
                static_cast<double>(count) / camera.width / camera.height,
                static_cast<double>(count) / whitted.cpu_ms / 1000);
    std::printf(
        "of bare Embree: frames %.2f, rays in packets %.2f (prepared packets %.2f), one by one %.2f; "
        "flattened %.2f times as fast as "
        "instances\n",
        bare.cpu_ms / whitted.cpu_ms, bare.cpu_ms / packets.cpu_ms, beforehand.cpu_ms / packets.cpu_ms,
        bare.cpu_ms / single.cpu_ms, instances.cpu_ms / whitted.cpu_ms);
    return {};
}

struct TableColumn {
    const char* name;
    RenderMethod method;
};
constexpr std::array kTableColumns{
    TableColumn{"Toon", RenderMethod::kToon}, TableColumn{"Whitted", RenderMethod::kWhitted},
    TableColumn{"Radiosity", RenderMethod::kRadiosity}, TableColumn{"Path", RenderMethod::kPath}};

// Mean rate of six periods after one that is skipped; of fewer periods, of one frame each, if frames take longer.
double frames_per_second(double period_s, const std::function<void()>& frame) {
    constexpr int kPeriods = 6;
    const auto rate_of_period = [&] {
        const bench::Stopwatch watch;
        int frames = 0;
        do {
            frame();
            ++frames;
        } while (watch.wall_s() < period_s);
        return frames / watch.wall_s();
    };
    (void)rate_of_period();
    const bench::Stopwatch total;
    double sum = 0;
    int periods = 0;
    do {
        sum += rate_of_period();
        ++periods;
    } while (periods < kPeriods && total.wall_s() < kPeriods * period_s);
    return sum / periods;
}

Status print_table(const char* number, const synthetic::Model& model, const Arguments& arguments) {
    const Scene scene = flattened(scene_of(model));
    RS_ASSIGN_OR_RETURN(const Tracer tracer, Tracer::create(scene));
    std::printf("Resolution");
    for (const TableColumn& column : kTableColumns) std::printf("\t%s", column.name);
    std::printf("\n");
    for (int side = 32; side <= arguments.up_to_px; side *= 2) {
        const Camera camera =
            look_at_camera(glm::dvec3(model.views[0].eye), glm::dvec3(model.views[0].at), radians(60), side, side);
        std::printf("%dx%d", side, side);
        for (const TableColumn& column : kTableColumns) {
            RenderOptions options;
            options.method = column.method;
            options.samples_per_pixel = 1;
            options.ambient = glm::vec3(0.1F);
            options.threads = arguments.threads;
            options.toon.edge_radius = static_cast<float>(2 * tracer.median_pixel_size(camera));
            try {
                const double rate =
                    frames_per_second(arguments.period_s, [&] { (void)tracer.render(camera, options); });
                std::printf("\t%.6f", rate);
            } catch (const std::bad_alloc&) {
                std::printf("\terror");
            }
            std::fflush(stdout);
        }
        std::printf("\n");
    }
    std::printf(
        "TABLE %s: Results showing performance in average FPS for various renderers and grid resolutions. Scene %s, "
        "%lld triangles, %zu lights.\n\n",
        number, model.name.c_str(), static_cast<long long>(synthetic::triangle_count(model)), scene.lights.size());
    return {};
}

Status print_tables(const Arguments& arguments) {
    RS_TRY(print_table("4.1", synthetic::make_great_hall(), arguments));
    return print_table("4.2", synthetic::make_hall(), arguments);
}

}  // namespace
}  // namespace rs::capture

int main(int argc, char** argv) {
    CLI::App app("Whitted's ray tracing of the halls beside bare Embree", "bench_traced");
    rs::capture::Arguments arguments;
    CLI::Option* const table = app.add_flag(
        "--table", arguments.table, "print frames per second by renderer and resolution, as tables 4.1 and 4.2");
    app.add_option("--up-to", arguments.up_to_px, "largest resolution of the tables, px")
        ->check(CLI::Range(32, 4096))
        ->needs(table)
        ->capture_default_str();
    app.add_option("--period", arguments.period_s, "seconds of a period of the tables; of the paper: 10")
        ->check(CLI::Range(0.01, 3600.0))
        ->needs(table)
        ->capture_default_str();
    app.add_option("--scene", arguments.scene, "hall or great-hall")
        ->check(CLI::IsMember({"hall", "great-hall"}))
        ->excludes(table)
        ->capture_default_str();
    app.add_option("--width", arguments.width, "px")->excludes(table)->capture_default_str();
    app.add_option("--height", arguments.height, "px")->excludes(table)->capture_default_str();
    app.add_option("--frames", arguments.frames, "frames per measurement")->excludes(table)->capture_default_str();
    app.add_option("--threads", arguments.threads, "threads; 0: all cores")->capture_default_str();
    std::function<rs::Status()> action;
    app.callback([&] {
        action = [&] { return arguments.table ? rs::capture::print_tables(arguments) : rs::capture::run(arguments); };
    });
    return rs::tool_main(app, argc, argv, action);
}
