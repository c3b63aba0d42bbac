#pragma once
// How the columns of a view are dealt out to the pipes of a parallel board: in stripes of 16, one after the other, from
// another first pipe on in every view, so that the middle of the views does not always meet the same pipes. A pipe
// writes its stripes into the image buffer of its own memory channel, so this is also where the host finds them.

namespace rs::engine::model {

inline constexpr int kStripeColumns = 16;
inline constexpr int kStripeTurn = 7;  // pipes, from view to view

// Pipe of a column; `view` is its number in the rendering cycle.
constexpr int stripe_owner(int view, int column, int pipes) {
    return (column / kStripeColumns + kStripeTurn * view) % pipes;
}

// One pipe's share. The default owns everything.
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
    [[nodiscard]] constexpr bool takes_part(int view, int width) const { return first_column(view) < width; }
};

}  // namespace rs::engine::model
