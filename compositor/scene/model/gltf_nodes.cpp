#include "compositor/scene/model/gltf_nodes.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_reference.hpp"
#include "rayspace/models/gltf_extensions.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace rs::compositor::model {
namespace {

using nlohmann::json;

constexpr int kMaxHeight = 500;
constexpr std::size_t kMaxNodes = 100'000;
constexpr double kMaxNodePosition = 1e9;

class NodeWalk {
public:
    NodeWalk(const json& top, const std::filesystem::path& path, Scene& scene)
        : top_(top), path_(path), scene_(scene) {}

    void walk_scene() {
        const json& scenes = list(top_, "scenes");
        const json& chosen = top_.contains("scene") ? top_["scene"] : json(0U);
        if (!chosen.is_number_unsigned()) return;
        const std::size_t index = chosen;
        if (index >= scenes.size()) return;
        for (const json& root : list(scenes[index], "nodes")) walk(root, glm::dmat4(1.0), {}, 0);
    }

private:
    [[nodiscard]] static const json& list(const json& parent, const char* key) {
        static const json kNone = json::array();
        if (!parent.is_object() || !parent.contains(key) || !parent[key].is_array()) return kNone;
        return parent[key];
    }

    [[nodiscard]] static double number(const json& parent, const char* key, double otherwise) {
        if (!parent.is_object() || !parent.contains(key) || !parent[key].is_number()) return otherwise;
        return std::clamp(parent[key].get<double>(), -kMaxNodePosition, kMaxNodePosition);
    }

    template <std::size_t count>
    [[nodiscard]] static std::array<double, count> numbers(const json& parent, const char* key,
                                                           std::array<double, count> values) {
        const json& given = list(parent, key);
        for (std::size_t i = 0; given.size() == count && i < count; ++i) {
            if (given[i].is_number())
                values[i] = std::clamp(given[i].get<double>(), -kMaxNodePosition, kMaxNodePosition);
        }
        return values;
    }

    [[nodiscard]] MalformedJson error(const std::string& place, const std::string& what) const {
        return {path_.string() + ": " + place + ": " + what};
    }

    // Translation, rotation and uniform scale of a node; for a matrix the nearest one. `even` is false if it differs.
    static NodeTransform transform_of(const json& node, glm::dmat4& matrix, bool& even) {
        const auto t = numbers<3>(node, "translation", {0, 0, 0});
        const auto r = numbers<4>(node, "rotation", {0, 0, 0, 1});
        const auto s = numbers<3>(node, "scale", {1, 1, 1});
        const glm::dquat turn = glm::normalize(glm::dquat(r[3], r[0], r[1], r[2]));
        matrix = glm::mat4_cast(turn);
        for (int axis = 0; axis < 3; ++axis) matrix[axis] *= s[static_cast<std::size_t>(axis)];
        matrix[3] = glm::dvec4(t[0], t[1], t[2], 1);
        if (!list(node, "matrix").empty()) {
            constexpr std::array<double, 16> kOne = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
            matrix = glm::make_mat4(numbers<16>(node, "matrix", kOne).data());
        }
        const glm::dmat3 linear(matrix);
        const double scale = std::cbrt(std::abs(glm::determinant(linear)));
        NodeTransform result;
        result.translation = glm::dvec3(matrix[3]);
        if (!(scale > 1e-9)) {
            result.scale = 1e-9;
            even = false;
            return result;
        }
        const glm::dmat3 orthogonal = linear / scale;
        const glm::dmat3 defect = glm::transpose(orthogonal) * orthogonal - glm::dmat3(1.0);
        for (int i = 0; i < 9; ++i) even = even && std::abs(defect[i / 3][i % 3]) < 1e-3;
        result = NodeTransform::of(orthogonal, scale);
        result.translation = glm::dvec3(matrix[3]);
        return result;
    }

    void walk(const json& index, const glm::dmat4& world_from_parent, TransformChain chain, int height) {
        const json& nodes = list(top_, "nodes");
        if (!index.is_number_unsigned() || index.get<std::size_t>() >= nodes.size()) {
            throw error("nodes", "a child index does not exist; export the file again");
        }
        const std::size_t i = index.get<std::size_t>();
        const json& node = nodes[i];
        if (height > kMaxHeight || ++visited_ > kMaxNodes) {
            throw error("nodes[" + std::to_string(i) + "]",
                        "its nodes are nested too deep or in a cycle; flatten them");
        }
        const std::optional<std::size_t> outer_room = room_;
        bool even = true;
        glm::dmat4 matrix(1.0);
        chain.push_back(transform_of(node, matrix, even));
        const glm::dmat4 world_from_node = world_from_parent * matrix;
        const bool was_even = std::exchange(even_, even_ && even);
        if (node.is_object()) {
            if (node.contains("extras")) read_extras(node, i, chain);
            if (node.contains("extras")) begin_room(node, i, world_from_node);
            if (node.contains("camera")) read_camera(node, world_from_node);
            if (node.contains("extensions")) read_light(node, world_from_node);
        }
        for (const json& child : list(node, "children")) walk(child, world_from_node, chain, height + 1);
        room_ = outer_room;
        even_ = was_even;
    }

    void read_extras(const json& node, std::size_t i, TransformChain chain) {
        const json& extras = node["extras"];
        if (!extras.is_object() || !extras.contains("RaySpace")) return;
        const std::string place = "nodes[" + std::to_string(i) + "].extras.RaySpace";
        JsonObject fields(JsonValue(extras["RaySpace"], path_.string(), place));
        RaySpaceNode object;
        const auto file = resolve_reference(fields.take("url").text(), path_.parent_path());
        if (!file) throw error(place, "url is not a local file");
        object.file = *file;
        object.room = room_;
        NodeTransform size;
        fields.read("size", size.scale, 1e-6, 1e6);
        fields.read("standing", object.standing);
        if (fields.has("description")) object.description = fields.take("description").text();
        if (object.description.empty() && node.contains("name") && node["name"].is_string()) {
            object.description = node["name"].get<std::string>();
        }
        fields.expect_no_unknown_keys();
        chain.push_back(size);
        object.chain = std::move(chain);
        if (!even_) {
            scene_.warnings.push_back(
                printable(path_.string() + ": " + place + ": is stretched more along one axis; drawn without"));
        }
        scene_.objects.push_back(std::move(object));
    }

    // Assigns the content of the node to the room.
    void begin_room(const json& node, std::size_t i, const glm::dmat4& world_from_node) {
        const json& extras = node["extras"];
        if (!extras.is_object() || !extras.contains("RaySpaceRoom")) return;
        const std::string place = "nodes[" + std::to_string(i) + "].extras.RaySpaceRoom";
        JsonObject fields(JsonValue(extras["RaySpaceRoom"], path_.string(), place));
        const glm::dvec3 centre = fields.take("centre").triple(-kMaxNodePosition, kMaxNodePosition);
        const glm::dvec3 half = fields.take("size").triple(0, kMaxNodePosition) * 0.5;
        Room room;
        if (fields.has("description")) room.description = fields.take("description").text();
        fields.expect_no_unknown_keys();
        room.box = BoundingBox{centre - half, centre + half}.moved(world_from_node);
        room_ = scene_.rooms.size();
        scene_.rooms.push_back(std::move(room));
    }

    void read_camera(const json& node, const glm::dmat4& world_from_node) {
        const json& cameras = list(top_, "cameras");
        const json& index = node["camera"];
        if (!index.is_number_unsigned() || index.get<std::size_t>() >= cameras.size()) return;
        const json& camera = cameras[index.get<std::size_t>()];
        if (!camera.is_object() || !camera.contains("perspective")) {
            scene_.warnings.push_back(printable(path_.string() + ": camera " +
                                                std::to_string(index.get<std::size_t>()) +
                                                " is not a perspective one; left out"));
            return;
        }
        const json& perspective = camera["perspective"];
        Viewpoint viewpoint;
        if (camera.contains("name") && camera["name"].is_string()) viewpoint.description = camera["name"];
        const double fov_y = std::clamp(number(perspective, "yfov", 0.8), radians(1), radians(170));
        const double aspect = number(perspective, "aspectRatio", 1);
        viewpoint.field_of_view_rad = aspect >= 1 ? fov_y : 2 * std::atan(std::tan(fov_y / 2) * std::max(aspect, 0.01));
        const glm::dvec3 back = glm::dvec3(world_from_node[2]);
        const glm::dvec3 up = glm::dvec3(world_from_node[1]);
        const glm::dvec3 right = glm::cross(up, back);
        if (!(glm::length(right) > 0)) return;
        viewpoint.world_from_camera[0] = glm::dvec4(glm::normalize(right), 0);
        viewpoint.world_from_camera[1] = glm::dvec4(glm::normalize(glm::cross(back, right)), 0);
        viewpoint.world_from_camera[2] = glm::dvec4(glm::normalize(back), 0);
        viewpoint.world_from_camera[3] = world_from_node[3];
        scene_.viewpoints.push_back(std::move(viewpoint));
    }

    void read_light(const json& node, const glm::dmat4& world_from_node) {
        constexpr const char* kExtension = "KHR_lights_punctual";
        const auto within = [&](const json& parent) -> const json* {
            if (!parent.contains("extensions") || !parent["extensions"].contains(kExtension)) return nullptr;
            return &parent["extensions"][kExtension];
        };
        const json* named = within(node);
        const json* all = within(top_);
        if (named == nullptr || all == nullptr) return;
        const double index = number(*named, "light", -1);
        const json& lights = list(*all, "lights");
        if (index < 0 || index >= static_cast<double>(lights.size())) return;
        const json& given = lights[static_cast<std::size_t>(index)];
        const std::string type = given.is_object() ? given.value("type", "") : "";
        Light light;
        light.kind = type == "point" ? LightKind::kPoint : type == "spot" ? LightKind::kSpot : LightKind::kDirectional;
        // A white diffuse surface reflects 1 / pi of the incident light in every direction.
        const auto colour = numbers<3>(given, "color", {1, 1, 1});
        light.colour = glm::vec3(glm::dvec3(colour[0], colour[1], colour[2]) * number(given, "intensity", 1) / kPi);
        light.location = glm::dvec3(world_from_node[3]);
        const glm::dvec3 towards = -glm::dvec3(world_from_node[2]);
        if (glm::length(towards) > 0) light.towards = glm::normalize(towards);
        light.attenuation = {0, 0, 1};
        light.radius = number(given, "range", kMaxNodePosition);
        if (light.kind == LightKind::kSpot && given.contains("spot")) {
            light.beam_width_rad = number(given["spot"], "innerConeAngle", 0);
            light.cut_off_rad = std::clamp(number(given["spot"], "outerConeAngle", kPi / 4), 0.0, kPi / 2);
        }
        if (given.contains("extras") && given["extras"].is_object() && given["extras"].contains("RaySpaceLight")) {
            const json& extras = given["extras"]["RaySpaceLight"];
            const auto ambient = numbers<3>(extras, "ambient", {0, 0, 0});
            light.ambient = glm::vec3(ambient[0], ambient[1], ambient[2]);
            light.least_attenuation = static_cast<float>(std::max(number(extras, "leastAttenuation", 1), 1e-6));
        }
        light.name = name_of_light(given).value_or(name_of_light(node).value_or(""));
        scene_.lights.push_back(light);
    }

    // Light lists cannot hold zero characters.
    static std::optional<std::string> name_of_light(const json& named) {
        if (!named.contains("name") || !named["name"].is_string()) return std::nullopt;
        const auto name = named["name"].get<std::string>();
        return name.substr(0, name.find('\0'));
    }

    const json& top_;
    const std::filesystem::path& path_;
    Scene& scene_;
    std::size_t visited_ = 0;
    bool even_ = true;
    std::optional<std::size_t> room_;
};

}  // namespace

Result<GltfContents> read_gltf_nodes(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                     Scene& scene) {
    const std::string_view view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    RS_ASSIGN_OR_RETURN(const std::string text, gltf_json(view, path.string()));
    try {
        const json top = parse_json_text(text, path.string());
        NodeWalk(top, path, scene).walk_scene();
        return GltfContents{top.is_object() && top.contains("meshes") && !top["meshes"].empty()};
    } catch (const MalformedJson& malformed) {
        return Error{malformed.message};
    } catch (const json::exception&) {
        return Error{path.string() + ": a value of its JSON is of another type than in glTF 2.0; export it again"};
    }
}

}  // namespace rs::compositor::model
