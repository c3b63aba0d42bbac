#pragma once
// Header of a PLY file. Part of ply_file.
//
// Source: G. Turk, "The PLY Polygon File Format", 1994.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rs::capture {

enum class PlyScalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] constexpr bool is_integer(PlyScalar type) {
    return type != PlyScalar::float32 && type != PlyScalar::float64;
}

struct PlyProperty {
    std::string name;
    PlyScalar type = PlyScalar::float32;
    std::optional<PlyScalar> count_type;  // of a list
    [[nodiscard]] bool is_list() const { return count_type.has_value(); }
    // Returns true for the list of vertex indices of a face or strip.
    [[nodiscard]] bool is_vertex_list() const { return name == "vertex_indices" || name == "vertex_index"; }
};
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};
enum class PlyEncoding { ascii, little_endian, big_endian };
struct PlyHeader {
    std::optional<PlyEncoding> encoding;
    std::vector<PlyElement> elements;
    std::vector<std::string> texture_files;  // from "comment TextureFile NAME" lines
    std::size_t size_bytes = 0;
};

/// Parses the header. It must describe a mesh: `vertex` with scalars x, y and z, before exactly one of `face` and
/// `tristrips` with an integer list vertex_indices or vertex_index; element names must be unique.
/// \param points_allowed a file without faces is valid, too: a point cloud
/// \return the problem, or nothing
std::optional<std::string> parse_ply_header(std::string_view file, PlyHeader& header, bool points_allowed = false);

}  // namespace rs::capture
