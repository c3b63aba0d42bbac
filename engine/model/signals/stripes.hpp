#pragma once
// Distribution of a view's columns over the pipes of a parallel board: stripes of 16 columns, assigned to the pipes in
// turn. The first pipe changes with every view, so that the costly middle of the views is spread over all pipes. A pipe
// writes its stripes into the image buffer of its own memory channel; the host DMA reads them there.

namespace rs::engine::model {

inline constexpr int kStripeColumns = 16;
inline constexpr int kStripeTurn = 7;  // offset of the first pipe from view to view

// Pipe of a column; `view` is its number in the rendering cycle.
constexpr int stripe_owner(int view, int column, int pipes) {
    return (column / kStripeColumns + kStripeTurn * view) % pipes;
}

// Share of one pipe. The default owns all columns.
struct StripeShare {
    int pipe = 0;
    int pipes = 1;
    [[nodiscard]] constexpr bool owns_column(int view, int column) const {
        return stripe_owner(view, column, pipes) == pipe;
    }
    // First column of its first stripe; the others follow at distances of pipes * kStripeColumns.
    [[nodiscard]] constexpr int first_column(int view) const {
        return ((pipe - kStripeTurn * view) % pipes + pipes) % pipes * kStripeColumns;
    }
    [[nodiscard]] constexpr bool has_columns(int view, int width) const { return first_column(view) < width; }
};

}  // namespace rs::engine::model
