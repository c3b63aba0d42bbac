#pragma once
// Input and output conventions of a segmentation network: the JSON file beside the model (docs/segmentation.md, "The
// settings file").

#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace rs::capture {

/// Meaning of a network's output, per pixel.
enum class NetworkOutput {
    kProbability,  ///< of foreground, 0..1
    kLogits,       ///< any number; the probability is 1 / (1 + exp(-x))
    kMinMax,       ///< any number; the least of a photo becomes 0, the largest 1
};

/// The defaults are those of IS-Net (DIS): RGB, (x - 128) / 256, a probability.
struct NetworkSettings {
    int width = 0;  ///< px, of the network's input, kMinNetworkSide_px..kMaxNetworkSide_px; 0: as the model states
    int height = 0;
    /// Input = (code - mean) * scale, code 0..255; of red, green, blue, whatever order the network takes them in.
    glm::vec3 mean{128.0F};
    glm::vec3 scale{1.0F / 256};
    bool is_bgr = false;  ///< the network takes blue first
    NetworkOutput output = NetworkOutput::kProbability;
    std::string output_name;  ///< of the ONNX graph; empty: its first output
};

inline constexpr int kMinNetworkSide_px = 32;
inline constexpr int kMaxNetworkSide_px = 2048;

/// \param file its name, for errors ("FILE: FIELD: what is wrong; what to do").
/// \return an error for unknown keys and for values out of range. Pure; thread-safe.
Result<NetworkSettings> network_settings_from_json(std::string_view text, const std::string& file);

/// The settings file of a model: MODEL.onnx.json, or else MODEL.json; an empty path where neither exists.
std::filesystem::path network_settings_file(const std::filesystem::path& model);

/// Reads the settings file of a model; returns the defaults if there is none. At most 64 KiB are read. Thread-safe.
Result<NetworkSettings> read_network_settings(const std::filesystem::path& model);

}  // namespace rs::capture
