#include "tests/compositor/truth_image.hpp"

#include "capture/tracer/integrator/path.hpp"
#include "capture/tracer/integrator/sampler.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace rs::test {
namespace {

constexpr int kMaxBounces = 16;  // as in the captures

glm::vec3 texel(const compositor::SceneTexture& texture, int x, int y) {
    const auto placed = [](int i, int size, bool repeat) {
        return repeat ? ((i % size) + size) % size : std::clamp(i, 0, size - 1);
    };
    const Rgba8 pixel = texture.image(placed(x, texture.image.width(), texture.repeat_s),
                                      placed(y, texture.image.height(), texture.repeat_t));
    return {linear_from_srgb8(pixel.r), linear_from_srgb8(pixel.g), linear_from_srgb8(pixel.b)};
}

// Bilinear lookup; (0, 0) is the lower left corner.
glm::vec3 texture_at(const compositor::SceneTexture& texture, const glm::vec2& st) {
    const float x = st.s * static_cast<float>(texture.image.width()) - 0.5F;
    const float y = (1 - st.t) * static_cast<float>(texture.image.height()) - 0.5F;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const int i = static_cast<int>(left);
    const int j = static_cast<int>(top);
    const glm::vec3 upper = glm::mix(texel(texture, i, j), texel(texture, i + 1, j), x - left);
    const glm::vec3 lower = glm::mix(texel(texture, i, j + 1), texel(texture, i + 1, j + 1), x - left);
    return glm::mix(upper, lower, y - top);
}

struct LitPoint {
    glm::vec3 place;
    glm::vec3 normal;  // facing the eye
    glm::vec3 to_eye;
    glm::vec3 diffuse;
};

glm::vec3 from_light(const Light& light, const compositor::Material& material, const LitPoint& point) {
    glm::vec3 to_light = -glm::vec3(light.towards);
    float strength = 1;
    if (light.kind != LightKind::kDirectional) {
        const glm::vec3 way = glm::vec3(light.location) - point.place;
        const float d = glm::length(way);
        if (d > static_cast<float>(light.radius)) return glm::vec3(0);
        to_light = way / d;
        strength = 1 / std::max(glm::dot(light.attenuation, glm::vec3(1, d, d * d)), 1.0F);
        if (light.kind == LightKind::kSpot) {
            const double angle = std::acos(std::clamp(glm::dot(-glm::dvec3(to_light), light.towards), -1.0, 1.0));
            if (angle > light.cut_off_rad) return glm::vec3(0);
            if (angle > light.beam_width_rad) {
                strength *=
                    static_cast<float>((light.cut_off_rad - angle) / (light.cut_off_rad - light.beam_width_rad));
            }
        }
    }
    const float facing = std::max(glm::dot(point.normal, to_light), 0.0F);
    glm::vec3 reflected = point.diffuse * facing;
    if (facing > 0) {
        const glm::vec3 half = glm::normalize(to_light + point.to_eye);
        reflected +=
            material.specular * std::pow(std::max(glm::dot(point.normal, half), 0.0F), material.shininess * 128);
    }
    return strength * (light.ambient * point.diffuse * material.ambient + light.colour * reflected);
}

}  // namespace

Result<std::shared_ptr<const TracedObject>> TracedObject::create(capture::Scene scene, double object_radius) {
    if (Status checked = capture::check_scene(scene); !checked) return checked.error();
    std::shared_ptr<TracedObject> object(new TracedObject(std::move(scene), object_radius));
    Result<capture::RayScene> rays = capture::RayScene::create(object->scene_);
    if (!rays) return rays.error();
    object->rays_.emplace(std::move(*rays));
    const glm::vec3 diagonal = object->rays_->upper() - object->rays_->lower();
    object->lights_.emplace(object->scene_, object->scene_.environment,
                            capture::LightSet::Extent{.radius = 0.5F * glm::length(diagonal)});
    object->models_ = capture::make_surface_models(object->scene_.materials);
    return std::shared_ptr<const TracedObject>(std::move(object));
}

// Geometry as one scene in world coordinates; material i is that of node i.
struct TruthScene::Room {
    compositor::Scene scene;
    capture::Scene meshes;
    std::optional<capture::RayScene> rays;

    [[nodiscard]] glm::vec3 shade(const capture::SurfacePoint& hit, const glm::vec3& direction) const;
};

glm::vec3 TruthScene::Room::shade(const capture::SurfacePoint& hit, const glm::vec3& direction) const {
    const compositor::GeometryNode& node = scene.geometry[static_cast<std::size_t>(hit.material)];
    const compositor::Material& material = node.material;
    LitPoint point{hit.position, hit.shading_normal, -direction, material.diffuse};
    if (material.texture) {
        const glm::vec3 colour = texture_at(*material.texture, hit.uv);
        point.diffuse = material.texture->modulates ? colour * material.diffuse : colour;
    }
    if (!material.lit) return point.diffuse;
    glm::vec3 sum = material.emissive;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const bool shines =
            scene.lights[i].everywhere || std::find(node.lights.begin(), node.lights.end(), i) != node.lights.end();
        if (shines) sum += from_light(scene.lights[i], material, point);
    }
    return sum;
}

Result<TruthScene> TruthScene::create(const compositor::Scene& scene, std::vector<TracedNode> nodes) {
    auto room = std::make_shared<Room>();
    room->scene = scene;
    RS_CHECK(!scene.fog && !scene.floor && !scene.navigation.headlight);
    for (const compositor::GeometryNode& node : scene.geometry) {
        RS_CHECK(node.mesh->topology == compositor::Topology::kTriangles && !node.mesh->has_colours);
        RS_CHECK(node.material.opacity >= 1);
        capture::Mesh mesh;
        const glm::dmat3 turned = glm::transpose(glm::inverse(glm::dmat3(node.world_from_node)));
        for (const compositor::MeshVertex& vertex : node.mesh->vertices) {
            mesh.positions.emplace_back(node.world_from_node * glm::dvec4(vertex.position, 1));
            mesh.normals.emplace_back(glm::normalize(turned * glm::dvec3(vertex.normal)));
            mesh.uvs.emplace_back(node.material.texture_transform * glm::vec3(vertex.texture, 1));
        }
        for (std::size_t i = 0; i + 2 < node.mesh->indices.size(); i += 3) {
            mesh.triangles.emplace_back(node.mesh->indices[i], node.mesh->indices[i + 1], node.mesh->indices[i + 2]);
        }
        mesh.material = static_cast<int>(room->meshes.materials.size());
        room->meshes.materials.emplace_back();
        room->meshes.meshes.push_back(std::move(mesh));
    }
    if (Status checked = capture::check_scene(room->meshes); !checked) return checked.error();
    Result<capture::RayScene> rays = capture::RayScene::create(room->meshes);
    if (!rays) return rays.error();
    room->rays.emplace(std::move(*rays));
    return TruthScene(std::move(room), std::move(nodes));
}

TruthImage TruthScene::render(const Camera& camera, const TruthOptions& options) const {
    TruthImage truth{Image<Rgba8>(camera.width, camera.height), Image<float>(camera.width, camera.height),
                     Image<float>(camera.width, camera.height)};
    std::vector<capture::PathTracer> tracers;
    std::vector<compositor::Similarity> from_world;
    for (const TracedNode& node : nodes_) {
        const TracedObject& object = *node.object;
        tracers.emplace_back(capture::LightTransport(object.scene(), object.rays(), object.lights(), object.models()),
                             kMaxBounces);
        from_world.push_back(node.world_from_object.inverse());
    }

    const auto render_pixel = [&](int x, int y) {
        const std::uint64_t key =
            capture::mix_bits(static_cast<std::uint64_t>(y) << 32 | static_cast<std::uint64_t>(x));
        glm::vec3 sum(0);
        std::vector<glm::vec3> sums(nodes_.size(), glm::vec3(0));
        std::vector<int> hits(nodes_.size(), 0);
        int shown = 0;
        int unhidden = 0;
        for (int s = 0; s < options.samples; ++s) {
            capture::Sampler sampler(key, static_cast<std::uint32_t>(s));
            const glm::dvec2 offset(sampler.next_2d());
            const glm::dvec3 ray = glm::normalize(camera.ray(x + offset.x, y + offset.y));
            capture::SurfacePoint hit;
            double nearest = std::numeric_limits<double>::infinity();
            const bool met = room_->rays->intersect(glm::vec3(camera.centre()), glm::vec3(ray), 0.0F, hit);
            if (met) nearest = static_cast<double>(hit.distance);
            std::optional<std::size_t> seen;
            bool any = false;
            for (std::size_t i = 0; i < nodes_.size(); ++i) {
                const double radius = nodes_[i].object->object_radius();
                const glm::vec3 origin(from_world[i].point(camera.centre()) * radius);
                capture::SurfacePoint on_object;
                const glm::vec3 direction(from_world[i].direction(ray));
                if (!nodes_[i].object->rays().intersect(origin, direction, 0.0F, on_object)) continue;
                any = true;
                const double distance =
                    static_cast<double>(on_object.distance) / radius * nodes_[i].world_from_object.scale;
                if (distance >= nearest) continue;
                nearest = distance;
                seen = i;
            }
            unhidden += any;
            if (!seen) {
                sum += met ? room_->shade(hit, glm::vec3(ray))
                           : compositor::background_colour(room_->scene.background, ray);
                continue;
            }
            ++shown;
            ++hits[*seen];
            const glm::vec3 origin(from_world[*seen].point(camera.centre()) * nodes_[*seen].object->object_radius());
            for (int path = 0; path < options.paths_per_sample; ++path) {
                capture::Sampler further(capture::mix_bits(key + 1 + *seen),
                                         static_cast<std::uint32_t>(s * options.paths_per_sample + path));
                glm::vec3 radiance(0);
                tracers[*seen].trace(origin, glm::vec3(from_world[*seen].direction(ray)), 0.0F, further, radiance);
                sums[*seen] += radiance / static_cast<float>(options.paths_per_sample);
            }
        }
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (hits[i] == 0) continue;
            const auto count = static_cast<float>(hits[i]);
            sum += glm::min(sums[i] / count, glm::vec3(1)) * count;
        }
        const auto samples = static_cast<float>(options.samples);
        sum /= samples;
        truth.image(x, y) = {srgb8_from_linear(sum.r), srgb8_from_linear(sum.g), srgb8_from_linear(sum.b), 255};
        truth.objects(x, y) = static_cast<float>(shown) / samples;
        truth.unhidden(x, y) = static_cast<float>(unhidden) / samples;
    };
    for_each_index(camera.height, 0, [&](std::int64_t y) {
        for (int x = 0; x < camera.width; ++x) render_pixel(x, static_cast<int>(y));
    });
    return truth;
}

}  // namespace rs::test
