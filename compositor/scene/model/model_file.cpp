#include "compositor/scene/model/model_file.hpp"

#include "capture/tracer/scene/ply_file.hpp"
#include "compositor/scene/model/gltf_nodes.hpp"
#include "compositor/scene/model/model_materials.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/models/model_files.hpp"
#include "rayspace/models/model_material.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::uint64_t kMaxModel_bytes = std::uint64_t{64} << 20;
constexpr std::size_t kMaxDraws = 100'000;
constexpr int kMaxHeight = 500;

std::shared_ptr<const Mesh> convert(const aiMesh& source, bool two_sided) {
    auto mesh = std::make_shared<Mesh>();
    mesh->topology = source.mPrimitiveTypes == aiPrimitiveType_LINE    ? Topology::kLines
                     : source.mPrimitiveTypes == aiPrimitiveType_POINT ? Topology::kPoints
                                                                       : Topology::kTriangles;
    mesh->two_sided = two_sided || mesh->topology != Topology::kTriangles;
    mesh->has_colours = source.HasVertexColors(0);
    const unsigned corners = mesh->topology == Topology::kTriangles ? 3 : mesh->topology == Topology::kLines ? 2 : 1;
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        MeshVertex vertex;
        vertex.position = {source.mVertices[i].x, source.mVertices[i].y, source.mVertices[i].z};
        if (source.HasNormals() && corners == 3) {
            vertex.normal = {source.mNormals[i].x, source.mNormals[i].y, source.mNormals[i].z};
        }
        if (source.HasTextureCoords(0)) {
            vertex.texture = {source.mTextureCoords[0][i].x, source.mTextureCoords[0][i].y};
        }
        if (mesh->has_colours) {
            const aiColor4D& c = source.mColors[0][i];
            vertex.colour = {c.r, c.g, c.b, 1};
        }
        mesh->vertices.push_back(vertex);
    }
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
        const aiFace& face = source.mFaces[f];
        if (face.mNumIndices != corners) continue;
        for (unsigned k = 0; k < corners; ++k) {
            // Faces must be complete.
            if (face.mIndices[k] >= source.mNumVertices) return std::make_shared<Mesh>();
            mesh->indices.push_back(face.mIndices[k]);
        }
    }
    return mesh;
}

constexpr unsigned kPostProcessing =
    aiProcess_Triangulate | aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType;
// Points are not joined: that needs 270 bytes each in Assimp.
constexpr unsigned kPointProcessing = aiProcess_SortByPType;

// Reads a PLY file into the importer, with normals of unit length.
// \return the steps of post-processing
Result<unsigned> read_ply_model(const std::filesystem::path& path, Assimp::Importer& importer) {
    RS_ASSIGN_OR_RETURN(std::unique_ptr<aiScene> ply, capture::read_ply_file(path, capture::PlyUse::kDisplay));
    const aiMesh& mesh = *ply->mMeshes[0];
    for (unsigned i = 0; mesh.HasNormals() && i < mesh.mNumVertices; ++i) {
        aiVector3D& normal = mesh.mNormals[i];
        const float length = normal.Length();
        normal = length > 0 && std::isfinite(length) ? normal / length : aiVector3D(0);
    }
    const bool has_faces = mesh.mFaces[0].mNumIndices > 1;
    capture::pass_to_importer(std::move(ply), importer);
    return has_faces ? kPostProcessing : kPointProcessing;
}

class ModelWalk {
public:
    ModelWalk(const aiScene& model, model::ModelMaterials& materials, ModelParts& parts)
        : model_(model), materials_(materials), scene_(parts.scene), names_(parts.nodes) {}

    // False if limits are exceeded.
    bool walk(const aiNode& node, const glm::dmat4& world_from_parent, int height) {
        if (height > kMaxHeight) return false;
        const aiMatrix4x4& m = node.mTransformation;  // row-major
        const glm::dmat4 local(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4,
                               m.d4);
        const glm::dmat4 world_from_node = world_from_parent * local;
        const double determinant = glm::determinant(glm::dmat3(world_from_node));
        const bool visible = std::isfinite(determinant) && std::abs(determinant) > 1e-30;
        for (unsigned i = 0; visible && i < node.mNumMeshes; ++i) {
            if (scene_.geometry.size() > kMaxDraws) return false;
            add(node.mMeshes[i], world_from_node, node.mName.C_Str());
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) {
            if (!walk(*node.mChildren[i], world_from_node, height + 1)) return false;
        }
        return true;
    }

private:
    void add(unsigned index, const glm::dmat4& world_from_node, const char* name) {
        const aiMesh& source = *model_.mMeshes[index];
        const model::MaterialWithSides& look = materials_.at(source.mMaterialIndex);
        std::shared_ptr<const Mesh>& mesh = meshes_[index];
        if (!mesh) mesh = convert(source, look.two_sided);
        if (mesh->indices.empty()) return;
        GeometryNode node{mesh, look.material, world_from_node, {}};
        // The highlights of metals have their colour.
        const auto& surface = node.material.surface;
        if (mesh->has_colours && surface && surface->kind == rs::SurfaceKind::metal) {
            node.material.specular *= mean_colour(index, *mesh);
        }
        if (mesh->topology != Topology::kTriangles) {
            node.material.lit = false;
            node.material.texture = nullptr;
            node.material.normals = nullptr;
        }
        scene_.geometry.push_back(std::move(node));
        names_.emplace_back(name);
    }

    glm::vec3 mean_colour(unsigned index, const Mesh& mesh) {
        const auto [mean, is_new] = mean_colours_.emplace(index, glm::vec3(0));
        for (std::size_t i = 0; is_new && i < mesh.vertices.size(); ++i) {
            mean->second += glm::vec3(mesh.vertices[i].colour) / static_cast<float>(mesh.vertices.size());
        }
        return mean->second;
    }

    const aiScene& model_;
    model::ModelMaterials& materials_;
    Scene& scene_;
    std::vector<std::string>& names_;
    std::map<unsigned, std::shared_ptr<const Mesh>> meshes_;
    std::map<unsigned, glm::vec3> mean_colours_;
};

}  // namespace

Result<Scene> read_model(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(ModelParts parts, read_model_parts(path));
    return std::move(parts.scene);
}

Result<ModelParts> read_model_parts(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(path, kMaxModel_bytes));
    ModelParts parts;
    Scene& scene = parts.scene;
    scene.lights.clear();
    bool has_meshes = true;
    if (is_gltf(path)) {
        RS_ASSIGN_OR_RETURN(const model::GltfContents contents, model::read_gltf_nodes(bytes, path, scene));
        has_meshes = contents.has_meshes;
    }
    scene.navigation.headlight = scene.lights.empty();
    try {
        Assimp::Importer importer;
        const ModelFiles& files = restrict_to_models(importer, kMaxModel_bytes);
        unsigned steps = kPostProcessing;
        if (lower_case_extension(path) == ".ply") {
            RS_ASSIGN_OR_RETURN(steps, read_ply_model(path, importer));
        } else {
            importer.ReadFile(path.string(), 0);
        }
        if (!files.refusal().empty()) return Error{files.refusal()};
        RS_ASSIGN_OR_RETURN(const aiScene* read, post_process(importer, steps, path.string()));
        const aiScene* const model = read;
        if (model == nullptr || model->mRootNode == nullptr) {
            const std::string message = path.string() +
                                        ": cannot be read: " + reading_error(importer.GetErrorString(), path) +
                                        "; export it again";
            // Scenes of objects alone are valid, but Assimp rejects files without meshes.
            if (is_gltf(path) && !scene.objects.empty() && !has_meshes) return parts;
            return Error{message};
        }
        model::ModelMaterials materials(*model, path);
        if (!ModelWalk(*model, materials, parts).walk(*model->mRootNode, glm::dmat4(1.0), 0)) {
            return Error{path.string() + ": has too many meshes, or nodes too deep; make it smaller"};
        }
        for (unsigned i = 0; i < model->mNumMaterials; ++i) {
            parts.materials.push_back({model->mMaterials[i]->GetName().C_Str(), materials.at(i).material});
        }
        scene.warnings.insert(scene.warnings.end(), files.warnings().begin(), files.warnings().end());
        scene.warnings.insert(scene.warnings.end(), materials.warnings.begin(), materials.warnings.end());
    } catch (const std::exception& exception) {
        return Error{path.string() + ": cannot be read: " + reading_error(exception.what(), path) +
                     "; export it again"};
    }
    return parts;
}

}  // namespace rs::compositor
