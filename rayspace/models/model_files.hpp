#pragma once
// Restricts the files that Assimp may open and checks the scenes it returns, since model files are untrusted and Assimp
// does not validate them.

#include "rayspace/base/result.hpp"
#include "rayspace/models/mtl_text.hpp"
#include "rayspace/models/obj_text.hpp"

#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace rs {

/// File access for an Assimp::Importer, which takes ownership: regular files of at most cap_bytes, read as a whole and
/// recorded as inputs (input_file.hpp), never written. References are resolved by file_reference.hpp. Material
/// libraries are rewritten (mtl_text.hpp), byte order marks removed, glTF's extensions checked (gltf_extensions.hpp). A
/// .glb whose chunks exceed the file is rejected.
class ModelFiles : public Assimp::IOSystem {
public:
    explicit ModelFiles(std::uint64_t cap_bytes) : cap_bytes_(cap_bytes) {}

    bool Exists(const char* path) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* path, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

    /// Reason why the last existing file could not be opened; empty if all could.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }
    /// Ignored contents of the files read.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    /// Adds a warning for what the OBJ named and Assimp skipped: libraries that do not exist, materials that none
    /// defines, free-form curves and surfaces. To be called when all files are read.
    void report_skipped_names();
    /// Placements in the material libraries read, by material.
    [[nodiscard]] const std::map<std::string, TexturePlacement>& placements() const { return placements_; }

private:
    Result<std::vector<std::byte>> read(const std::filesystem::path& path);

    void warn(std::string warning);

    std::uint64_t cap_bytes_;
    std::filesystem::path obj_;
    ObjNames obj_names_;
    std::set<std::string> materials_;  // of all libraries
    std::string refusal_;
    std::vector<std::string> warnings_;
    std::map<std::string, TexturePlacement> placements_;
};

/// Restricts `importer` to OBJ, glTF and GLB, and to the returned file access, which it owns. By default Assimp guesses
/// the format from a file's contents, so that all its readers can be reached. In files without normals, edges of more
/// than 60 degrees stay sharp.
ModelFiles& restrict_to_models(Assimp::Importer& importer, std::uint64_t cap_bytes);

/// Reason why Assimp cannot read `file`: its message in one line, or for OBJ the line of a bad index.
std::string reading_error(const char* message, const std::filesystem::path& file);

/// Applies the aiProcess `steps` to the scene just read by `importer` without post-processing, and validates its
/// structure. Texture coordinates are transformed as the materials say (KHR_texture_transform, MTL's -s and -o). Faces
/// of two corners are marked as lines, which Assimp's OBJ reader omits. Vertices or texture coordinates that are not
/// finite are an error, since post-processing would merge them with their neighbours. `file` names the scene in errors.
/// Null if Assimp rejects it.
Result<const aiScene*> post_process(Assimp::Importer& importer, unsigned steps, const std::string& file);

}  // namespace rs
