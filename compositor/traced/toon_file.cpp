#include "compositor/traced/toon_file.hpp"

#include "capture/tracer/scene/recipe_parts.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"

#include <cstdint>

namespace rs::compositor {

Result<capture::ToonStyle> toon_style_from_json(std::string_view text, const std::filesystem::path& path) {
    constexpr double kMaxDepth = 1e6;
    return read_json(text, path.string(), [](JsonObject& top) {
        capture::ToonStyle style;
        capture::read_toon_look(top, style, kMaxDepth);
        return style;
    });
}

Result<capture::ToonStyle> read_toon_style(const std::filesystem::path& path) {
    constexpr std::uint64_t kMaxToonFile_bytes = 1 << 20;
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxToonFile_bytes));
    return toon_style_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

}  // namespace rs::compositor
