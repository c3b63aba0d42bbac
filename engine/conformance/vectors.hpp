#pragma once
// Conformance set: objects, views as registers, and hashes of the images that engine/RECONSTRUCTION.md defines. The
// file format is independent of this implementation: engine/conformance/PROTOCOL.md.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::engine {

inline constexpr int kVectorsVersion = 1;  // format version of vectors.json

struct ConformanceView {
    ViewRegisters registers;
    std::uint64_t rgba_hash = 0;   // XXH64 of the image: R, G, B, A bytes, rows from the top
    std::uint64_t depth_hash = 0;  // XXH64 of the axial depths, i32 little-endian q20
    int object_pixels = 0;         // alpha above 0
};

struct ConformanceCase {
    std::string name;    // letters, digits and '-'
    std::string covers;  // description, one sentence
    std::string object;  // file name in the folder
    std::vector<ConformanceView> views;
};

struct VectorSet {
    std::filesystem::path folder;
    std::string edition;  // changes with every change of the vectors
    std::vector<ConformanceCase> cases;
};

inline constexpr const char* kVectorsFile = "vectors.json";

/// Reads FOLDER/vectors.json (at most 64 MiB) and validates its names. run_vectors() reads the objects and validates
/// the registers.
Result<VectorSet> read_vectors(const std::filesystem::path& folder);

/// Writes FOLDER/vectors.json.
Status write_vectors(const VectorSet& set);

std::uint64_t hash_of(ConstImageView<Rgba8> image);
std::uint64_t hash_of(ConstImageView<std::int32_t> depth_q20);

/// 16 hexadecimal digits: "0123456789abcdef".
std::string hash_text(std::uint64_t hash);

}  // namespace rs::engine
