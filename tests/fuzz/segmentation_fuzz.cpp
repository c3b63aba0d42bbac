#include "capture/photos/masks/network_settings.hpp"
#include "capture/photos/masks/onnx_summary.hpp"
#include "rayspace/api/types/check.hpp"
#include "tests/fuzz/entries.hpp"

#include <cmath>
#include <span>
#include <string_view>

namespace rs::fuzz {
namespace {

void check_one_line(const std::string& message) {
    RS_CHECK(message.find('\n') == std::string::npos);
    RS_CHECK(message.rfind("input: ", 0) == 0);
}

}  // namespace

int fuzz_network_settings(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto settings = capture::network_settings_from_json(text, "input");
    if (!settings) {
        check_one_line(settings.error().message);
        return 0;
    }
    RS_CHECK((settings->width == 0) == (settings->height == 0));
    for (const int side : {settings->width, settings->height}) {
        RS_CHECK(side == 0 || (side >= capture::kMinNetworkSide_px && side <= capture::kMaxNetworkSide_px));
    }
    for (int i = 0; i < 3; ++i) {
        RS_CHECK(std::isfinite(settings->mean[i]) && std::isfinite(settings->scale[i]) && settings->scale[i] != 0);
    }
    return 0;
}

int fuzz_onnx(const std::uint8_t* data, std::size_t size) {
    const auto summary = capture::read_onnx_summary(std::as_bytes(std::span(data, size)), "input");
    if (!summary) {
        check_one_line(summary.error().message);
        return 0;
    }
    for (const auto& values : {summary->inputs, summary->outputs}) {
        RS_CHECK(values.size() <= capture::kMaxOnnxValues);
        for (const auto& value : values) {
            for (const std::int64_t side : value.shape) RS_CHECK(side == -1 || side > 0);
        }
    }
    return 0;
}

}  // namespace rs::fuzz
