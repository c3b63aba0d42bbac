#include "engine/model/layout/object_image.hpp"

#include "engine/model/limits/coded_layout.hpp"

#include <algorithm>

namespace rs::engine::model {
namespace {

// Eight bytes per word, low byte first, zero-padded.
template <class Byte>
void append_bytes(std::span<const Byte> bytes, std::size_t words, std::vector<std::uint64_t>& out) {
    const std::size_t first = out.size();
    out.resize(first + words);
    for (std::size_t n = 0; n < std::min(bytes.size(), 8 * words); ++n) {
        out[first + n / 8] |= std::uint64_t{static_cast<std::uint8_t>(bytes[n])} << (8 * (n % 8));
    }
}

std::uint64_t reference_bytes(const codec::ImageHead& head) {
    const int count = head.references();
    const auto a = count > 0 ? head.reference[0] : std::uint16_t{kNoReferenceByte};
    const auto b = count > 1 ? head.reference[1] : a;
    return std::uint64_t{a} << 48U | std::uint64_t{b} << 56U;
}

void append_tile(const codec::CodedImage& image, std::size_t tile, int words, std::vector<std::uint64_t>& out) {
    const std::span<const std::byte> bytes = image.tile_bytes(tile);
    out.push_back(codec::board_tile_classes(bytes) | reference_bytes(image.head));
    append_bytes(bytes.subspan(std::min(bytes.size(), std::size_t{codec::kBoardTileHeadBytes})),
                 static_cast<std::size_t>(words) - 1, out);
}

void append_books(const codec::BoardCode& code, std::vector<std::uint64_t>& out) {
    const auto append = [&](const auto& book) { append_bytes(std::span(book), book.size() / 8, out); };
    for (const codec::Books& books : code.books) {
        for (const codec::Book& book : books.block) append(book);
        for (const codec::Book& book : books.quarter) append(book);
    }
    append(code.alpha);
}

BookCounts book_counts(const codec::BoardCode& code) {
    BookCounts counts;
    const auto used = [](const auto& books) {
        return static_cast<int>(std::count_if(books.begin(), books.end(), [](const auto& b) { return !b.empty(); }));
    };
    for (std::size_t set = 0; set < 2; ++set) {
        counts.block[set] = used(code.books[set].block);
        counts.quarter[set] = used(code.books[set].quarter);
    }
    counts.alpha = !code.alpha.empty();
    return counts;
}

}  // namespace

Status has_board_images(const RaySpaceObject& object) {
    const std::string remedy =
        "; encode it with --profile board, or use prototype-2000, which holds images of "
        "--profile raw";
    if (object.coded == nullptr) {
        return Error{object.name +
                     ": its images are not compressed, but compressed-2000 holds images of profile "
                     "board" +
                     remedy};
    }
    if (object.coded->profile != codec::Profile::kBoard) {
        return Error{object.name + ": its images are of profile " + codec::name_of(object.coded->profile) +
                     ", but compressed-2000 decodes images of profile board" + remedy};
    }
    const std::vector<codec::CodedImage>& images = object.coded->images;
    if (images.size() != object.views.size() ||
        std::any_of(images.begin(), images.end(), [](const codec::CodedImage& p) { return !p.loaded(); })) {
        return Error{object.name + ": not all of its images are loaded; read it at its full level"};
    }
    return {};
}

std::array<std::uint64_t, kObjectRegions> coded_words(const codec::CodedImages& coded) {
    return {image_words(coded, false), image_words(coded, true), tile_table_words(coded), book_words(coded.board)};
}

void add_coded_images(const codec::CodedImages& coded, const Placement& placement, WordAddress books,
                      ObjectRegisters& r, std::vector<MemorySegment>& segments) {
    const auto at = [&](Region region) { return placement.first[static_cast<std::size_t>(region)]; };
    r.coded_width = coded.coded_width();
    r.coded_height = coded.coded_height();
    r.tile_columns = coded.tile_columns();
    r.table_pitch = tile_table_pitch(coded.tile_rows());
    r.tile_table = at(Region::tile_table);
    r.books = books;
    r.book_words = static_cast<std::uint32_t>(book_words(coded.board));
    r.book_counts = book_counts(coded.board);
    r.classes = coded.board.classes;

    MemorySegment flat{at(Region::flat_tiles), {}};
    MemorySegment predicted{at(Region::predicted_tiles), {}};
    MemorySegment table{r.tile_table, {}};
    for (const codec::CodedImage& image : coded.images) {
        MemorySegment& into = image.head.references() > 0 ? predicted : flat;
        for (int column = 0; column < coded.tile_columns(); ++column) {
            std::uint64_t two = 0;
            for (int row = 0; row < r.table_pitch; ++row) {
                std::uint32_t entry = kNoTile;
                const auto tile = static_cast<std::size_t>(row * coded.tile_columns() + column);
                const int words = row < coded.tile_rows() ? tile_words(coded, image, tile) : 0;
                if (words > 0) {
                    entry = into.address + static_cast<WordAddress>(into.words.size());
                    append_tile(image, tile, words, into.words);
                }
                two |= std::uint64_t{entry} << (row % 2 * 32);
                if (row % 2 == 1) {
                    table.words.push_back(two);
                    two = 0;
                }
            }
        }
    }
    MemorySegment all_books{books, {}};
    append_books(coded.board, all_books.words);
    for (MemorySegment* segment : {&table, &flat, &predicted, &all_books}) {
        if (!segment->words.empty()) segments.push_back(std::move(*segment));
    }
}

}  // namespace rs::engine::model
