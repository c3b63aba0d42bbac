#include "compositor/scene/export/glb_document.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

namespace rs::compositor {
namespace {

static_assert(std::endian::native == std::endian::little, "GLB is little-endian");

// Constants of OpenGL that glTF uses.
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

constexpr std::uint32_t kGlbMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kAlignment = 4;

void append_words(std::vector<std::byte>& file, std::initializer_list<std::uint32_t> words) {
    for (const std::uint32_t word : words) {
        const auto bytes = std::as_bytes(std::span(&word, 1));
        file.insert(file.end(), bytes.begin(), bytes.end());
    }
}

std::size_t padded(std::size_t size_bytes) {
    return (size_bytes + kAlignment - 1) / kAlignment * kAlignment;
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

}  // namespace

std::size_t GlbDocument::append(const char* list, nlohmann::json element) {
    nlohmann::json& elements = json[list];
    elements.push_back(std::move(element));
    return elements.size() - 1;
}

void GlbDocument::use_extension(const std::string& name) {
    if (std::ranges::find(extensions_, name) == extensions_.end()) extensions_.push_back(name);
}

std::size_t GlbDocument::add_view(std::span<const std::byte> data, int target) {
    buffer_.resize(padded(buffer_.size()));
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", data.size()}};
    if (target != 0) view["target"] = target;
    views_.push_back(std::move(view));
    buffer_.insert(buffer_.end(), data.begin(), data.end());
    return views_.size() - 1;
}

std::size_t GlbDocument::add_accessor(std::span<const std::byte> data, int component, const char* type,
                                      std::size_t count, int target) {
    accessors_.push_back(
        {{"bufferView", add_view(data, target)}, {"componentType", component}, {"type", type}, {"count", count}});
    return accessors_.size() - 1;
}

std::size_t GlbDocument::add_positions(const std::vector<glm::vec3>& values) {
    const std::size_t index = add_vectors(values);
    glm::vec3 lowest = values.front();
    glm::vec3 highest = values.front();
    for (const glm::vec3& p : values) {
        lowest = glm::min(lowest, p);
        highest = glm::max(highest, p);
    }
    accessors_[index]["min"] = {lowest.x, lowest.y, lowest.z};
    accessors_[index]["max"] = {highest.x, highest.y, highest.z};
    return index;
}

std::size_t GlbDocument::add_vectors(const std::vector<glm::vec3>& values) {
    return add_accessor(bytes_of(values), kFloat, "VEC3", values.size(), kArrayBuffer);
}

std::size_t GlbDocument::add_texture_places(const std::vector<glm::vec2>& values) {
    return add_accessor(bytes_of(values), kFloat, "VEC2", values.size(), kArrayBuffer);
}

std::size_t GlbDocument::add_indices(const std::vector<std::uint32_t>& values) {
    // The largest value of a type is not an index: it restarts primitives.
    if (*std::ranges::max_element(values) >= 0xFFFF) {
        return add_accessor(bytes_of(values), kUnsignedInt, "SCALAR", values.size(), kElementArrayBuffer);
    }
    std::vector<std::uint16_t> narrow;
    std::ranges::transform(values, std::back_inserter(narrow), [](std::uint32_t i) { return std::uint16_t(i); });
    return add_accessor(bytes_of(narrow), kUnsignedShort, "SCALAR", narrow.size(), kElementArrayBuffer);
}

std::vector<std::byte> GlbDocument::bytes() const {
    nlohmann::json whole = json;
    whole["asset"] = {{"version", "2.0"}, {"generator", "rs-view"}};
    if (!extensions_.empty()) whole["extensionsUsed"] = extensions_;
    const std::size_t buffer_bytes = padded(buffer_.size());
    if (!buffer_.empty()) {
        whole["buffers"] = {{{"byteLength", buffer_bytes}}};
        whole["bufferViews"] = views_;
    }
    if (!accessors_.empty()) whole["accessors"] = accessors_;
    std::string text = whole.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.resize(padded(text.size()), ' ');
    std::vector<std::byte> file;
    const std::size_t binary_bytes = buffer_.empty() ? 0 : 8 + buffer_bytes;
    append_words(
        file, {kGlbMagic, 2, std::uint32_t(20 + text.size() + binary_bytes), std::uint32_t(text.size()), kJsonChunk});
    const auto text_bytes = std::as_bytes(std::span(text));
    file.insert(file.end(), text_bytes.begin(), text_bytes.end());
    if (buffer_.empty()) return file;
    append_words(file, {std::uint32_t(buffer_bytes), kBinaryChunk});
    file.insert(file.end(), buffer_.begin(), buffer_.end());
    file.resize(padded(file.size()));
    return file;
}

}  // namespace rs::compositor
