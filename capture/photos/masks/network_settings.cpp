#include "capture/photos/masks/network_settings.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"

#include <cmath>
#include <system_error>

namespace rs::capture {
namespace {

constexpr std::uint64_t kMostSettings_bytes = std::uint64_t{64} << 10;
constexpr double kMostMean = 1e4;
constexpr double kMostScale = 1e3;

NetworkSettings take_settings(JsonObject& object) {
    NetworkSettings settings;
    if (object.has("width") != object.has("height")) throw object.wrong("give both width and height, or neither");
    object.read("width", settings.width, kMinNetworkSide_px, kMaxNetworkSide_px);
    object.read("height", settings.height, kMinNetworkSide_px, kMaxNetworkSide_px);
    object.read("mean", settings.mean, -kMostMean, kMostMean);
    object.read("scale", settings.scale, -kMostScale, kMostScale);
    for (int i = 0; i < 3; ++i) {
        if (settings.scale[i] == 0) throw object.take("scale").wrong("must not be 0; it multiplies code - mean");
    }
    if (const auto channels = object.find("channels")) settings.is_bgr = channels->one_of({"rgb", "bgr"}) == 1;
    if (const auto output = object.find("output")) {
        settings.output = static_cast<NetworkOutput>(output->one_of({"probability", "logits", "minmax"}));
    }
    if (const auto name = object.find("output_name")) settings.output_name = name->text();
    return settings;
}

}  // namespace

Result<NetworkSettings> network_settings_from_json(std::string_view text, const std::string& file) {
    return read_json(text, file, take_settings);
}

std::filesystem::path network_settings_file(const std::filesystem::path& model) {
    std::filesystem::path longer = model;
    longer += ".json";
    std::error_code failure;
    for (const std::filesystem::path& file : {longer, std::filesystem::path(model).replace_extension(".json")}) {
        if (file != model && std::filesystem::exists(file, failure)) return file;
    }
    return {};
}

Result<NetworkSettings> read_network_settings(const std::filesystem::path& model) {
    const std::filesystem::path file = network_settings_file(model);
    if (file.empty()) return NetworkSettings{};
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(file, kMostSettings_bytes));
    return network_settings_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace rs::capture
