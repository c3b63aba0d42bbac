#include "compositor/scene/reader/vrml_file.hpp"

#include "compositor/scene/vrml/flatten.hpp"
#include "compositor/scene/vrml1/graph.hpp"
#include "compositor/scene/x3d/xml_text.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/file_reference.hpp"
#include "rayspace/file/input_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace rs::compositor {
namespace {

// In-memory gzip (RFC 1952) decompression. Pure; thread-safe.
struct Inflater {
    z_stream stream{};
    bool ready = false;

    Inflater() { ready = inflateInit2(&stream, 15 + 16) == Z_OK; }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() {
        if (ready) inflateEnd(&stream);
    }
};

bool is_gzip(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b};
}

Result<std::string> gunzip(std::span<const std::byte> bytes, std::uint64_t cap_bytes, const std::string& file) {
    const Error damaged{file + ": is a damaged or truncated gzip file; get it again"};
    Inflater inflater;
    if (!inflater.ready || bytes.size() > std::numeric_limits<uInt>::max()) return damaged;
    z_stream& stream = inflater.stream;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string text;
    std::array<char, 1 << 16> block{};
    while (true) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        const int state = inflate(&stream, Z_NO_FLUSH);
        if (state != Z_OK && state != Z_STREAM_END) return damaged;
        text.append(block.data(), block.size() - stream.avail_out);
        if (text.size() > cap_bytes) {
            return Error{file + ": unpacks to more than " + std::to_string(cap_bytes >> 20) + " MiB; make it smaller"};
        }
        if (state != Z_STREAM_END) continue;
        if (stream.avail_in == 0) return text;
        if (inflateReset(&stream) != Z_OK) return damaged;
    }
}

constexpr std::uint64_t kMaxWorld_bytes = std::uint64_t{64} << 20;
constexpr std::uint64_t kMaxFiles_bytes = std::uint64_t{256} << 20;

Result<std::string> read_world_text(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(path, kMaxWorld_bytes));
    if (is_gzip(bytes)) return gunzip(bytes, kMaxWorld_bytes, path.string());
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// Selects the parser by the beginning of the text.
Result<vrml::Graph> graph_of(std::string_view text, const std::string& file) {
    text = without_byte_order_mark(text);
    if (text.starts_with(vrml1::kHeader)) return vrml1::read_graph(text, file);
    if (!x3d::is_xml(text)) return vrml::read_graph(text, file);
    RS_ASSIGN_OR_RETURN(const std::string classic, x3d::classic_text(text, file));
    return vrml::read_headless_graph(classic, file);
}

Result<std::shared_ptr<const vrml::LoadedFile>> load_text(std::string_view text, const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(vrml::Graph graph, graph_of(text, path.string()));
    return std::shared_ptr<const vrml::LoadedFile>(
        std::make_shared<vrml::LoadedFile>(vrml::LoadedFile{path, std::move(graph)}));
}

// Reads each included file once.
class IncludedFiles {
public:
    Result<std::shared_ptr<const vrml::LoadedFile>> load(const std::vector<std::string>& urls,
                                                         const std::filesystem::path& folder) {
        Error fault{"names no file"};
        for (const std::string& url : urls) {
            const auto path = resolve_reference(url, folder);
            if (!path) {
                fault = {"'" + url.substr(0, 80) + "' is not a local file"};
                continue;
            }
            auto known = loaded_.find(*path);
            if (known == loaded_.end()) known = loaded_.emplace(*path, load_new(*path)).first;
            if (known->second) return known->second;
            fault = known->second.error();
        }
        return fault;
    }

private:
    Result<std::shared_ptr<const vrml::LoadedFile>> load_new(const std::filesystem::path& path) {
        RS_ASSIGN_OR_RETURN(const std::string text, read_world_text(path));
        size_bytes_ += text.size();
        if (size_bytes_ > kMaxFiles_bytes) {
            return Error{path.string() + ": the included files are larger than " +
                         std::to_string(kMaxFiles_bytes >> 20) + " MiB together"};
        }
        return load_text(text, path);
    }

    std::map<std::filesystem::path, Result<std::shared_ptr<const vrml::LoadedFile>>> loaded_;
    std::uint64_t size_bytes_ = 0;
};

}  // namespace

Result<Scene> scene_from_vrml(std::string_view text, const std::filesystem::path& path) {
    // Normalised like the paths of included files, to detect files that include themselves.
    RS_ASSIGN_OR_RETURN(const auto file, load_text(text, path.lexically_normal()));
    Scene scene;
    scene.lights.clear();
    scene.background.sky = {glm::vec3(0)};
    scene.navigation.headlight = true;
    IncludedFiles included;
    RS_TRY(vrml::flatten(
        file, [&](const auto& urls, const auto& folder) { return included.load(urls, folder); }, scene));
    return scene;
}

Result<Scene> read_vrml(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const std::string text, read_world_text(path));
    return scene_from_vrml(text, path);
}

}  // namespace rs::compositor
