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

// Lets `importer` read OBJ, glTF and GLB alone, through the files that are returned, which it takes over. Without
// it Assimp goes by what a file's contents resemble, and all its readers are open to them. Where a file has no normals,
// edges of more than 60 degrees stay sharp.
ModelFiles& read_models_only(Assimp::Importer& importer, std::uint64_t cap_bytes);

// Assimp's words in one line.
std::string shown_error(const char* words);

// What `importer` has just read, without post-processing, after the aiProcess `steps`; null where Assimp refuses it.
// Its structure is validated, faces of two corners are lines (which its OBJ reader does not report), and a vertex or a
// texture coordinate that is not finite is an error, which steps would merge with its neighbours; `file` names it.
Result<const aiScene*> post_processed(Assimp::Importer& importer, unsigned steps, const std::string& file);

}  // namespace rs
