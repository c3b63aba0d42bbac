#include "rayspace/models/model_files.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/IOStream.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
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

// Checks a .glb (glTF 2.0, 4.4; version 1.0 has its JSON's length at the same place), since Assimp allocates a chunk's
// stated length before it checks the file's size.
bool is_whole_glb(std::span<const std::byte> bytes) {
    constexpr std::size_t kHeader_bytes = 12, kChunkHeader_bytes = 8;
    std::size_t at = kHeader_bytes;
    do {
        std::uint32_t length = 0;
        if (at > bytes.size() || bytes.size() - at < kChunkHeader_bytes) return false;
        std::memcpy(&length, bytes.data() + at, sizeof length);
        at += kChunkHeader_bytes;
        if (length > bytes.size() - at) return false;
        at += length;
    } while (bytes[4] != std::byte{1} && at < bytes.size());
    return true;
}

// The material file from its first newmtl on, since earlier statements crash Assimp, without leading spaces, which hide
// statements from it; a single comment if there is no newmtl, since Assimp rejects files of fewer than 8 bytes.
std::vector<std::byte> extract_materials(std::vector<std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::size_t kept = 0;
    for (std::size_t line = 0; line < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", line), text.size() - 1) + 1;
        const std::size_t word = std::min(text.find_first_not_of(" \t", line), end);
        if (kept > 0 || text.substr(word).starts_with("newmtl")) {
            std::memmove(bytes.data() + kept, bytes.data() + word, end - word);
            kept += end - word;
        }
        line = end;
    }
    bytes.resize(kept);
    constexpr std::string_view kNothing = "# empty\n";
    if (bytes.size() < kNothing.size()) {
        bytes.assign(reinterpret_cast<const std::byte*>(kNothing.data()),
                     reinterpret_cast<const std::byte*>(kNothing.data() + kNothing.size()));
    }
    return bytes;
}

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
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

Assimp::IOStream* ModelFiles::Open(const char* path, const char* mode) {
    if (std::strchr(mode, 'w') != nullptr || std::strchr(mode, 'a') != nullptr || !Exists(path)) return nullptr;
    Result<std::vector<std::byte>> bytes = read_file(path, cap_bytes_);
    if (!bytes) {
        refusal_ = bytes.error().message;
        return nullptr;
    }
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    if (text.starts_with("glTF") && !is_whole_glb(*bytes)) {
        refusal_ = std::string(path) + ": is a damaged .glb file; export it again";
        return nullptr;
    }
    return new MemoryFile(lower_case_extension(path) == ".mtl" ? extract_materials(std::move(*bytes))
                                                               : std::move(*bytes));
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

std::string single_line_error(const char* words) {
    std::string text = words;
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return printable(text);
}

Result<const aiScene*> post_process(Assimp::Importer& importer, unsigned steps, const std::string& file) {
    const aiScene* const model = importer.GetScene();
    if (model == nullptr) return model;
    RS_TRY(check_finite(*model, file));
    set_primitive_types(*model);
    return importer.ApplyPostProcessing(aiProcess_ValidateDataStructure | steps);
}

}  // namespace rs
