#pragma once
// Restricts the files that Assimp may open and checks the scenes it returns, since model files are untrusted and Assimp
// does not validate them.

#include "rayspace/base/result.hpp"

#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <cstdint>
#include <string>

namespace rs {

/// File access for an Assimp::Importer, which takes ownership: regular files of at most cap_bytes, read as a whole and
/// recorded as inputs (input_file.hpp), never written. Text before the first newmtl of an MTL file is removed, since it
/// crashes Assimp. A .glb whose chunks exceed the file is rejected.
class ModelFiles : public Assimp::IOSystem {
public:
    explicit ModelFiles(std::uint64_t cap_bytes) : cap_bytes_(cap_bytes) {}

    bool Exists(const char* path) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* path, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

    /// Reason why the last existing file could not be opened; empty if all could.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }

private:
    std::uint64_t cap_bytes_;
    std::string refusal_;
};

/// Restricts `importer` to OBJ, glTF and GLB, and to the returned file access, which it owns. By default Assimp guesses
/// the format from a file's contents, so that all its readers can be reached. In files without normals, edges of more
/// than 60 degrees stay sharp.
ModelFiles& restrict_to_models(Assimp::Importer& importer, std::uint64_t cap_bytes);

/// Assimp's message in one line.
std::string single_line_error(const char* words);

/// Applies the aiProcess `steps` to the scene just read by `importer` without post-processing, and validates its
/// structure. Faces of two corners are marked as lines, which Assimp's OBJ reader omits. Vertices or texture
/// coordinates that are not finite are an error, since post-processing would merge them with their neighbours. `file`
/// names the scene in errors. Null if Assimp rejects it.
Result<const aiScene*> post_process(Assimp::Importer& importer, unsigned steps, const std::string& file);

}  // namespace rs
