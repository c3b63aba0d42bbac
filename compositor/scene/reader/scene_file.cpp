#include "compositor/scene/reader/scene_file.hpp"

#include "compositor/scene/model/model_file.hpp"
#include "compositor/scene/reader/vrml_file.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

constexpr std::uint64_t kMaxScene_bytes = std::uint64_t{64} << 20;
constexpr std::size_t kMaxNodes = 4096;
constexpr double kMaxCoordinate = 1e6;  // coordinates and lengths
constexpr double kMinPositive = 1e-6;   // lower limit of positive values
constexpr double kMaxRadiance = 100;

glm::dvec3 take_position(JsonObject& object, const char* key) {
    return object.take(key).triple(-kMaxCoordinate, kMaxCoordinate);
}

glm::vec3 colour(const JsonValue& value) {
    const glm::vec3 srgb(value.triple(0, 1));
    return {linear_from_srgb(srgb.r), linear_from_srgb(srgb.g), linear_from_srgb(srgb.b)};
}

NodeTransform take_transform(JsonObject& node) {
    NodeTransform transform;
    if (node.has("translate")) transform.translation = take_position(node, "translate");
    node.read("scale", transform.scale, kMinPositive, kMaxCoordinate);
    if (node.has("rotate")) {
        JsonObject rotate(node.take("rotate"));
        if (rotate.has("axis")) transform.axis = rotate.take("axis").direction();
        transform.angle_rad = radians(rotate.take("degrees").number(-36000, 36000));
        rotate.expect_no_unknown_keys();
    }
    return transform;
}

// Traverses the node tree and accumulates the chain of transforms.
class NodeReader {
public:
    NodeReader(Scene& scene, std::filesystem::path folder) : scene_(scene), folder_(std::move(folder)) {}

    void read_list(const JsonValue& list) {
        const std::size_t count = list.list_size(0, kMaxNodes);
        for (std::size_t i = 0; i < count; ++i) read_node(JsonObject(list.item(i)));
    }

private:
    void read_node(JsonObject node) {
        if (++nodes_ > kMaxNodes) throw node.wrong("too many nodes; a scene may have " + std::to_string(kMaxNodes));
        const bool is_object = node.has("object");
        const bool is_box = node.has("box");
        const bool is_group = node.has("group");
        const bool is_room = node.has("room");
        if (is_object + is_box + is_group + is_room != 1) {
            throw node.wrong("must have exactly one of the keys object, box, group and room");
        }
        chain_.push_back(take_transform(node));
        if (is_object) read_object_node(node);
        if (is_box) read_box(node);
        if (is_group) read_list(node.take("group"));
        if (is_room) read_room(node);
        chain_.pop_back();
        node.expect_no_unknown_keys();
    }

    void read_object_node(JsonObject& node) {
        RaySpaceNode object;
        object.file = folder_ / node.take("object").text();
        object.chain = chain_;
        object.room = room_;
        node.read("standing", object.standing);
        scene_.objects.push_back(std::move(object));
    }

    void read_room(JsonObject& node) {
        const std::size_t room = scene_.rooms.size();
        const std::size_t geometry = scene_.geometry.size();
        const std::size_t objects = scene_.objects.size();
        scene_.rooms.push_back({node.has("description") ? node.take("description").text() : "", {}});
        const std::optional<std::size_t> outer = std::exchange(room_, room);
        read_list(node.take("room"));
        room_ = outer;
        if (!node.has("bounds")) {
            scene_.rooms[room].box = bounds_from(scene_, geometry, objects);
            return;
        }
        JsonObject bounds(node.take("bounds"));
        const glm::dvec3 centre = take_position(bounds, "centre");
        const glm::dvec3 half = bounds.take("size").triple(kMinPositive, kMaxCoordinate) * 0.5;
        bounds.expect_no_unknown_keys();
        scene_.rooms[room].box = BoundingBox{centre - half, centre + half}.moved(world_from_node(chain_).matrix());
    }

    void read_box(JsonObject& node) {
        GeometryNode box;
        box.mesh = std::make_shared<const Mesh>(box_mesh(node.take("box").triple(kMinPositive, kMaxCoordinate)));
        box.material.diffuse = node.has("colour") ? colour(node.take("colour")) : glm::vec3(0.5F);
        box.material.ambient = 1;
        box.world_from_node = world_from_node(chain_).matrix();
        scene_.geometry.push_back(std::move(box));
    }

    Scene& scene_;
    std::filesystem::path folder_;
    TransformChain chain_;
    std::optional<std::size_t> room_;
    std::size_t nodes_ = 0;
};

std::string lower_case(std::string text) {
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

// Formats of models that have no reader.
struct OtherFormat {
    std::string_view extension;
    const char* name;
};
constexpr OtherFormat kOtherFormats[] = {
    {".stl", "an STL model"},     {".dae", "a COLLADA model"}, {".3ds", "a 3D Studio model"}, {".fbx", "an FBX model"},
    {".blend", "a Blender file"}, {".max", "a 3ds Max file"},  {".lwo", "a LightWave model"}, {".off", "an OFF model"},
    {".3mf", "a 3MF model"},      {".usd", "a USD scene"},     {".usda", "a USD scene"},      {".usdc", "a USD scene"},
    {".usdz", "a USD scene"}};

// Null if the file name has another extension.
const OtherFormat* other_format(std::string_view lower_case_name) {
    const auto* const found = std::ranges::find_if(
        kOtherFormats, [&](const OtherFormat& format) { return lower_case_name.ends_with(format.extension); });
    return found == std::ranges::end(kOtherFormats) ? nullptr : found;
}

Floor read_floor(JsonObject object) {
    Floor floor;
    object.read("height", floor.height, -kMaxCoordinate, kMaxCoordinate);
    object.read("radius", floor.radius, kMinPositive, kMaxCoordinate);
    object.read("square", floor.square, kMinPositive, kMaxCoordinate);
    if (object.has("colours")) {
        const JsonValue colours = object.take("colours");
        colours.list_size(2, 2);
        floor.colour_a = colour(colours.item(0));
        floor.colour_b = colour(colours.item(1));
    }
    object.expect_no_unknown_keys();
    return floor;
}

// Directional light with the scene's ambient light.
void read_lights(JsonObject object, Light& light) {
    if (object.has("towards")) light.towards = object.take("towards").direction();
    if (object.has("directional")) light.colour = glm::vec3(object.take("directional").triple(0, kMaxRadiance));
    if (object.has("ambient")) light.ambient = glm::vec3(object.take("ambient").triple(0, kMaxRadiance));
    object.expect_no_unknown_keys();
}

CameraPose take_pose(JsonObject& object) {
    const CameraPose pose{take_position(object, "eye"), take_position(object, "at")};
    if (glm::distance(pose.eye, pose.at) < kMinPositive) throw object.wrong("eye and at are the same point; move one");
    return pose;
}

CameraPath read_camera(JsonObject object) {
    CameraPath path;
    if (object.has("fov_degrees")) path.fov_x_rad = radians(object.take("fov_degrees").number(1, 150));
    if (object.has("path")) {
        const JsonValue keys = object.take("path");
        const std::size_t count = keys.list_size(1, 10000);
        for (std::size_t i = 0; i < count; ++i) {
            JsonObject key(keys.item(i));
            path.keys.push_back(take_pose(key));
            key.expect_no_unknown_keys();
        }
        path.frames = object.take("frames").whole_number(1, 100000);
        object.read("closed", path.closed);
    } else {
        path.keys.push_back(take_pose(object));
    }
    object.expect_no_unknown_keys();
    return path;
}

// False unless the text consists of finite numbers separated by commas.
bool parse_numbers(std::string_view text, std::vector<double>& numbers) {
    while (true) {
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc{} || !(std::abs(number) <= kMaxCoordinate)) return false;
        numbers.push_back(number);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (text.empty()) return true;
        if (text.front() != ',') return false;
        text.remove_prefix(1);
    }
}

}  // namespace

Result<Scene> scene_from_json(const std::string& text, const std::filesystem::path& path) {
    return read_json(text, path.string(), [&](JsonObject& top) {
        Scene scene;
        if (top.has("background")) scene.background.sky = {colour(top.take("background"))};
        if (top.has("floor")) scene.floor = read_floor(JsonObject(top.take("floor")));
        if (const auto found = top.find("lights")) read_lights(JsonObject(*found), scene.lights.front());
        if (top.has("nodes")) NodeReader(scene, path.parent_path()).read_list(top.take("nodes"));
        if (top.has("camera")) scene.camera = read_camera(JsonObject(top.take("camera")));
        return scene;
    });
}

Result<Scene> read_scene(const std::filesystem::path& path) {
    const std::string name = lower_case(path.filename().string());
    const auto is_one_of = [&](std::initializer_list<const char*> endings) {
        return std::any_of(endings.begin(), endings.end(), [&](const char* ending) { return name.ends_with(ending); });
    };
    if (is_one_of({".wrl", ".wrl.gz", ".wrz", ".vrml", ".x3d", ".x3d.gz", ".x3dz", ".x3dv", ".x3dv.gz", ".x3dvz"}))
        return read_vrml(path);
    if (is_one_of({".gltf", ".glb", ".obj", ".ply"})) return read_model(path);
    if (const OtherFormat* const format = other_format(name)) {
        return Error{path.string() + ": is " + format->name +
                     ", which is not supported; convert it to glTF, for example with Blender: File > Export > glTF "
                     "2.0"};
    }
    if (!is_one_of({".json"})) {
        return Error{path.string() +
                     ": has no extension of a scene; give a .wrl, .wrl.gz, .x3d, .x3dv, .gltf, .glb, "
                     ".obj, .ply or .json"};
    }
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(path, kMaxScene_bytes));
    return scene_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

Result<RaySpaceNode> parse_object_argument(const std::string& text, const glm::dvec3& otherwise) {
    RaySpaceNode node;
    node.required = true;
    NodeTransform transform;
    transform.translation = otherwise;
    const std::size_t sign = text.rfind('@');
    std::error_code ignored;
    if (sign == std::string::npos || std::filesystem::exists(text, ignored)) {
        node.file = text;
    } else {
        node.file = text.substr(0, sign);
        std::vector<double> numbers;
        if (!parse_numbers(std::string_view(text).substr(sign + 1), numbers) || numbers.size() < 3 ||
            numbers.size() > 5) {
            return Error{
                text + ": is not an object with a position; write FILE.rso@X,Y,Z or FILE.rso@X,Y,Z,TURN_DEGREES,SCALE"};
        }
        transform.translation = {numbers[0], numbers[1], numbers[2]};
        if (numbers.size() > 3) transform.angle_rad = radians(numbers[3]);
        if (numbers.size() > 4) transform.scale = numbers[4];
        if (!(transform.scale >= kMinPositive)) return Error{text + ": the scale must be above 0"};
    }
    node.chain = {transform};
    return node;
}

}  // namespace rs::compositor
