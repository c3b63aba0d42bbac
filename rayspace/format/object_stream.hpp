#pragma once
// Reads an .rso file while it arrives, in pieces of any size and from several places of the file: encode/FORMAT.md,
// "Reading". Each chunk is verified and parsed as soon as its last byte is there, and its bytes are freed. From
// has_maps() on, the object can be rendered as far as it has images. Not thread-safe.

#include "rayspace/format/container_index.hpp"
#include "rayspace/format/object_file.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rs {

class ObjectStream {
public:
    /// \param where       names the file in errors
    /// \param size_bytes  size of the file; nullopt if it is unknown
    /// \param options     `decode` is ignored: coded images stay coded; `max_level` is ignored, too
    ObjectStream(std::string where, std::optional<std::uint64_t> size_bytes, const ReadObjectOptions& options);
    ObjectStream(ObjectStream&&) noexcept;
    ObjectStream& operator=(ObjectStream&&) noexcept;
    ~ObjectStream();

    /// Takes the bytes of the file from `offset` on. The bytes of one chunk must arrive in order; the first ones are
    /// those of the table. Bytes of chunks that have arrived are skipped. After an error every call returns that error;
    /// what was read before stays valid.
    Status add(std::uint64_t offset, std::span<const std::byte> bytes);
    /// Checks that nothing is missing in a file that ended after `size_bytes`.
    [[nodiscard]] Status finish(std::uint64_t size_bytes) const;

    [[nodiscard]] bool has_table() const;
    /// True if everything but shape maps and images has been read and validated.
    [[nodiscard]] bool has_maps() const;
    [[nodiscard]] bool is_complete() const;

    /// The object as read so far. Coded images that arrive later are added to the object's `coded`, which copies of the
    /// object share. Requires has_maps().
    [[nodiscard]] const RaySpaceObject& object() const;
    /// Rings whose shape map, and views whose image, were read since the last call. Shape maps are read from the call
    /// after the first image's on.
    struct Arrivals {
        std::vector<std::uint32_t> shapes;
        std::vector<std::uint32_t> images;
    };
    Arrivals take_arrivals();
    /// Moves the shape map of a ring out of object().
    ShapeMap take_shape(std::uint32_t ring);
    /// Moves object() out of a complete stream.
    RaySpaceObject take_object();

    /// Header and table; empty before the header has arrived.
    [[nodiscard]] const ContainerIndex& index() const;
    /// True for entries of index().table() that are read, or that a reader skips.
    [[nodiscard]] bool has_arrived(std::size_t entry) const;
    /// End of the bytes that have arrived from `begin` on, the start of an incomplete table or chunk.
    [[nodiscard]] std::uint64_t arrived_from(std::uint64_t begin) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rs
