#include "compositor/scene/export/gltf_file.hpp"

#include "compositor/scene/export/gltf_lights.hpp"
#include "compositor/scene/export/gltf_materials.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace rs::compositor {
namespace {

using nlohmann::json;

constexpr double kCameraNear = 0.02;  // scene units
constexpr int kFloorSides = 96;

json triple(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

json colours_json(const std::vector<glm::vec3>& colours) {
    json list = json::array();
    for (const glm::vec3& c : colours) list.push_back({c.r, c.g, c.b});
    return list;
}

void set_matrix(json& node, const glm::dmat4& matrix) {
    if (matrix == glm::dmat4(1.0)) return;
    json& numbers = node["matrix"];
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) numbers.push_back(matrix[column][row]);
    }
}

// glTF requires matrices that are products of translation, rotation and scale.
bool is_sheared(const glm::dmat4& matrix) {
    const glm::dvec3 x = glm::normalize(glm::dvec3(matrix[0]));
    const glm::dvec3 y = glm::normalize(glm::dvec3(matrix[1]));
    const glm::dvec3 z = glm::normalize(glm::dvec3(matrix[2]));
    constexpr double kTolerance = 1e-5;
    return std::abs(glm::dot(x, y)) > kTolerance || std::abs(glm::dot(y, z)) > kTolerance ||
           std::abs(glm::dot(z, x)) > kTolerance;
}

std::shared_ptr<const Mesh> transformed(const Mesh& mesh, const glm::dmat4& matrix) {
    auto moved = std::make_shared<Mesh>(mesh);
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(matrix)));
    for (MeshVertex& vertex : moved->vertices) {
        vertex.position = glm::vec3(matrix * glm::dvec4(vertex.position, 1));
        const glm::dvec3 n = normals * glm::dvec3(vertex.normal);
        if (glm::length(n) > 0) vertex.normal = glm::vec3(glm::normalize(n));
    }
    if (glm::determinant(glm::dmat3(matrix)) < 0 && moved->topology == Topology::kTriangles) {
        for (std::size_t i = 0; i + 2 < moved->indices.size(); i += 3)
            std::swap(moved->indices[i], moved->indices[i + 1]);
    }
    return moved;
}

// The floor as a disc whose texture repeats two by two squares.
GeometryNode floor_node(const Floor& floor) {
    auto mesh = std::make_shared<Mesh>();
    mesh->two_sided = false;
    const auto vertex = [&](double x, double z) {
        return MeshVertex{
            {float(x), 0, float(z)}, {0, 1, 0}, {float(x / (2 * floor.square)), float(-z / (2 * floor.square))}};
    };
    mesh->vertices.push_back(vertex(0, 0));
    for (int i = 0; i < kFloorSides; ++i) {
        const double angle = 2 * kPi * i / kFloorSides;
        mesh->vertices.push_back(vertex(floor.radius * std::sin(angle), floor.radius * std::cos(angle)));
        const auto at = std::uint32_t(i);
        mesh->indices.insert(mesh->indices.end(), {0, 1 + at, 1 + (at + 1) % kFloorSides});
    }
    // Squares of several pixels: texel filters then blur only their edges.
    constexpr int kSquare_px = 64;
    auto texture = std::make_shared<SceneTexture>();
    texture->image = Image<Rgba8>(2 * kSquare_px, 2 * kSquare_px);
    for (int y = 0; y < 2 * kSquare_px; ++y) {
        for (int x = 0; x < 2 * kSquare_px; ++x) {
            const bool first = (x < kSquare_px) == (y >= kSquare_px);
            const glm::vec3& c = first ? floor.colour_a : floor.colour_b;
            texture->image(x, y) = {srgb8_from_linear(c.r), srgb8_from_linear(c.g), srgb8_from_linear(c.b), 255};
        }
    }
    GeometryNode node;
    node.mesh = std::move(mesh);
    node.material.ambient = 1;
    node.material.texture = std::move(texture);
    node.world_from_node[3].y = floor.height;
    return node;
}

class GltfExport {
public:
    GltfExport(const Scene& scene, const std::function<std::string(const std::filesystem::path&)>& url_of)
        : scene_(scene), url_of_(url_of), materials_(document_) {}

    Result<GltfFile> run() {
        for (const GeometryNode& node : scene_.geometry) RS_TRY(add_geometry(node, "surface"));
        if (scene_.floor) {
            RS_TRY(add_geometry(floor_node(*scene_.floor), "floor"));
            warn("floor: its rim does not fade into the background");
        }
        add_objects();
        add_viewpoints();
        add_lights();
        warn_about_the_rest();
        json scene = {{"nodes", roots_}, {"extras", {{"RaySpaceScene", surroundings()}}}};
        document_.append("scenes", std::move(scene));
        document_.json["scene"] = 0;
        GltfFile file{document_.bytes(), std::move(warnings_)};
        if (file.bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
            return Error{"the scene has more than 4 GiB as GLB; make its textures smaller"};
        }
        return file;
    }

private:
    void warn(std::string text) {
        if (std::ranges::find(warnings_, text) == warnings_.end()) warnings_.push_back(std::move(text));
    }

    void add_root(json node) { roots_.push_back(document_.append("nodes", std::move(node))); }

    Status add_geometry(const GeometryNode& node, const char* name) {
        if (node.mesh->indices.empty()) return {};
        const bool sheared = is_sheared(node.world_from_node);
        RS_ASSIGN_OR_RETURN(const std::size_t mesh,
                            sheared ? add_mesh(*transformed(*node.mesh, node.world_from_node), node.material)
                                    : shared_mesh(node.mesh, node.material));
        json made = {{"mesh", mesh}, {"name", name}};
        if (!sheared) set_matrix(made, node.world_from_node);
        if (!node.lights.empty()) made["extras"]["RaySpaceLights"] = node.lights;
        add_root(std::move(made));
        return {};
    }

    // Meshes are shared by nodes with the same material.
    Result<std::size_t> shared_mesh(const std::shared_ptr<const Mesh>& mesh, const Material& material) {
        auto& known = meshes_[mesh.get()];
        for (const auto& [of_material, index] : known) {
            if (of_material == material) return index;
        }
        RS_ASSIGN_OR_RETURN(const std::size_t index, add_mesh(*mesh, material));
        known.emplace_back(material, index);
        return index;
    }

    Result<std::size_t> add_mesh(const Mesh& mesh, const Material& material) {
        const bool triangles = mesh.topology == Topology::kTriangles;
        Material used = material;
        used.lit = material.lit && triangles;
        RS_ASSIGN_OR_RETURN(const std::size_t index,
                            materials_.add(used, mesh.two_sided && triangles, mesh.has_colours));
        std::vector<glm::vec3> positions;
        std::vector<glm::vec3> normals;
        std::vector<glm::vec2> places;
        std::vector<glm::vec3> colours;
        for (const MeshVertex& vertex : mesh.vertices) {
            positions.push_back(vertex.position);
            normals.push_back(vertex.normal == glm::vec3(0) ? glm::vec3(0, 1, 0) : vertex.normal);
            const glm::vec3 place = material.texture_transform * glm::vec3(vertex.texture, 1);
            places.emplace_back(place.x, 1 - place.y);  // rows begin at the top
            colours.emplace_back(vertex.colour);
        }
        json attributes = {{"POSITION", document_.add_positions(positions)}};
        if (triangles && used.lit) attributes["NORMAL"] = document_.add_vectors(normals);
        if (used.texture || used.normals || used.emission_texture) {
            attributes["TEXCOORD_0"] = document_.add_texture_places(places);
        }
        if (mesh.has_colours) attributes["COLOR_0"] = document_.add_vectors(colours);
        json primitive = {{"attributes", std::move(attributes)},
                          {"indices", document_.add_indices(mesh.indices)},
                          {"material", index}};
        constexpr int kPointsMode = 0;
        constexpr int kLinesMode = 1;
        if (!triangles) primitive["mode"] = mesh.topology == Topology::kLines ? kLinesMode : kPointsMode;
        return document_.append("meshes", {{"primitives", json::array({std::move(primitive)})}});
    }

    // Objects are children of the node of their room.
    void add_objects() {
        std::vector<json> in_room(scene_.rooms.size(), json::array());
        for (const RaySpaceNode& object : scene_.objects) {
            json extras = {{"url", url_of_(object.file)}, {"standing", object.standing}};
            if (!object.description.empty()) extras["description"] = object.description;
            const std::string name = object.description.empty() ? object.file.stem().string() : object.description;
            json node = {{"name", name}, {"extras", {{"RaySpace", std::move(extras)}}}};
            set_matrix(node, world_from_node(object.chain).matrix());
            if (object.room) {
                in_room[*object.room].push_back(document_.append("nodes", std::move(node)));
            } else {
                add_root(std::move(node));
            }
        }
        for (std::size_t i = 0; i < scene_.rooms.size(); ++i) {
            const Room& room = scene_.rooms[i];
            const glm::dvec3 size = room.box.empty() ? glm::dvec3(0) : room.box.highest - room.box.lowest;
            const glm::dvec3 centre = room.box.empty() ? glm::dvec3(0) : room.box.middle();
            json extras = {{"centre", triple(centre)}, {"size", triple(size)}, {"description", room.description}};
            json node = {{"name", room.description}, {"extras", {{"RaySpaceRoom", std::move(extras)}}}};
            if (!in_room[i].empty()) node["children"] = std::move(in_room[i]);
            add_root(std::move(node));
        }
    }

    // Assimp requires different names of lights and of cameras, which are those of their nodes.
    std::string unique_name(const std::string& name) {
        const std::string base = name.empty() ? "viewpoint" : name;
        std::string made = base;
        for (int n = 2; !names_.insert(made).second; ++n) made = base + " " + std::to_string(n);
        return made;
    }

    void add_viewpoints() {
        for (const Viewpoint& viewpoint : scene_.viewpoints) {
            json camera = {
                {"type", "perspective"},
                {"perspective", {{"yfov", viewpoint.field_of_view_rad}, {"aspectRatio", 1}, {"znear", kCameraNear}}}};
            if (!viewpoint.description.empty()) camera["name"] = viewpoint.description;
            json node = {{"camera", document_.append("cameras", std::move(camera))},
                         {"name", unique_name(viewpoint.description)}};
            set_matrix(node, viewpoint.world_from_camera);
            add_root(std::move(node));
        }
    }

    void add_lights() {
        const double reach = scene_.geometry.empty() ? 1 : reach_of(bounds_of(scene_));
        json lights = json::array();
        for (const Light& light : scene_.lights) {
            GltfLight converted = gltf_light(light, reach);
            for (std::string& warning : converted.warnings) warn(std::move(warning));
            converted.light["name"] = unique_name(converted.light.value("name", "light"));
            json node = {{"name", converted.light["name"]},
                         {"extensions", {{kLightsExtension, {{"light", lights.size()}}}}}};
            set_matrix(node, converted.world_from_light);
            lights.push_back(std::move(converted.light));
            add_root(std::move(node));
        }
        if (lights.empty()) return;
        document_.use_extension(kLightsExtension);
        document_.json["extensions"][kLightsExtension]["lights"] = std::move(lights);
    }

    static double reach_of(const BoundingBox& box) { return box.empty() ? 1 : glm::length(box.highest - box.lowest); }

    json surroundings() {
        const Navigation& navigation = scene_.navigation;
        json made = {{"navigation",
                      {{"types", navigation.types},
                       {"speed", navigation.speed},
                       {"headlight", navigation.headlight},
                       {"eyeHeight", navigation.avatar.y}}}};
        const Background& background = scene_.background;
        made["background"] = {{"sky", colours_json(background.sky)},
                              {"skyAngles", background.sky_angles_rad},
                              {"ground", colours_json(background.ground)},
                              {"groundAngles", background.ground_angles_rad}};
        if (scene_.fog) {
            made["fog"] = {{"kind", scene_.fog->kind == FogKind::kLinear ? "linear" : "exponential"},
                           {"colour", triple(scene_.fog->colour)},
                           {"visibility", scene_.fog->visibility}};
        }
        return made;
    }

    void warn_about_the_rest() {
        const Background& background = scene_.background;
        if (background.sky != Background{}.sky || !background.ground.empty()) {
            warn("background: only pages of rs-view show it; glTF has none");
        }
        if (std::ranges::any_of(background.images, [](const auto& image) { return image != nullptr; })) {
            warn("background: its images are omitted; glTF has none");
        }
        if (scene_.fog) warn("fog: only pages of rs-view show it; glTF has none");
        if (scene_.navigation.headlight) warn("headlight: only pages of rs-view light it; glTF has none");
        if (scene_.environment) warn("environment light: is omitted; glTF has none");
        if (scene_.camera) warn("camera animation: is omitted; render a video for it");
        if (std::ranges::any_of(scene_.lights, [](const Light& light) { return !light.everywhere; })) {
            warn("lights: some light only a part of the scene; only pages of rs-view limit them, others light all");
        }
        const auto is_dim = [](const GeometryNode& node) {
            return node.material.lit && !node.material.surface && node.material.ambient < 0.999F;
        };
        const bool has_ambient =
            std::ranges::any_of(scene_.lights, [](const Light& l) { return l.ambient != glm::vec3(0); });
        if (has_ambient && std::ranges::any_of(scene_.geometry, is_dim)) {
            warn("materials: ambientIntensity is taken as 1");
        }
    }

    const Scene& scene_;
    const std::function<std::string(const std::filesystem::path&)>& url_of_;
    GlbDocument document_;
    GltfMaterials materials_;
    json roots_ = json::array();
    std::map<const Mesh*, std::vector<std::pair<Material, std::size_t>>> meshes_;
    std::set<std::string> names_;
    std::vector<std::string> warnings_;
};

}  // namespace

Result<GltfFile> export_gltf(const Scene& scene,
                             const std::function<std::string(const std::filesystem::path&)>& url_of) {
    return GltfExport(scene, url_of).run();
}

std::string url_of_path(const std::filesystem::path& relative) {
    std::string url;
    for (const char c : relative.generic_string()) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
                           c == '_' || c == '.' || c == '/';
        if (plain) {
            url += c;
            continue;
        }
        constexpr const char* kDigits = "0123456789ABCDEF";
        url += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
    return url;
}

}  // namespace rs::compositor
