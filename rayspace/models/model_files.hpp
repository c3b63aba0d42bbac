#pragma once
// What Assimp may open, and what it may give: models are outside bytes, and the library trusts them.

#include "rayspace/base/result.hpp"

#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <cstdint>
#include <string>

namespace rs {

// Files of a model for an Assimp::Importer, which takes it over: regular files of at most cap_bytes, read whole and
// noted as inputs (input_file.hpp), never written. Of an MTL what stands before its first newmtl is left out, which
// Assimp does not survive. A .glb whose chunks are longer than the file is refused.
class ModelFiles : public Assimp::IOSystem {
public:
    explicit ModelFiles(std::uint64_t cap_bytes) : cap_bytes_(cap_bytes) {}

    bool Exists(const char* path) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* path, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

    // Why the last file that is there could not be opened; empty where all could.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }

private:
    std::uint64_t cap_bytes_;
    std::string refusal_;
};

// Lets `importer` read OBJ, PLY, glTF and GLB alone, through the files that are returned, which it takes over. Without
// it Assimp goes by what a file's contents resemble, and all its readers are open to them.
ModelFiles& read_models_only(Assimp::Importer& importer, std::uint64_t cap_bytes);

// Assimp's words in one line.
std::string shown_error(const char* words);

// Faces of two corners are lines, as Assimp's OBJ reader does not say; with it they pass
// aiProcess_ValidateDataStructure. `model` is what an importer has just read.
void note_lines(const aiScene& model);

// An error where a vertex or a texture coordinate of `model` is not finite; `file` names it.
Status check_finite(const aiScene& model, const std::string& file);

}  // namespace rs
