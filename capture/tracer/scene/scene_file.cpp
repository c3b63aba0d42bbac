#include "capture/tracer/scene/scene_file.hpp"

#include "capture/tracer/scene/mesh_file.hpp"
#include "capture/tracer/scene/scene_transform.hpp"
#include "capture/tracer/scene/studio.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/base/printable.hpp"
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
           // Small emissive details of the object (pilot lamps, screens) do not light a scene.
           std::ranges::any_of(scene.materials, [](const Material& m) {
               return m.emission != glm::vec3(0.0F) && m.emission_texture < 0;
           });
}

// Sets one texture for all materials of a mesh file.
void apply_texture(const JsonValue& texture, const std::filesystem::path& recipe, Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.uvs.empty()) continue;
        throw texture.wrong("mesh \"" + mesh.name + "\" has no texture coordinates; add some to the mesh");
    }
    Result<Texture> read = read_texture(recipe.parent_path() / texture.text_or_empty(), recipe);
    if (!read) throw MalformedJson{printable(read.error().message)};
    scene.textures.push_back(std::move(read).value());
    for (Material& material : scene.materials) {
        material.texture = static_cast<int>(scene.textures.size()) - 1;
        material.colour = glm::vec3(1.0F);
    }
}

void load_mesh_object(JsonObject& object, const std::filesystem::path& recipe, Scene& scene, ObjectCentre& centre) {
    if (object.has("centre") && object.take("centre").one_of({"box", "origin"}) == 1)
        centre = ObjectCentre::mesh_origin;
    const JsonValue mesh = object.take("mesh");
    const auto texture = object.find("texture");
    const auto material = object.find("material");
    object.expect_no_unknown_keys();
    Result<Scene> loaded = read_mesh_file(recipe.parent_path() / mesh.text());
    if (!loaded) throw mesh.wrong(loaded.error().message);
    scene = std::move(loaded).value();
    if (texture && !texture->text_or_empty().empty()) apply_texture(*texture, recipe, scene);
    if (!material) return;
    for (Material& each : scene.materials) read_material(JsonObject(*material), each);
}

void generate_object(JsonObject& object, const Generator& generator, std::uint64_t seed, Scene& scene) {
    const JsonValue name = object.take("generator");
    const auto parameters = object.find("parameters");
    object.expect_no_unknown_keys();
    if (!generator) throw name.wrong("generators are not available; use a \"mesh\"");
    Result<Scene> made = generator(name.text(), parameters ? parameters->json() : nlohmann::json::object(), seed);
    if (!made) throw name.wrong(made.error().message);
    scene = std::move(made).value();
}

void load_object(JsonObject object, const std::filesystem::path& recipe, const Generator& generator, std::uint64_t seed,
                 Scene& scene, ObjectCentre& centre) {
    if (object.has("mesh") == object.has("generator")) throw object.wrong("give one of \"mesh\" and \"generator\"");
    if (object.has("mesh")) return load_mesh_object(object, recipe, scene, centre);
    generate_object(object, generator, seed, scene);
}

void override_materials(JsonObject object, Scene& scene) {
    for (const auto& [name, value] : object.json().items()) {
        const JsonValue chosen = object.take(name);
        bool found = false;
        for (Material& material : scene.materials) {
            if (material.name != name) continue;
            read_material(JsonObject(chosen), material);
            found = true;
        }
        if (found) continue;
        std::string names;
        for (const Material& material : scene.materials) names += (names.empty() ? "" : ", ") + material.name;
        throw object.wrong("the object has no material \"" + name + "\"; it has " + names);
    }
}

void read_look(JsonObject& top, SceneFile& file) {
    const bool is_toon = top.has("look") && top.take("look").one_of({"photo", "toon"}) == 1;
    if (is_toon) file.toon.emplace();
    if (!top.has("toon")) return;
    const JsonValue style = top.take("toon");
    if (!is_toon) throw style.wrong("requires \"look\": \"toon\"; add it");
    read_toon(JsonObject(style), *file.toon);
}

// Surroundings of the object.
struct Room {
    Scene scene;
    glm::vec3 at{0.0F};  // room coordinates of the object's axis at ground level
    double turn_deg = 0;
    double radius = 0;  // object radius in the room's units

    [[nodiscard]] glm::dmat4 object_from_room(double ground_height) const {
        glm::dmat4 matrix = glm::translate(glm::dmat4(1), {0, ground_height, 0});
        matrix = glm::rotate(matrix, radians(-turn_deg), {0, 1, 0});
        matrix = glm::scale(matrix, glm::dvec3(1 / radius));
        return glm::translate(matrix, -glm::dvec3(at));
    }
};

Room read_room(JsonObject object, const std::filesystem::path& folder) {
    Room room;
    if (!object.has("file")) throw object.wrong("file is missing; add the room's mesh (.obj, .ply, .gltf, .glb)");
    if (!object.has("radius")) throw object.wrong("radius is missing; add the object's radius in the room's units");
    const JsonValue file = object.take("file");
    object.read("at", room.at);
    object.read("turn_deg", room.turn_deg, -360, 360);
    object.read("radius", room.radius, 1e-6);
    object.expect_no_unknown_keys();
    Result<Scene> loaded = read_mesh_file(folder / file.text());
    if (!loaded) throw file.wrong(loaded.error().message);
    room.scene = std::move(*loaded);
    return room;
}

Result<SceneFile> finish_scene(SceneFile file, const std::filesystem::path& path, ObjectCentre centre,
                               std::optional<Room> room = {}) {
    if (!is_lit(file.scene) && !(room && is_lit(room->scene)))
        file.scene.environment = make_studio_environment(default_studio());
    // Normalisation requires valid indices.
    if (Status checked = check_scene(file.scene); !checked)
        return Error{path.string() + ": " + checked.error().message};
    Result<double> radius = normalise_meshes(file.scene, centre);
    if (!radius) return Error{path.string() + ": " + radius.error().message};
    file.object_radius = *radius;
    file.ground_height = ground_height(file.scene);
    if (!room) return file;
    add_surroundings(file.scene, std::move(room->scene), room->object_from_room(file.ground_height));
    if (Status checked = check_scene(file.scene); !checked)
        return Error{path.string() + ": with its room: " + checked.error().message};
    return file;
}

struct Recipe {
    SceneFile file;
    ObjectCentre centre = ObjectCentre::bounding_box;
    std::optional<Room> room;
};

Recipe read_recipe(JsonObject& top, const std::filesystem::path& path, const Generator& generator) {
    Recipe recipe;
    SceneFile& file = recipe.file;
    std::string name = path.stem().string();
    top.read("name", name);
    if (const auto seed = top.find("seed")) file.seed = seed->unsigned_number();
    const auto materials = top.find("materials");
    const auto camera = top.find("camera");
    const auto environment = top.find("environment");
    const auto lights = top.find("lights");
    const auto room = top.find("room");
    read_look(top, file);
    if (room && file.toon) throw room->wrong("cannot be combined with \"look\": \"toon\"; remove one of them");
    const auto object = top.find("object");
    top.expect_no_unknown_keys();
    if (!object) throw top.wrong("object is missing; give {\"mesh\": ...} or {\"generator\": ...}");
    if (camera) read_camera(JsonObject(*camera), file.camera);
    load_object(JsonObject(*object), path, generator, file.seed, file.scene, recipe.centre);
    file.scene.name = name;
    if (materials) override_materials(JsonObject(*materials), file.scene);
    if (lights) {
        file.scene.lights.clear();
        read_lights(*lights, file.scene);
    }
    if (environment) read_environment(JsonObject(*environment), path.parent_path(), file.scene.environment);
    if (room) recipe.room = read_room(JsonObject(*room), path.parent_path());
    return recipe;
}

Result<SceneFile> load_recipe(const std::filesystem::path& path, const Generator& generator) {
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxRecipe_bytes));
    RS_ASSIGN_OR_RETURN(Recipe recipe,
                        read_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string(),
                                  [&](JsonObject& top) { return read_recipe(top, path, generator); }));
    return finish_scene(std::move(recipe.file), path, recipe.centre, std::move(recipe.room));
}

}  // namespace

Result<SceneFile> load_scene_file(const std::filesystem::path& path, const Generator& generator) {
    if (path.extension() == ".json") return load_recipe(path, generator);
    if (!is_mesh_file(path)) {
        return Error{path.string() +
                     ": not a scene by its name; give a recipe (.json) or a mesh (.obj, .ply, .gltf, .glb)"};
    }
    RS_ASSIGN_OR_RETURN(Scene scene, read_mesh_file(path));
    SceneFile file;
    file.scene = std::move(scene);
    return finish_scene(std::move(file), path, ObjectCentre::bounding_box);
}

}  // namespace rs::capture
