#include "rayspace/models/model_files.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/base/utf8.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/file_reference.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/models/gltf_extensions.hpp"
#include "rayspace/models/model_material.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/IOStream.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace rs {

namespace {

constexpr float kCreaseAngle_deg = 60.0F;

class MemoryFile : public Assimp::IOStream {
public:
    explicit MemoryFile(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

    std::size_t Read(void* to, std::size_t size, std::size_t count) override {
        if (size == 0) return 0;
        const std::size_t items = std::min(count, (bytes_.size() - at_) / size);
        if (items > 0) std::memcpy(to, bytes_.data() + at_, items * size);
        at_ += items * size;
        return items;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
        if (offset > bytes_.size() || base > bytes_.size() - offset) return aiReturn_FAILURE;
        at_ = base + offset;
        return aiReturn_SUCCESS;
    }
    [[nodiscard]] std::size_t Tell() const override { return at_; }
    [[nodiscard]] std::size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

private:
    std::vector<std::byte> bytes_;
    std::size_t at_ = 0;
};

bool finite(const aiVector3D& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void set_primitive_types(const aiScene& model) {
    constexpr unsigned kTypes[] = {0, aiPrimitiveType_POINT, aiPrimitiveType_LINE, aiPrimitiveType_TRIANGLE,
                                   aiPrimitiveType_POLYGON};
    for (unsigned m = 0; m < model.mNumMeshes; ++m) {
        aiMesh& mesh = *model.mMeshes[m];
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const unsigned corners = std::min(mesh.mFaces[f].mNumIndices, 4U);
            mesh.mPrimitiveTypes |= kTypes[corners];
        }
    }
}

// Affine map of texture coordinates (u to the right, v upwards), for (u, v, 1).
using UvMap = glm::mat3x2;

UvMap map_of(const TexturePlacement& placement) {
    return {placement.scale.x, 0, 0, placement.scale.y, placement.offset.x, placement.offset.y};
}

// KHR_texture_transform, which has v downwards and turns about the origin. Assimp's translation is for turns about the
// centre of the image (glTF2Importer.cpp); the file's offset is restored from it. Assimp's step TransformUVCoords is
// not used: it scales about the centre, too, which that translation does not allow for.
UvMap map_of(const aiUVTransform& t) {
    const float c = std::cos(t.mRotation), s = -std::sin(t.mRotation);
    const glm::vec2 scale(t.mScaling.x, t.mScaling.y);
    const glm::vec2 offset(t.mTranslation.x - scale.x * (1 - c + s) / 2,
                           scale.y * (s + c - 1) / 2 + 1 - scale.y - t.mTranslation.y);
    return {c * scale.x, s * scale.x, -s * scale.y, c * scale.y, s * scale.y + offset.x, 1 - c * scale.y - offset.y};
}

// Moves the coordinates of each mesh's leading texture to its first set, as the material places that texture.
void place_textures(const aiScene& model, const std::map<std::string, TexturePlacement>& placements) {
    for (unsigned m = 0; m < model.mNumMeshes; ++m) {
        aiMesh& mesh = *model.mMeshes[m];
        if (mesh.mMaterialIndex >= model.mNumMaterials) continue;
        aiMaterial& material = *model.mMaterials[mesh.mMaterialIndex];
        const aiTextureType leading = leading_texture(material);
        const auto set = material_property<int>(material, AI_MATKEY_UVWSRC(leading, 0)).value_or(0);
        if (set > 0 && set < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(static_cast<unsigned>(set))) {
            std::swap(mesh.mTextureCoords[0], mesh.mTextureCoords[set]);
            std::swap(mesh.mNumUVComponents[0], mesh.mNumUVComponents[set]);
        }
        std::optional<UvMap> map;
        if (const auto found = placements.find(material.GetName().C_Str()); found != placements.end()) {
            map = map_of(found->second);
        } else if (const auto transform =
                       material_property<aiUVTransform>(material, AI_MATKEY_UVTRANSFORM(leading, 0))) {
            map = map_of(*transform);
        }
        for (unsigned i = 0; map && mesh.HasTextureCoords(0) && i < mesh.mNumVertices; ++i) {
            aiVector3D& at = mesh.mTextureCoords[0][i];
            const glm::vec2 placed = *map * glm::vec3(at.x, at.y, 1);
            at = {placed.x, placed.y, 0};
        }
    }
}

Status check_finite(const aiScene& model, const std::string& file) {
    for (unsigned m = 0; m < model.mNumMeshes; ++m) {
        const aiMesh& mesh = *model.mMeshes[m];
        const std::string of_mesh =
            " of mesh \"" + std::string(mesh.mName.C_Str()) + "\" is not finite; repair the mesh";
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            if (!finite(mesh.mVertices[i])) return Error{file + ": vertex " + std::to_string(i) + of_mesh};
            if (mesh.HasTextureCoords(0) && !finite(mesh.mTextureCoords[0][i])) {
                return Error{file + ": the texture coordinate of vertex " + std::to_string(i) + of_mesh};
            }
        }
    }
    return {};
}

}  // namespace

bool ModelFiles::Exists(const char* path) const {
    const auto resolved = resolve_reference(path, "");
    std::error_code ignored;
    return resolved && std::filesystem::exists(*resolved, ignored);
}

Assimp::IOStream* ModelFiles::Open(const char* path, const char* mode) {
    if (std::strchr(mode, 'w') != nullptr || std::strchr(mode, 'a') != nullptr || !Exists(path)) return nullptr;
    Result<std::vector<std::byte>> bytes = read(*resolve_reference(path, ""));
    if (!bytes) {
        refusal_ = bytes.error().message;
        return nullptr;
    }
    return new MemoryFile(std::move(*bytes));
}

Result<std::vector<std::byte>> ModelFiles::read(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(std::vector<std::byte> bytes, read_file(path, cap_bytes_));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (is_utf16(text)) return Error{path.string() + ": is UTF-16 text; save it as UTF-8"};
    const std::string extension = lower_case_extension(path);
    if (extension == ".obj") {
        obj_ = path;
        obj_names_ = names_in_obj(text);
    }
    if (extension == ".mtl") {
        MtlText rewritten = rewrite_mtl(text);
        placements_.merge(rewritten.placements);
        materials_.merge(rewritten.materials);
        // Assimp rejects files of fewer than 8 bytes.
        if (rewritten.text.size() < 8) rewritten.text = "# empty\n";
        const auto rewritten_bytes = std::as_bytes(std::span(rewritten.text));
        return std::vector<std::byte>(rewritten_bytes.begin(), rewritten_bytes.end());
    }
    if (extension == ".gltf" || text.starts_with("glTF")) {
        RS_ASSIGN_OR_RETURN(GltfFile file, prepare_gltf(std::move(bytes), path.string()));
        for (std::string& warning : file.warnings) warn(std::move(warning));
        return std::move(file.bytes);
    }
    const std::size_t mark = text.size() - without_byte_order_mark(text).size();
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(mark));
    return bytes;
}

void ModelFiles::warn(std::string warning) {
    if (std::ranges::find(warnings_, warning) == warnings_.end()) warnings_.push_back(std::move(warning));
}

void ModelFiles::report_skipped_names() {
    const std::string file = obj_.string() + ": ";
    if (obj_names_.has_free_forms) warn(file + "free-form curves and surfaces are ignored; export them as faces");
    const auto missing = std::ranges::find_if(obj_names_.libraries, [&](const std::string& library) {
        const auto path = resolve_reference(library, obj_.parent_path());
        return !path || !Exists(path->string().c_str());
    });
    if (missing != obj_names_.libraries.end()) {
        warn(printable(file + "the material library " + *missing + " does not exist; drawn without its materials"));
    }
    if (materials_.empty()) return;
    std::vector<std::string> undefined;
    std::ranges::set_difference(obj_names_.materials, materials_, std::back_inserter(undefined));
    if (undefined.empty()) return;
    const std::string more = undefined.size() > 1 ? " and " + std::to_string(undefined.size() - 1) + " more" : "";
    warn(printable(file + "no material library defines " + undefined.front() + more + "; drawn grey"));
}

void ModelFiles::Close(Assimp::IOStream* stream) {
    delete stream;
}

ModelFiles& restrict_to_models(Assimp::Importer& importer, std::uint64_t cap_bytes) {
    constexpr std::array<const char*, 3> kWanted = {" obj ", " gltf ", " glb "};
    std::vector<Assimp::BaseImporter*> others;
    for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
        const std::string extensions = ' ' + std::string(importer.GetImporterInfo(i)->mFileExtensions) + ' ';
        const bool wanted =
            std::ranges::any_of(kWanted, [&](const char* name) { return extensions.find(name) != std::string::npos; });
        if (!wanted) others.push_back(importer.GetImporter(i));
    }
    for (Assimp::BaseImporter* const other : others) {
        importer.UnregisterLoader(other);
        delete other;  // owned by the caller after unregistering
    }
    importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kCreaseAngle_deg);
    auto* const files = new ModelFiles(cap_bytes);
    importer.SetIOHandler(files);
    return *files;
}

std::string reading_error(const char* message, const std::filesystem::path& file) {
    constexpr std::uint64_t kMaxDiagnosed_bytes = std::uint64_t{64} << 20;
    if (lower_case_extension(file) == ".obj") {
        const auto bytes = read_file(file, kMaxDiagnosed_bytes);
        if (bytes) {
            std::string fault = find_bad_obj_index({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
            if (!fault.empty()) return fault;
        }
    }
    std::string text = message;
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return printable(text);
}

Result<const aiScene*> post_process(Assimp::Importer& importer, unsigned steps, const std::string& file) {
    const aiScene* const model = importer.GetScene();
    if (model == nullptr) return model;
    RS_TRY(check_finite(*model, file));
    set_primitive_types(*model);
    if (auto* const files = dynamic_cast<ModelFiles*>(importer.GetIOHandler())) {
        files->report_skipped_names();
        place_textures(*model, files->placements());
    }
    return importer.ApplyPostProcessing(aiProcess_ValidateDataStructure | steps);
}

}  // namespace rs
