#include "capture/tracer/scene/mesh_file.hpp"

#include "capture/tracer/scene/mesh_material.hpp"
#include "capture/tracer/scene/ply_file.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/models/model_files.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <utility>

namespace rs::capture {

namespace {

constexpr std::uint64_t kMaxModelFile_bytes = std::uint64_t{4} << 30;

glm::vec3 to_vec(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

Mesh convert_mesh(const aiMesh& source) {
    Mesh mesh;
    mesh.name = source.mName.length > 0 ? source.mName.C_Str() : "mesh";
    mesh.material = static_cast<int>(source.mMaterialIndex);
    mesh.positions.reserve(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i) mesh.positions.push_back(to_vec(source.mVertices[i]));
    if (source.HasNormals()) {
        mesh.normals.reserve(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumVertices; ++i) {
            // Vertices of degenerate faces have no normal; shading uses the facet's normal instead of a zero normal.
            const glm::vec3 normal = to_vec(source.mNormals[i]);
            const float length = glm::length(normal);
            mesh.normals.push_back(length > 0.0F && std::isfinite(length) ? normal / length : glm::vec3(0.0F));
        }
    }
    if (source.HasTextureCoords(0)) {
        mesh.uvs.reserve(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumVertices; ++i) {
            mesh.uvs.emplace_back(source.mTextureCoords[0][i].x, source.mTextureCoords[0][i].y);
        }
    }
    if (source.HasVertexColors(0)) {
        mesh.colours.reserve(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumVertices; ++i) {
            const aiColor4D& c = source.mColors[0][i];
            mesh.colours.push_back(glm::max(glm::vec3(c.r, c.g, c.b), glm::vec3(0)));
        }
    }
    mesh.triangles.reserve(source.mNumFaces);
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
        const aiFace& face = source.mFaces[i];
        if (face.mNumIndices == 3) mesh.triangles.emplace_back(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
    }
    return mesh;
}

Result<Scene> convert_scene(const aiScene& source, const std::filesystem::path& path) {
    Scene scene;
    scene.name = path.stem().string();
    RS_TRY(convert_materials(source, path, scene));
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
        if ((source.mMeshes[i]->mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) continue;
        Mesh mesh = convert_mesh(*source.mMeshes[i]);
        if (!mesh.triangles.empty()) scene.meshes.push_back(std::move(mesh));
    }
    if (scene.meshes.empty())
        return Error{path.string() + ": has no faces; a mesh with triangles or polygons is needed"};
    return scene;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
    const std::string extension = lower_case_extension(path);
    return extension == ".obj" || extension == ".ply" || extension == ".gltf" || extension == ".glb";
}

Error missing_texture(const std::filesystem::path& path, const std::filesystem::path& referrer) {
    return Error{referrer.string() + ": texture " + path.string() + " does not exist; add the file"};
}

Result<Texture> read_texture(const std::filesystem::path& path, const std::filesystem::path& referrer) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return missing_texture(path, referrer);
    }
    RS_ASSIGN_OR_RETURN(Image<RgbaF> pixels, read_image_linear(path));
    return Texture{path.filename().string(), std::move(pixels)};
}

Result<Scene> read_mesh_file(const std::filesystem::path& path) {
    if (!is_mesh_file(path))
        return Error{path.string() + ": not a mesh file by its name; use .obj, .ply, .gltf or .glb"};
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        return Error{path.string() + ": there is no such file; check the path"};
    try {
        Assimp::Importer importer;
        const ModelFiles& files = restrict_to_models(importer, kMaxModelFile_bytes);
        importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
        if (lower_case_extension(path) == ".ply") {
            RS_ASSIGN_OR_RETURN(std::unique_ptr<aiScene> ply, read_ply_file(path));
            pass_to_importer(std::move(ply), importer);
        } else {
            importer.ReadFile(path.string(), 0);
        }
        RS_ASSIGN_OR_RETURN(const aiScene* read,
                            post_process(importer,
                                         aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GenSmoothNormals |
                                             aiProcess_JoinIdenticalVertices | aiProcess_PreTransformVertices,
                                         path.string()));
        const aiScene* const source = read;
        if (!files.refusal().empty()) return Error{files.refusal()};
        if (source == nullptr) {
            return Error{path.string() +
                         ": cannot be read as a mesh: " + reading_error(importer.GetErrorString(), path)};
        }
        RS_ASSIGN_OR_RETURN(Scene scene, convert_scene(*source, path));
        scene.warnings = files.warnings();
        return scene;
    } catch (const std::exception& problem) {
        return Error{path.string() + ": cannot be read as a mesh: " + reading_error(problem.what(), path)};
    }
}

}  // namespace rs::capture
