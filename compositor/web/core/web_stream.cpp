// C interface of the WebAssembly module for objects that are shown while they arrive. Offsets and sizes of files are
// doubles, which JavaScript has; conventions as in web_core.cpp. The object that arrives takes the place of the one
// opened before.

#include "compositor/web/core/web_core.hpp"
#include "compositor/web/view/streamed_object.hpp"

#include <span>
#include <vector>

namespace rs::web {
namespace {

std::optional<StreamedObject> streamed;
std::vector<double> stream_numbers;

}  // namespace
}  // namespace rs::web

using namespace rs::web;

/// Begins a file of `size_bytes`, negative if unknown. `name` begins the messages of errors.
WEB_EXPORT void web_stream_begin(const char* name, double size_bytes) {
    const auto size = size_bytes >= 0 ? std::optional(static_cast<std::uint64_t>(size_bytes)) : std::nullopt;
    close_object();
    streamed.emplace(name, size, opened_view());
}

/// Takes bytes of the file from `offset` on. \return 1 on success
WEB_EXPORT int web_stream_add(const std::byte* bytes, std::size_t size_bytes, double offset) {
    return succeeded(streamed->add(static_cast<std::uint64_t>(offset), {bytes, size_bytes})) ? 1 : 0;
}

/// Checks that a file that ended after `size_bytes` is complete. \return 1 on success
WEB_EXPORT int web_stream_finish(double size_bytes) {
    return succeeded(streamed->finish(static_cast<std::uint64_t>(size_bytes))) ? 1 : 0;
}

/// State after the last web_stream_add(): 1 if the object can be described; 1 if it is complete; the number of photos
/// that arrived since the last call, and their views.
WEB_EXPORT const double* web_stream_state() {
    const std::vector<std::uint32_t> photos = streamed->take_new_photos();
    stream_numbers = {opened_view() ? 1.0 : 0.0, streamed->is_complete() ? 1.0 : 0.0, double(photos.size())};
    stream_numbers.insert(stream_numbers.end(), photos.begin(), photos.end());
    return stream_numbers.data();
}

/// Selects what to request next for a view. \param requested  begin and end of `count` ranges that are being loaded
/// \return 1 if the view can be rendered; begin and end of the next range, equal if there is none at present
WEB_EXPORT const double* web_stream_next(int width, int height, double azimuth_rad, double elevation_rad,
                                         double distance, const double* requested, std::size_t count) {
    const OrbitView view{width, height, azimuth_rad, elevation_rad, distance};
    std::vector<ByteRange> ranges;
    for (std::size_t i = 0; i < count; ++i) {
        ranges.push_back(
            {static_cast<std::uint64_t>(requested[2 * i]), static_cast<std::uint64_t>(requested[2 * i + 1])});
    }
    const ByteRange next = streamed->next_range(view, ranges);
    stream_numbers = {streamed->can_render(view) ? 1.0 : 0.0, double(next.begin), double(next.end)};
    return stream_numbers.data();
}
