#pragma once
// Document of a binary glTF 2.0 file (GLB): the JSON and its one buffer. Not thread-safe.

#include "compositor/scene/mesh.hpp"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::compositor {

class GlbDocument {
public:
    /// JSON without the keys `asset`, `buffers`, `bufferViews`, `accessors` and `extensionsUsed`, which bytes() adds.
    nlohmann::json json = nlohmann::json::object();

    /// Appends an element to a list of the top level. \return its index
    std::size_t append(const char* list, nlohmann::json element);
    /// Lists an extension in `extensionsUsed`.
    void use_extension(const std::string& name);

    /// Adds data to the buffer. \return index of its buffer view
    std::size_t add_view(std::span<const std::byte> data, int target = 0);
    /// \return indices of accessors
    std::size_t add_positions(const std::vector<glm::vec3>& values);
    std::size_t add_vectors(const std::vector<glm::vec3>& values);
    std::size_t add_texture_places(const std::vector<glm::vec2>& values);
    std::size_t add_indices(const std::vector<std::uint32_t>& values);

    /// The file: header, JSON chunk and binary chunk. Names that are not UTF-8 get replacement characters.
    [[nodiscard]] std::vector<std::byte> bytes() const;

private:
    std::size_t add_accessor(std::span<const std::byte> data, int component, const char* type, std::size_t count,
                             int target);

    std::vector<std::byte> buffer_;
    nlohmann::json views_ = nlohmann::json::array();
    nlohmann::json accessors_ = nlohmann::json::array();
    std::vector<std::string> extensions_;
};

}  // namespace rs::compositor
