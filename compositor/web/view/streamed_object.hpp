#pragma once
// An object of a page while its file arrives. Reads the bytes (rayspace/format/object_stream.hpp), hands images and
// shape maps to the object's view, and selects what to request next. Not thread-safe.

#include "compositor/web/view/object_view.hpp"
#include "rayspace/format/object_stream.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rs::web {

/// Bytes [begin, end) of the file.
struct ByteRange {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    [[nodiscard]] bool empty() const { return begin >= end; }
    bool operator==(const ByteRange&) const = default;
};

class StreamedObject {
public:
    /// \param name        begins the messages of errors
    /// \param size_bytes  of the file; nullopt if it is unknown
    /// \param view        receives the view of the object as soon as its maps are there; outlives this object
    StreamedObject(const std::string& name, std::optional<std::uint64_t> size_bytes, std::optional<ObjectView>& view);

    /// Takes bytes of the file (ObjectStream::add). \return error also if the object cannot be rendered
    Status add(std::uint64_t offset, std::span<const std::byte> bytes);
    /// Checks that nothing is missing in a file that ended after `size_bytes`.
    [[nodiscard]] Status finish(std::uint64_t size_bytes) const { return stream_.finish(size_bytes); }

    [[nodiscard]] bool is_complete() const { return stream_.is_complete(); }
    /// True if at least one photo near the view is there.
    [[nodiscard]] bool can_render(const OrbitView& view) const;
    /// Photos that arrived since the last call.
    std::vector<std::uint32_t> take_new_photos();

    /// The range to request next; empty if there is none at present. In this order: table, geometry and RS maps; the
    /// photo nearest to the view of those with the lowest level, and no more until it is there; the photos that the
    /// view shows; those of the lowest level; the ring's shape map; the ring's other photos; other rings. Adjacent
    /// chunks are joined to ranges of some 256 KiB. \param requested  ranges that are being loaded
    [[nodiscard]] ByteRange next_range(const OrbitView& view, std::span<const ByteRange> requested) const;

private:
    Status show_arrivals();
    [[nodiscard]] std::vector<std::size_t> wanted_entries(const OrbitView& view) const;
    [[nodiscard]] ByteRange missing_bytes(std::size_t entry) const;

    ObjectStream stream_;
    std::optional<ObjectView>& view_;
    std::vector<std::uint32_t> new_photos_;
};

}  // namespace rs::web
