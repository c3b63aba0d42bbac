#include "rayspace/models/gltf_extensions.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/file/input_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

namespace rs {
namespace {

using nlohmann::json;

constexpr std::size_t kGlbHeader_bytes = 12, kChunkHeader_bytes = 8;

// Extensions whose contents are used, by Assimp or by the readers of nodes and materials.
constexpr std::array<std::string_view, 10> kSupported = {"EXT_texture_webp",
                                                         "KHR_draco_mesh_compression",
                                                         "KHR_lights_punctual",
                                                         "KHR_materials_ior",
                                                         "KHR_materials_transmission",
                                                         "KHR_materials_pbrSpecularGlossiness",
                                                         "KHR_materials_unlit",
                                                         "KHR_texture_transform",
                                                         "KHR_xmp_json_ld",
                                                         "KHR_xmp"};

bool is_glb(std::string_view bytes) {
    return bytes.starts_with("glTF");
}

// Checks a .glb (glTF 2.0, 4.4; version 1.0 has its JSON's length at the same place), since Assimp allocates a chunk's
// stated length before it checks the file's size.
bool is_whole_glb(std::span<const std::byte> bytes) {
    std::size_t at = kGlbHeader_bytes;
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

const json& array_of(const json& parent, std::string_view key) {
    static const json kNone = json::array();
    const auto found = parent.is_object() ? parent.find(key) : parent.end();
    return found != parent.end() && found->is_array() ? *found : kNone;
}

std::vector<std::string> names(const json& top, const char* key) {
    std::vector<std::string> result;
    for (const json& name : array_of(top, key)) {
        if (name.is_string()) result.push_back(name.get<std::string>());
    }
    return result;
}

struct IgnoredContent {
    std::string_view key;  // of an array, at the top or in primitives
    std::string_view warning;
};
constexpr std::array<IgnoredContent, 3> kIgnoredContents = {
    {{"animations", "animations are not played"},
     {"skins", "skins are ignored; meshes are shown as modeled, without their skeletons"},
     {"targets", "morph targets are ignored"}}};

bool mentions(std::string_view text, std::string_view key) {
    return text.find("\"" + std::string(key) + "\"") != std::string_view::npos;
}

bool has_content(const json& top, std::string_view key) {
    const auto has_own = [&](const json& parent) { return !array_of(parent, key).empty(); };
    return has_own(top) || std::ranges::any_of(array_of(top, "meshes"), [&](const json& mesh) {
               return std::ranges::any_of(array_of(mesh, "primitives"), has_own);
           });
}

bool is_supported(const std::string& extension) {
    return std::ranges::find(kSupported, extension) != kSupported.end();
}

// Moves the source of EXT_texture_webp to the texture itself. Returns false if there is none.
bool use_webp_sources(json& top) {
    bool changed = false;
    if (!top.is_object() || !top.contains("textures") || !top["textures"].is_array()) return false;
    for (json& texture : top["textures"]) {
        constexpr const char* kSource = "/extensions/EXT_texture_webp/source";
        const json::json_pointer place(kSource);
        if (!texture.is_object() || !texture.contains(place)) continue;
        texture["source"] = texture[place];
        changed = true;
    }
    return changed;
}

void append(std::vector<std::byte>& bytes, std::string_view text) {
    const auto* const first = reinterpret_cast<const std::byte*>(text.data());
    bytes.insert(bytes.end(), first, first + text.size());
}

void append_number(std::vector<std::byte>& bytes, std::size_t number) {
    const auto value = static_cast<std::uint32_t>(number);
    append(bytes, {reinterpret_cast<const char*>(&value), sizeof value});
}

// Replaces the JSON chunk, padded with spaces to a multiple of 4.
std::vector<std::byte> glb_with_json(const std::vector<std::byte>& glb, std::size_t old_length, std::string text) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t rest = kGlbHeader_bytes + kChunkHeader_bytes + old_length;
    std::vector<std::byte> result(glb.begin(), glb.begin() + 8);
    append_number(result, glb.size() - old_length + text.size());
    append_number(result, text.size());
    result.insert(result.end(), glb.begin() + 16, glb.begin() + 20);
    append(result, text);
    result.insert(result.end(), glb.begin() + static_cast<std::ptrdiff_t>(rest), glb.end());
    return result;
}

}  // namespace

std::span<const std::string_view> supported_gltf_extensions() {
    return kSupported;
}

std::vector<std::string> ignored_gltf_contents() {
    std::vector<std::string> keys;
    for (const IgnoredContent& content : kIgnoredContents) keys.emplace_back(content.key);
    return keys;
}

Result<std::string> gltf_json(std::string_view bytes, const std::string& file) {
    bytes = without_byte_order_mark(bytes);
    if (!is_glb(bytes)) return std::string(bytes);
    std::uint32_t length = 0;
    constexpr std::size_t kStart = kGlbHeader_bytes + kChunkHeader_bytes;
    if (bytes.size() >= kStart) std::memcpy(&length, bytes.data() + kGlbHeader_bytes, sizeof length);
    if (bytes.size() < kStart || length > bytes.size() - kStart || bytes.substr(16, 4) != "JSON") {
        return Error{file + ": is a damaged .glb file; export it again"};
    }
    return std::string(bytes.substr(kStart, length));
}

Result<GltfFile> prepare_gltf(std::vector<std::byte> bytes, const std::string& file) {
    const std::string_view view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    RS_ASSIGN_OR_RETURN(std::string text, gltf_json(view, file));
    GltfFile result;
    const bool glb = is_glb(view);
    if (glb && !is_whole_glb(bytes)) return Error{file + ": is a damaged .glb file; export it again"};
    if (mentions(text, "1.0") || mentions(text, "1.1")) {
        RS_ASSIGN_OR_RETURN(const json top, parse_json(text, file));
        const json::json_pointer place("/asset/version");
        if (top.contains(place) && (top[place] == "1.0" || top[place] == "1.1")) {
            return Error{file + ": is of glTF 1; convert it to glTF 2.0"};
        }
    }
    const bool has_ignored = std::ranges::any_of(
        kIgnoredContents, [&](const IgnoredContent& content) { return mentions(text, content.key); });
    if (has_ignored || mentions(text, "extensionsUsed") || mentions(text, "extensionsRequired")) {
        RS_ASSIGN_OR_RETURN(json top, parse_json(text, file));
        for (const IgnoredContent& content : kIgnoredContents) {
            if (has_content(top, content.key)) result.warnings.push_back(file + ": " + std::string(content.warning));
        }
        for (const std::string& name : names(top, "extensionsRequired")) {
            if (is_supported(name)) continue;
            return Error{file + ": requires the glTF extension " + name.substr(0, 80) +
                         ", which is not supported; export it without"};
        }
        for (const std::string& name : names(top, "extensionsUsed")) {
            if (is_supported(name)) continue;
            result.warnings.push_back(file + ": the glTF extension " + name.substr(0, 80) +
                                      " is not supported; shown without");
        }
        if (use_webp_sources(top)) {
            const std::size_t old_length = text.size();
            text = top.dump();
            if (glb) {
                result.bytes = glb_with_json(bytes, old_length, std::move(text));
                return result;
            }
        }
    }
    if (glb) {
        result.bytes = std::move(bytes);
    } else {
        append(result.bytes, text);
    }
    return result;
}

}  // namespace rs
