#include "compositor/sharing/shared_view.hpp"
#include "rayspace/api/types/check.hpp"
#include "tests/fuzz/entries.hpp"

#include <algorithm>

namespace rs::fuzz {
namespace {

constexpr std::uint64_t kSceneOfCorpus = 0x0123456789abcdef;

}  // namespace

// The result must not depend on how the stream is split, and views must survive a round trip.
int fuzz_sharing(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
    compositor::SharedViewReader whole(kSceneOfCorpus);
    const Status read = whole.take(bytes);
    if (!read) RS_CHECK(read.error().message.find('\n') == std::string::npos);
    compositor::SharedViewReader in_parts(kSceneOfCorpus);
    Status read_in_parts;
    constexpr std::size_t kPart_bytes = 61;
    for (std::size_t at = 0; read_in_parts && at < size; at += kPart_bytes) {
        read_in_parts = in_parts.take(bytes.subspan(at, std::min(kPart_bytes, size - at)));
    }
    RS_CHECK(read.ok() == read_in_parts.ok());
    const auto view = whole.take_view();
    const auto same_view = in_parts.take_view();
    RS_CHECK(view.has_value() == same_view.has_value() && whole.take_lights() == in_parts.take_lights());
    if (!view) return 0;
    const std::vector<std::byte> written = compositor::view_message(*view, kSceneOfCorpus);
    RS_CHECK(written == compositor::view_message(*same_view, kSceneOfCorpus));
    compositor::SharedViewReader again(kSceneOfCorpus);
    RS_CHECK(again.take(written).ok() && again.take_view().has_value());
    return 0;
}

}  // namespace rs::fuzz
