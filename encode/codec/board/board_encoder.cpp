#include "encode/codec/board/board_encoder.hpp"

#include "encode/codec/board/board_block.hpp"
#include "encode/codec/board/board_codebooks.hpp"
#include "encode/codec/motion_search.hpp"
#include "encode/codec/ring_references.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/codec/board/board_profile.hpp"
#include "rayspace/codec/stream/decode_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rs::encode {
namespace {

using codec::BoardMotion;
using codec::RecordClass;

// Record classes, [0] being the empty block; chosen by experiments on captured objects. They are written into the file;
// decoders accept any classes. Members: predicted, alpha, block stages, quarter stages
constexpr std::array<codec::RecordClass, codec::kBoardClasses> kFlatClasses = {{{},
                                                                                {false, false, 1, 0},
                                                                                {false, false, 1, 1},
                                                                                {false, false, 1, 2},
                                                                                {false, false, 1, 4},
                                                                                {false, true, 1, 1},
                                                                                {false, true, 1, 2},
                                                                                {false, true, 1, 4}}};
constexpr std::array<codec::RecordClass, codec::kBoardClasses> kPredictedClasses = {{{},
                                                                                     {true, false, 2, 0},
                                                                                     {true, false, 2, 1},
                                                                                     {true, false, 2, 2},
                                                                                     {true, false, 2, 3},
                                                                                     {true, true, 2, 1},
                                                                                     {true, true, 2, 2},
                                                                                     {false, true, 1, 1}}};

constexpr std::size_t kTrainingBlocks = 24000;  // per kind, at most
constexpr int kReachDown_px = 6;

enum class Cover : std::uint8_t { kEmpty, kMixed, kFull };

struct Block {
    Cover cover = Cover::kEmpty;
    BoardMotion motion;
    bool has_motion = false;
};

struct BoardWorkImage {
    codec::Planes reconstruction;
    std::array<int, 2> reach_px = {0, 0};
    std::vector<Block> blocks;  // row by row, of the coded size
};

class BoardEncoder {
public:
    BoardEncoder(const RaySpaceObject& object, const std::vector<SourceImage>& sources, const BoardSettings& settings,
                 Progress* progress)
        : object_(object), sources_(sources), settings_(settings), progress_(progress), work_(object.views.size()) {
        coded_.profile = codec::Profile::kBoard;
        coded_.width = object.width;
        coded_.height = object.height;
        coded_.tile_width_log2 = codec::kBoardTileLog2;
        coded_.tile_height_log2 = codec::kBoardTileLog2;
        coded_.board.classes = {kFlatClasses, kPredictedClasses};
        coded_.levels.assign(object.views.size(), 0);
        coded_.images.resize(object.views.size());
        lambda_ = settings.lambda_factor * kIntegerPlaneWeights[0] * settings.step * settings.step * 8;
        plan();
        for_images([](std::size_t) { return true; }, [&](std::size_t v) { classify_blocks(v); });
    }

    EncodedImages encode() {
        alpha_ = train_alpha(sources_, settings_.alpha_bits);
        coded_.board.alpha = alpha_.samples;
        const auto is_reference = [&](std::size_t v) { return coded_.images[v].head.references() == 0; };
        const auto is_predicted = [&](std::size_t v) { return !is_reference(v); };
        if (progress_ != nullptr) {  // two steps per predicted image: motion and records
            const auto head_is = [](const codec::CodedImage& image) { return image.head.references() == 0; };
            const auto references = std::count_if(coded_.images.begin(), coded_.images.end(), head_is);
            progress_->start("encoding", 2 * static_cast<std::int64_t>(work_.size()) - references);
        }

        books_[0] = train(is_reference, false, 1, 4);
        coded_.board.books[0] = pack_codebooks(books_[0]);
        for_images(is_reference, [&](std::size_t v) { encode_image(v); });

        for_images(is_predicted, [&](std::size_t v) {
            find_motions(v);
            advance();
        });
        books_[1] = train(is_predicted, true, 2, 3);
        coded_.board.books[1] = pack_codebooks(books_[1]);
        for_images(is_predicted, [&](std::size_t v) { encode_image(v); });
        if (progress_ != nullptr) progress_->finish();
        std::vector<CodedError> errors(work_.size());
        for_each_index(work_.size(), [&](std::size_t v) {
            errors[v] = measure_coded_error(sources_[v], codec::plane_views(std::as_const(work_[v].reconstruction)),
                                            object_.width, object_.height, settings_.alpha_bits);
        });
        return {std::move(coded_), coded_psnr_db(errors)};
    }

private:
    template <class Wanted, class Work>
    void for_images(const Wanted& wanted, const Work& work) {
        for_each_index(work_.size(), [&](std::size_t v) {
            if (wanted(v)) work(v);
        });
    }
    void advance() {
        if (progress_ != nullptr) progress_->advance();
    }

    // Assigns progressive levels and references.
    void plan() {
        for (const Ring& ring : object_.rings) {
            const int count = static_cast<int>(ring.views.size());
            const int references =
                std::max(1, (count + settings_.views_per_reference / 2) / settings_.views_per_reference);
            const auto is_reference = [&](int n) { return n * references % count < references; };
            for (int n = 0; n < count; ++n) {
                const std::size_t view = ring.views[static_cast<std::size_t>(n)];
                if (is_reference(n)) continue;
                coded_.levels[view] = static_cast<std::uint8_t>(std::max(1, progressive_level(n)));
                codec::ImageHead& head = coded_.images[view].head;
                std::size_t found = 0;
                for_ring_references(ring, n, object_.width, 120, is_reference,
                                    [&](std::uint16_t reference, int reach_px) {
                                        work_[view].reach_px[found] = reach_px;
                                        head.reference[found++] = reference;
                                    });
            }
        }
    }

    [[nodiscard]] int block_columns() const { return coded_.coded_width() / codec::kBoardBlock; }
    [[nodiscard]] int block_rows() const { return coded_.coded_height() / codec::kBoardBlock; }
    Block& block_at(std::size_t v, int x, int y) {
        return work_[v]
            .blocks[static_cast<std::size_t>(y / codec::kBoardBlock * block_columns() + x / codec::kBoardBlock)];
    }

    void classify_blocks(std::size_t v) {
        for (auto& plane : work_[v].reconstruction) {
            plane = Image<std::uint8_t>(coded_.coded_width(), coded_.coded_height());
        }
        work_[v].blocks.resize(static_cast<std::size_t>(block_columns() * block_rows()));
        const int full = (1 << settings_.alpha_bits) - 1;
        for (int y = 0; y < coded_.coded_height(); y += codec::kBoardBlock) {
            for (int x = 0; x < coded_.coded_width(); x += codec::kBoardBlock) {
                bool any = false;
                bool all = true;
                for (int row = y; row < y + codec::kBoardBlock; ++row) {
                    const std::uint8_t* const levels = sources_[v].alpha.row(row) + x;
                    for (int column = 0; column < codec::kBoardBlock; ++column) {
                        any = any || levels[column] > 0;
                        all = all && levels[column] == full;
                    }
                }
                block_at(v, x, y).cover = all ? Cover::kFull : (any ? Cover::kMixed : Cover::kEmpty);
            }
        }
    }

    template <class Work>  // work(x, y, block)
    void for_blocks(std::size_t v, const Work& work) {
        for (int y = 0; y < coded_.coded_height(); y += codec::kBoardBlock) {
            for (int x = 0; x < coded_.coded_width(); x += codec::kBoardBlock) {
                Block& block = block_at(v, x, y);
                if (block.cover != Cover::kEmpty) work(x, y, block);
            }
        }
    }

    // The classes allowed for a block, as a bit set.
    [[nodiscard]] unsigned allowed(std::size_t v, const Block& block, bool predicted) const {
        const auto& classes = classes_of(v);
        unsigned may = 0;
        for (std::size_t c = 1; c < classes.size(); ++c) {
            if (classes[c].predicted == predicted && (classes[c].alpha || block.cover == Cover::kFull)) may |= 1U << c;
        }
        return may;
    }
    [[nodiscard]] const std::array<RecordClass, codec::kBoardClasses>& classes_of(std::size_t v) const {
        return coded_.board.classes[coded_.images[v].head.references() > 0 ? 1 : 0];
    }

    [[nodiscard]] BlockResidual residual_of(std::size_t v, int x, int y, const Block& block, bool predicted) const {
        const SourceImage& source = sources_[v];
        if (!predicted) return compute_flat_residual(source, x, y, mean_colour(source, x, y));
        return compute_prediction_residual(source, x, y, reference_of(v, block.motion.reference), x + block.motion.x,
                                           y + block.motion.y);
    }
    [[nodiscard]] codec::ConstPlaneViews reference_of(std::size_t v, int reference) const {
        return codec::plane_views(
            std::as_const(work_[coded_.images[v].head.reference[static_cast<std::size_t>(reference)]].reconstruction));
    }

    // Trains on blocks spread evenly over the images for which `wanted` is true.
    template <class Wanted>
    StageCodebooks train(const Wanted& wanted, bool predicted, int block_stages, int quarter_stages) {
        std::size_t count = 0;
        for (std::size_t v = 0; v < work_.size(); ++v) {
            if (wanted(v)) for_blocks(v, [&](int, int, const Block&) { ++count; });
        }
        const std::size_t stride = std::max<std::size_t>(1, (count + kTrainingBlocks - 1) / kTrainingBlocks);
        std::vector<TrainingBlock> blocks;
        std::size_t number = 0;
        for (std::size_t v = 0; v < work_.size(); ++v) {
            if (!wanted(v)) continue;
            for_blocks(v, [&](int x, int y, const Block& block) {
                if (number++ % stride != 0 || (predicted && !block.has_motion)) return;
                blocks.push_back({residual_of(v, x, y, block, predicted), allowed(v, block, predicted)});
            });
        }
        return train_stages(blocks, predicted ? kPredictedClasses : kFlatClasses, block_stages, quarter_stages, lambda_,
                            1.0 / static_cast<double>(stride));
    }

    void find_motions(std::size_t v) {
        const codec::ImageHead& head = coded_.images[v].head;
        for_blocks(v, [&](int x, int y, Block& block) {
            std::int64_t best = 0;
            for (int r = 0; r < head.references(); ++r) {
                MotionSearch search;
                search.source = &sources_[v];
                search.reference = reference_of(v, r)[0];
                search.x = x;
                search.y = y;
                search.size = codec::kBoardBlock;
                search.reach_x = work_[v].reach_px[static_cast<std::size_t>(r)];
                search.reach_y = kReachDown_px;
                search.fractions = false;
                const codec::MotionVector none;
                const MotionMatch found = search_motion(search, {&none, 1}, none);
                Block tried = block;
                tried.motion = {r, found.vector.x >> 2, found.vector.y >> 2};
                const std::int64_t error = residual_of(v, x, y, tried, true).error();
                if (block.has_motion && error >= best) continue;
                best = error;
                block.motion = tried.motion;
                block.has_motion = true;
            }
        });
    }

    struct Chosen {
        int number = 0;  // class number
        double cost = 0;
        StagedBlock staged;
    };

    Chosen choose(std::size_t v, int x, int y, const Block& block) const {
        Chosen best;
        for (const bool predicted : {false, true}) {
            const unsigned may = allowed(v, block, predicted);
            if (may == 0 || (predicted && !block.has_motion)) continue;
            const StageCodebooks& books = books_[predicted ? 1 : 0];
            Chosen chosen;
            chosen.staged = quantise_stages(books, residual_of(v, x, y, block, predicted));
            chosen.number = select_class(chosen.staged, classes_of(v), may, lambda_);
            const RecordClass& record_class = classes_of(v)[static_cast<std::size_t>(chosen.number)];
            chosen.cost =
                static_cast<double>(chosen.staged.error[static_cast<std::size_t>(count_stages(record_class))]) +
                lambda_ * record_class.bytes();
            if (best.number == 0 || chosen.cost < best.cost) best = chosen;
        }
        return best;
    }

    void put_record(std::size_t v, int x, int y, const Block& block, const Chosen& chosen,
                    std::vector<std::byte>& out) const {
        const RecordClass& record_class = classes_of(v)[static_cast<std::size_t>(chosen.number)];
        const std::size_t end = out.size() + static_cast<std::size_t>(record_class.bytes());
        const auto put = [&](unsigned byte) { out.push_back(static_cast<std::byte>(byte)); };
        if (record_class.predicted) {
            const unsigned word = codec::board_motion_word(block.motion);
            put(word & 255U);
            put(word >> 8U);
        } else {
            for (const std::uint8_t colour : mean_colour(sources_[v], x, y)) put(colour);
        }
        for (std::size_t s = 0; s < static_cast<std::size_t>(record_class.block_stages); ++s)
            put(chosen.staged.block[s]);
        for (std::size_t s = 0; s < static_cast<std::size_t>(record_class.quarter_stages); ++s) {
            for (const std::uint8_t index : chosen.staged.quarter[s]) put(index);
        }
        if (record_class.alpha) {
            for (int q = 0; q < 4; ++q) put(alpha_.nearest(sources_[v], x + q % 2 * 4, y + q / 2 * 4));
        }
        out.resize(end);
    }

    void encode_image(std::size_t v) {
        codec::CodedImage& image = coded_.images[v];
        const auto tiles = static_cast<std::size_t>(coded_.tile_columns() * coded_.tile_rows());
        image.tiles.resize(tiles);
        for (std::size_t t = 0; t < tiles; ++t) {
            const codec::TileRect place = codec::tile_rect(coded_, t);
            std::uint64_t classes = 0;
            std::vector<std::byte> bytes(codec::kBoardTileHeadBytes);
            for (int b = 0; b < codec::kBoardTileBlocks; ++b) {
                const int x = place.left + b / 4 * codec::kBoardBlock;
                const int y = place.top + b % 4 * codec::kBoardBlock;
                if (x >= place.left + place.width || y >= place.top + place.height) continue;
                const Block& block = block_at(v, x, y);
                if (block.cover == Cover::kEmpty) continue;
                const Chosen chosen = choose(v, x, y, block);
                classes |= static_cast<std::uint64_t>(chosen.number) << (3 * b);
                put_record(v, x, y, block, chosen, bytes);
            }
            if (classes != 0) {
                for (std::size_t i = 0; i < codec::kBoardTileHeadBytes; ++i) {
                    bytes[i] = static_cast<std::byte>(classes >> (8 * i) & 255U);
                }
                image.tiles[t] = {static_cast<std::uint32_t>(image.bytes.size()),
                                  static_cast<std::uint32_t>(bytes.size()), true};
                image.bytes.insert(image.bytes.end(), bytes.begin(), bytes.end());
            }
            std::array<codec::ConstPlaneViews, 2> references;
            for (int r = 0; r < image.head.references(); ++r)
                references[static_cast<std::size_t>(r)] = reference_of(v, r);
            codec::decode_tile(coded_, v, t, references, nullptr, codec::plane_views(work_[v].reconstruction));
        }
        advance();
    }

    const RaySpaceObject& object_;
    const std::vector<SourceImage>& sources_;
    const BoardSettings& settings_;
    Progress* progress_;
    codec::CodedImages coded_;
    std::vector<BoardWorkImage> work_;
    double lambda_ = 0;                    // squared error equivalent to one byte
    std::array<StageCodebooks, 2> books_;  // [of flat blocks, of predicted ones]
    AlphaCodebook alpha_;
};

}  // namespace

EncodedImages encode_board(const RaySpaceObject& object, const std::vector<SourceImage>& sources,
                           const BoardSettings& settings, Progress* progress) {
    return BoardEncoder(object, sources, settings, progress).encode();
}

}  // namespace rs::encode
