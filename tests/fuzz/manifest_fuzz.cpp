#include "compositor/farm/schedule/manifest.hpp"
#include "rayspace/base/check.hpp"
#include "rayspace/file/input_list.hpp"
#include "tests/fuzz/entries.hpp"

#include <string_view>

namespace rs::fuzz {

int fuzz_manifest(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto outcomes = farm::parse_manifest(text, "fuzz");
    if (outcomes) {
        for (const auto& [item, outcome] : *outcomes) {
            RS_CHECK(!farm::to_string(outcome.state).empty());
        }
    } else {
        RS_CHECK(outcomes.error().message.find('\n') == std::string::npos);
    }
    const auto stamps = parse_input_list(text, "fuzz");
    if (stamps) {
        // The list must survive a round trip.
        const auto again = parse_input_list(input_list_text(*stamps), "fuzz");
        RS_CHECK(again.ok() && *again == *stamps);
    } else {
        RS_CHECK(stamps.error().message.find('\n') == std::string::npos);
    }
    return 0;
}

}  // namespace rs::fuzz
