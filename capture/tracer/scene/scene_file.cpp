#include "capture/tracer/scene/scene_file.hpp"

#include "capture/tracer/scene/mesh_file.hpp"
#include "capture/tracer/scene/normalise.hpp"
#include "capture/tracer/scene/scene_check.hpp"
#include "capture/tracer/scene/studio.hpp"
#include "capture/tracer/scene/surroundings.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace rs::capture {

namespace {

constexpr std::uint64_t kMaxRecipe_bytes = 16 << 20;

bool is_lit(const Scene& scene) {
    return !scene.environment.pixels.empty() || !scene.lights.empty() ||
           // Lights painted on the object (pilot lamps, screens) light no scene.
           std::ranges::any_of(scene.materials, [](const Material& m) {
               return m.emission != glm::vec3(0.0F) && m.emission_texture < 0;
           });
}

// One texture for all materials of a mesh file.
void apply_texture(const std::string& file, const std::filesystem::path& recipe, RecipeReader& reader, Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.uvs.empty()) {
            return reader.complain("texture",
                                   "mesh \"" + mesh.name + "\" has no texture coordinates; add some to the mesh");
        }
    }
    Result<Texture> texture = read_texture(recipe.parent_path() / file, recipe);
    if (!texture) {
        if (!reader.errors().first) reader.errors().first = texture.error();
        return;
    }
    scene.textures.push_back(std::move(texture).value());
    for (Material& material : scene.materials) {
        material.texture = static_cast<int>(scene.textures.size()) - 1;
        material.colour = glm::vec3(1.0F);
    }
}

void load_mesh_object(RecipeReader& reader, const std::filesystem::path& recipe, Scene& scene, ObjectCentre& centre) {
    std::string mesh_file;
    std::string texture_file;
    std::string centre_name = "box";
    reader.read("centre", centre_name);
    if (centre_name != "box" && centre_name != "origin") reader.complain("centre", "must be \"box\" or \"origin\"");
    centre = centre_name == "origin" ? ObjectCentre::mesh_origin : ObjectCentre::bounding_box;
    reader.read("mesh", mesh_file);
    reader.read("texture", texture_file);
    const nlohmann::json* material = reader.child("material");
    reader.finish();
    if (reader.errors().first) return;
    Result<Scene> loaded = read_mesh_file(recipe.parent_path() / mesh_file);
    if (!loaded) return reader.complain("mesh", loaded.error().message);
    scene = std::move(loaded).value();
    if (!texture_file.empty()) apply_texture(texture_file, recipe, reader, scene);
    if (material == nullptr) return;
    for (Material& each : scene.materials) read_material(*material, reader.place_of("material"), reader.errors(), each);
}

void generate_object(RecipeReader& reader, const Generator& generator, std::uint64_t seed, Scene& scene) {
    std::string name;
    reader.read("generator", name);
    const nlohmann::json* parameters = reader.child("parameters");
    reader.finish();
    if (reader.errors().first) return;
    if (!generator) return reader.complain("generator", "there are no generators here; name a \"mesh\"");
    Result<Scene> made = generator(name, parameters != nullptr ? *parameters : nlohmann::json::object(), seed);
    if (!made) return reader.complain("generator", made.error().message);
    scene = std::move(made).value();
}

void load_object(const nlohmann::json& json, const std::filesystem::path& recipe, const Generator& generator,
                 std::uint64_t seed, RecipeErrors& errors, Scene& scene, ObjectCentre& centre) {
    RecipeReader reader(json, "object", errors);
    if (reader.has("mesh") == reader.has("generator")) return reader.complain("give one of \"mesh\" and \"generator\"");
    if (reader.has("mesh")) return load_mesh_object(reader, recipe, scene, centre);
    generate_object(reader, generator, seed, scene);
}

void override_materials(const nlohmann::json& json, RecipeErrors& errors, Scene& scene) {
    if (!json.is_object()) return errors.add("materials", "must be an object {name: {...}}");
    for (const auto& item : json.items()) {
        bool found = false;
        for (Material& material : scene.materials) {
            if (material.name != item.key()) continue;
            read_material(item.value(), "materials." + item.key(), errors, material);
            found = true;
        }
        if (found) continue;
        std::string names;
        for (const Material& material : scene.materials) names += (names.empty() ? "" : ", ") + material.name;
        errors.add("materials", "the object has no material \"" + item.key() + "\"; it has " + names);
    }
}

void read_look(RecipeReader& reader, SceneFile& file) {
    std::string look = "photo";
    reader.read("look", look);
    if (look != "photo" && look != "toon") reader.complain("look", "must be \"photo\" or \"toon\"");
    const nlohmann::json* style = reader.child("toon");
    if (style != nullptr && look != "toon") reader.complain("toon", "is for \"look\": \"toon\"; add that");
    if (look != "toon") return;
    file.toon.emplace();
    if (style != nullptr) read_toon(*style, reader.errors(), *file.toon);
}

// What is to stand around the object.
struct Room {
    Scene scene;
    glm::vec3 at{0.0F};  // of it, where the object's axis meets the ground that it stands on
    double turn_deg = 0;
    double radius = 0;  // of the object, in its units

    [[nodiscard]] glm::dmat4 object_from_room(double ground_height) const {
        glm::dmat4 matrix = glm::translate(glm::dmat4(1), {0, ground_height, 0});
        matrix = glm::rotate(matrix, radians(-turn_deg), {0, 1, 0});
        matrix = glm::scale(matrix, glm::dvec3(1 / radius));
        return glm::translate(matrix, -glm::dvec3(at));
    }
};

Room read_room(const nlohmann::json& json, const std::filesystem::path& folder, RecipeErrors& errors) {
    RecipeReader reader(json, "room", errors);
    Room room;
    std::string name;
    reader.read("file", name);
    reader.read("at", room.at);
    reader.read("turn_deg", room.turn_deg, -360, 360);
    reader.read("radius", room.radius, 1e-6, RecipeReader::kHuge);
    reader.finish();
    if (name.empty()) reader.complain("file", "is missing; name the room's mesh (.obj, .ply, .gltf, .glb)");
    if (room.radius == 0) reader.complain("radius", "is missing; give the object's, in the room's units");
    if (errors.first) return room;
    Result<Scene> loaded = read_mesh_file(folder / name);
    if (!loaded) {
        reader.complain("file", loaded.error().message);
    } else {
        room.scene = std::move(*loaded);
    }
    return room;
}

Result<SceneFile> finish_scene(SceneFile file, const std::filesystem::path& path, ObjectCentre centre,
                               std::optional<Room> room = {}) {
    if (!is_lit(file.scene) && !(room && is_lit(room->scene)))
        file.scene.environment = make_studio_environment(default_studio());
    // First the check: normalisation relies on valid indices.
    if (Status checked = check_scene(file.scene); !checked)
        return Error{path.string() + ": " + checked.error().message};
    Result<double> radius = normalise_meshes(file.scene, centre);
    if (!radius) return Error{path.string() + ": " + radius.error().message};
    file.object_radius = *radius;
    file.ground_height = ground_height(file.scene);
    if (!room) return file;
    surround(file.scene, std::move(room->scene), room->object_from_room(file.ground_height));
    if (Status checked = check_scene(file.scene); !checked)
        return Error{path.string() + ": with its room: " + checked.error().message};
    return file;
}

Result<SceneFile> load_recipe(const std::filesystem::path& path, const Generator& generator) {
    const auto bytes = read_file(path, kMaxRecipe_bytes);
    if (!bytes) return bytes.error();
    const auto json = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
    if (!json) return json.error();
    RecipeErrors errors{path.string(), std::nullopt};

    SceneFile file;
    RecipeReader reader(*json, "", errors);
    std::string name = path.stem().string();
    reader.read("name", name);
    reader.read("seed", file.seed);
    const nlohmann::json* object = reader.child("object");
    const nlohmann::json* materials = reader.child("materials");
    const nlohmann::json* camera = reader.child("camera");
    const nlohmann::json* environment = reader.child("environment");
    const nlohmann::json* lights = reader.child("lights");
    const nlohmann::json* room = reader.child("room");
    read_look(reader, file);
    if (room != nullptr && file.toon) reader.complain("room", "does not go with \"look\": \"toon\"; leave out one");
    reader.finish();
    if (object == nullptr) errors.add("object", "is missing; give {\"mesh\": ...} or {\"generator\": ...}");
    ObjectCentre centre = ObjectCentre::bounding_box;
    if (camera != nullptr) read_camera(*camera, errors, file.camera);
    if (!errors.first) load_object(*object, path, generator, file.seed, errors, file.scene, centre);
    if (errors.first) return *errors.first;

    file.scene.name = name;
    if (materials != nullptr) override_materials(*materials, errors, file.scene);
    if (lights != nullptr) {
        file.scene.lights.clear();
        read_lights(*lights, errors, file.scene);
    }
    if (environment != nullptr) read_environment(*environment, path.parent_path(), errors, file.scene.environment);
    std::optional<Room> around;
    if (room != nullptr) around = read_room(*room, path.parent_path(), errors);
    if (errors.first) return *errors.first;
    return finish_scene(std::move(file), path, centre, std::move(around));
}

}  // namespace

Result<SceneFile> load_scene_file(const std::filesystem::path& path, const Generator& generator) {
    if (path.extension() == ".json") return load_recipe(path, generator);
    if (!is_mesh_file(path)) {
        return Error{path.string() +
                     ": not a scene by its name; give a recipe (.json) or a mesh (.obj, .ply, .gltf, .glb)"};
    }
    Result<Scene> scene = read_mesh_file(path);
    if (!scene) return scene.error();
    SceneFile file;
    file.scene = std::move(scene).value();
    return finish_scene(std::move(file), path, ObjectCentre::bounding_box);
}

}  // namespace rs::capture
