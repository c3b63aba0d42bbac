#include "rayspace/format/content_coding.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <string>

namespace rs::map_coding {
namespace {

// Predicts the next run from the previous ones, modulo 2^16. Runs beyond the counts of the rows belong to the last row.
class Prediction {
public:
    explicit Prediction(std::span<const std::uint16_t> counts) : counts_(counts), lengths_(std::size_t{1} << 16, 0) {}

    std::uint16_t next_view() {
        bool begins = false;
        for (; left_ == 0 && row_ < counts_.size(); ++row_) {
            left_ = counts_[row_];
            begins = true;
        }
        left_ -= left_ > 0 ? 1 : 0;
        begins_row_ = begins;
        return begins ? first_ : static_cast<std::uint16_t>(view_ + 1);
    }
    [[nodiscard]] std::uint16_t length(std::uint16_t view) const { return lengths_[view]; }
    void update(std::uint16_t view, std::uint16_t length) {
        if (begins_row_) first_ = view;
        view_ = view;
        lengths_[view] = length;
    }

private:
    std::span<const std::uint16_t> counts_;
    std::size_t row_ = 0;                 // next row
    std::size_t left_ = 0;                // remaining runs of the row before it
    std::vector<std::uint16_t> lengths_;  // [view] length of its last run
    std::uint16_t first_ = 0;             // view of the last row's first run
    std::uint16_t view_ = 0;              // view of the last run
    bool begins_row_ = false;             // true if the run whose view was requested last is the first of its row
};

// Stores the n-th number of a plane.
void put(std::uint16_t number, std::size_t n, std::vector<std::uint8_t>& plane) {
    plane[2 * n] = static_cast<std::uint8_t>(number & 0xFFU);
    plane[2 * n + 1] = static_cast<std::uint8_t>(number >> 8U);
}

}  // namespace

std::uint64_t residual_bytes(std::uint64_t rows, std::uint64_t runs) {
    return 2 * rows + 4 * runs;
}

Runs encode_runs(std::span<const std::uint16_t> cells, int u_cells) {
    const auto width = static_cast<std::size_t>(u_cells);
    RS_CHECK(cells.size() % width == 0);
    Runs runs;
    for (std::size_t begin = 0; begin < cells.size(); begin += width) {
        const std::span<const std::uint16_t> row = cells.subspan(begin, width);
        std::uint16_t count = 0;
        for (std::size_t at = 0; at < width; ++count) {
            const std::size_t first = at;
            while (at < width && row[at] == row[first]) ++at;
            runs.views.push_back(row[first]);
            runs.lengths.push_back(static_cast<std::uint16_t>(at - first));
        }
        runs.counts.push_back(count);
    }
    return runs;
}

std::vector<std::uint8_t> encode_residuals(const Runs& runs) {
    const std::size_t rows = runs.counts.size();
    const std::size_t count = runs.views.size();
    std::vector<std::uint8_t> plane(residual_bytes(rows, count));
    for (std::size_t row = 0; row < rows; ++row) put(runs.counts[row], row, plane);
    Prediction predicted(runs.counts);
    for (std::size_t run = 0; run < count; ++run) {
        const std::uint16_t view = runs.views[run];
        put(static_cast<std::uint16_t>(view - predicted.next_view()), rows + run, plane);
        put(static_cast<std::uint16_t>(runs.lengths[run] - predicted.length(view)), rows + count + run, plane);
        predicted.update(view, runs.lengths[run]);
    }
    return plane;
}

Runs decode_run_residuals(std::span<const std::uint8_t> plane, std::size_t rows, std::size_t runs) {
    RS_CHECK(plane.size() == residual_bytes(rows, runs));
    const auto number = [&](std::size_t n) { return static_cast<std::uint16_t>(plane[2 * n] | plane[2 * n + 1] << 8); };
    Runs found{std::vector<std::uint16_t>(rows), std::vector<std::uint16_t>(runs), std::vector<std::uint16_t>(runs)};
    for (std::size_t row = 0; row < rows; ++row) found.counts[row] = number(row);
    Prediction predicted(found.counts);
    for (std::size_t run = 0; run < runs; ++run) {
        const auto view = static_cast<std::uint16_t>(number(rows + run) + predicted.next_view());
        const auto length = static_cast<std::uint16_t>(number(rows + runs + run) + predicted.length(view));
        predicted.update(view, length);
        found.views[run] = view;
        found.lengths[run] = length;
    }
    return found;
}

Status decode_runs(const Runs& runs, int u_cells, std::span<std::uint16_t> cells) {
    const auto width = static_cast<std::size_t>(u_cells);
    RS_CHECK(cells.size() == runs.counts.size() * width);
    std::size_t run = 0;
    for (std::size_t row = 0; row < runs.counts.size(); ++row) {
        const std::span<std::uint16_t> line = cells.subspan(row * width, width);
        const std::string where = "row " + std::to_string(row);
        if (runs.counts[row] > runs.views.size() - run) return Error{where + " has more runs than there are"};
        std::size_t filled = 0;
        for (const std::size_t end = run + runs.counts[row]; run < end; ++run) {
            const std::size_t length = runs.lengths[run];
            if (length < 1 || length > width - filled) {
                return Error{where + " has a run of " + std::to_string(length) + " cells where 1.." +
                             std::to_string(width - filled) + " fit"};
            }
            std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(filled), length, runs.views[run]);
            filled += length;
        }
        if (filled != width) {
            return Error{where + " fills " + std::to_string(filled) + " cells instead of " + std::to_string(width)};
        }
    }
    if (run != runs.views.size()) return Error{"has runs behind its last row"};
    return {};
}

}  // namespace rs::map_coding
