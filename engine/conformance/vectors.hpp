#pragma once
// The conformance set: objects, views as registers, and hashes of the pictures that engine/RECONSTRUCTION.md makes of
// them. A folder of files that any implementation can read: engine/conformance/PROTOCOL.md.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::engine {

inline constexpr int kVectorsVersion = 1;  // of the form of vectors.json

struct ConformanceView {
    ViewRegisters registers;
    std::uint64_t rgba_hash = 0;   // XXH64 of the picture: R, G, B, A bytes, rows from the top
    std::uint64_t depth_hash = 0;  // of the axial depths, i32 little-endian q20
    int object_pixels = 0;         // with alpha above 0
};

struct ConformanceCase {
    std::string name;    // letters, digits and '-'
    std::string covers;  // a sentence
    std::string object;  // file in the folder
    std::vector<ConformanceView> views;
};

struct VectorSet {
    std::filesystem::path folder;
    std::string edition;  // of the vectors themselves; changes with any of them
    std::vector<ConformanceCase> cases;
};

inline constexpr const char* kVectorsFile = "vectors.json";

// Reads FOLDER/vectors.json and checks its names; objects are read, and registers checked against them, by
// run_vectors(). Cap: 64 MiB.
Result<VectorSet> read_vectors(const std::filesystem::path& folder);

// Writes FOLDER/vectors.json.
Status write_vectors(const VectorSet& set);

std::uint64_t hash_of(ConstImageView<Rgba8> picture);
std::uint64_t hash_of(ConstImageView<std::int32_t> depth_q20);

// "0123456789abcdef"
std::string hash_text(std::uint64_t hash);

}  // namespace rs::engine
